// @ts-check
/**
 * What would have been beside what was: two roads from one tick on, in step, and how each ends.
 *
 * The service drives both; nothing of the live session is touched. The live road goes on underneath.
 */

import { endWords, fetchBeside, nameOfOther, partOf, sumOf, titleOf } from "./counterfactual.js";
import { make, setText } from "../ui/dom.js";
import { capital, moveName } from "../road/hitTest.js";
import { icon } from "../ui/icons.js";
import { turns } from "../core/latest.js";
import { createLoop } from "../core/renderLoop.js";
import { INITIAL } from "../core/state.js";
import { wantsStillness } from "../core/theme.js";
import { MOVES } from "../core/words.js";
import { createRoad } from "../road/road.js";

/** @import { Beside, Frame } from "./counterfactual.js" */
/** @import { Page } from "../main.js" */
/** @import { Otherwise } from "./alternatives.js" */
/** @import { State } from "../core/state.js" */
/** @import { Panel } from "../panels/index.js" */

const SIDES = /** @type {const} */ (["real", "changed"]);
const VERDICTS = /** @type {Record<string, string>} */ ({ crash: "Crash", success: "Arrived", stuck: "Stuck" });
const TONES = /** @type {Record<string, string>} */ ({ crash: "bad", stuck: "bad", success: "good" });

/** @param {HTMLElement} host @param {Page} page @returns {Panel & {open: (other: Otherwise) => void}} */
export function createBeside(host, page) {
  const title = make("h2", { class: "beside-title", id: "beside-title" });
  const summary = make("p", { class: "beside-summary", role: "status" });
  const close = make(
    "button",
    { class: "button quiet icon", type: "button", "aria-label": "Close the comparison", title: "Close  Esc", onclick: leave },
    icon("close"),
  );
  const play = make("button", { class: "button strong icon", type: "button", onclick: () => run(!playing) });
  const slider = make("input", {
    class: "beside-slider",
    type: "range",
    min: "0",
    step: "1",
    "aria-label": "Tick of both runs",
    oninput: () => {
      run(false);
      go(Number(slider.value));
    },
  });
  const parting = make("span", { class: "beside-parting", "aria-hidden": "true" });
  const clock = make("output", { class: "beside-tick" });
  const sides = SIDES.map((key) => {
    const name = make("span", { class: "beside-name" }, "Real run");
    const end = make("span", { class: "beside-end" });
    const road = make("div", { class: "beside-road" });
    const over = make("p", { class: "beside-verdict", hidden: true });
    const move = make("p", { class: "beside-move" });
    road.append(over);
    const figure = make("figure", { class: "beside-side", "data-side": key }, make("figcaption", {}, name, end), road, move);
    return { key, figure, name, end, over, move, canvas: createRoad(road), shown: INITIAL };
  });
  host.setAttribute("role", "dialog");
  host.setAttribute("aria-labelledby", "beside-title");
  host.append(
    make("header", { class: "beside-head" }, make("div", { class: "beside-words" }, title, summary), close),
    make("div", { class: "beside-sides" }, ...sides.map(({ figure }) => figure)),
    make("div", { class: "beside-controls" }, play, make("div", { class: "beside-track" }, parting, slider), clock),
  );

  /** @type {Beside | null} */ let found = null;
  let at = 0;
  let last = 0;
  let playing = false;
  let timer = 0;
  const asking = turns();
  /** @type {Element | null} */ let from = null;

  const loop = createLoop({
    update() {},
    draw(now) {
      if (found === null) return false;
      let moving = false;
      for (const { canvas } of sides) moving = (canvas.draw?.(now) ?? false) || moving;
      return moving;
    },
  });

  /** Only the newest question is answered. @param {Otherwise} other */
  async function open(other) {
    const { session } = page.state();
    if (session === null) return;
    const newest = asking();
    if (host.hidden) from = document.activeElement;
    show(true);
    run(false);
    found = null;
    host.classList.add("waiting");
    setText(title, other.kind === "change" ? other.label : `If it had gone ${moveName(other.move)}`);
    setText(summary, "Driving both to the end …");
    for (const side of sides) setText(side.end, "");
    close.focus();
    try {
      const answer = await fetchBeside(session, other);
      if (!newest() || host.hidden) return;
      begin(other, answer);
    } catch (error) {
      if (!newest()) return;
      setText(summary, error instanceof Error ? error.message : String(error));
      host.dataset.trouble = "";
    }
  }

  /** @param {Otherwise} other @param {Beside} answer */
  function begin(other, answer) {
    found = answer;
    host.classList.remove("waiting");
    last = Math.max(...SIDES.map((side) => answer[side].frames.length)) - 1;
    slider.max = String(last);
    setText(title, titleOf(other, answer));
    const { text, ends } = sumOf(answer);
    summary.replaceChildren(text, make("span", { class: "unseen" }, ` ${ends}`));
    setText(sides[1].name, nameOfOther(other));
    for (const side of sides) {
      const { end } = answer[side.key];
      setText(side.end, endWords(end));
      side.end.dataset.tone = TONES[end.outcome] ?? "";
    }
    const part = partOf(answer);
    parting.hidden = part === null || last === 0;
    if (part) parting.style.insetInlineStart = `${((part.at - 1) / last) * 100}%`;
    go(0);
    // Who has gone elsewhere while the two were driven is not called back.
    if (focused()) play.focus();
    // Moving pictures are not forced on those who do not want them: they get the tick where the two part.
    if (wantsStillness()) go(part?.at ?? last);
    else run(true);
  }

  /** Show a tick of both; a run that has ended stays at its end. @param {number} index */
  function go(index) {
    if (found === null) return;
    at = Math.max(0, Math.min(last, index));
    slider.value = String(at);
    const tick = found.tick + at;
    setText(clock, `tick ${tick}`);
    slider.setAttribute("aria-valuetext", `tick ${tick}`);
    for (const side of sides) {
      const { frames } = found[side.key];
      const frame = frames[Math.min(at, frames.length - 1)];
      side.canvas.update?.(/** @type {State} */ ({ ...INITIAL, world: frame.world, decision: frame.decision }), side.shown);
      side.shown = { ...INITIAL, world: frame.world };
      describe(side, frame, at >= frames.length - 1);
    }
    loop.wake();
  }

  /** @param {typeof sides[number]} side @param {Frame} frame @param {boolean} ended */
  function describe({ over, move }, { world, decision }, ended) {
    const verdict = ended ? VERDICTS[world.status] : undefined;
    over.hidden = verdict === undefined;
    over.dataset.tone = TONES[world.status] ?? "";
    setText(over, verdict ?? "");
    const made = decision && MOVES[decision.move];
    setText(move, made ? `${made.arrow} ${capital(made.name)}` : "");
  }

  /** @param {boolean} on */
  function run(on) {
    clearTimeout(timer);
    playing = on && found !== null;
    if (playing && at >= last) go(0);
    play.replaceChildren(icon(playing ? "pause" : "play"));
    play.setAttribute("aria-label", playing ? "Pause both" : "Play both");
    play.title = `${playing ? "Pause" : "Play"}  Space`;
    if (playing) timer = setTimeout(onward, stepMs());
  }

  function onward() {
    go(at + 1);
    if (at >= last) run(false);
    else timer = setTimeout(onward, stepMs());
  }

  function stepMs() {
    return (found?.real.frames[0].world.stepS ?? 0.5) * 1000;
  }

  /** @param {boolean} on */
  function show(on) {
    host.hidden = !on;
    host.parentElement?.classList.toggle("comparing", on);
    delete host.dataset.trouble;
    if (on) for (const { canvas } of sides) canvas.repaint?.();
  }

  /** Whether the focus is here, or nowhere else. */
  const focused = () => document.activeElement === document.body || host.contains(document.activeElement);

  function leave() {
    asking();
    const inside = focused();
    run(false);
    found = null;
    show(false);
    if (inside && from instanceof HTMLElement && from.isConnected) from.focus({ preventScroll: true });
  }

  host.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const onButton = event.target instanceof HTMLButtonElement;
    if (event.key === "Escape") leave();
    else if (event.key === " " && !onButton) run(!playing);
    else if (event.key === "ArrowRight") step(1);
    else if (event.key === "ArrowLeft") step(-1);
    else if (event.key === "Home") step(-Infinity);
    else if (event.key === "End") step(Infinity);
    else if (event.key !== "Enter" && event.key !== " ") return;
    event.stopPropagation();
    if (!(onButton && (event.key === " " || event.key === "Enter"))) event.preventDefault();
  });

  /** @param {number} by */
  function step(by) {
    run(false);
    go(at + by);
  }

  new ResizeObserver(() => {
    if (host.hidden) return;
    for (const { canvas } of sides) canvas.repaint?.();
    loop.wake();
  }).observe(host);

  return {
    open: (other) => void open(other),
    update({ session }, before) {
      if (session !== before.session && !host.hidden) leave();
    },
    repaint() {
      for (const { canvas } of sides) canvas.repaint?.();
      loop.wake();
    },
  };
}
