// @ts-check
/** The whole run under the road: where it waited, turned aside, crashed, was changed; dragged or walked with keys. */

import { make, setText } from "../ui/dom.js";
import { words } from "../core/http.js";
import { icon } from "../ui/icons.js";
import { byLoudness, JUMPS, marksIn, markWords, nextMark, spanOf } from "./timelineEvents.js";
import { drawLine, HEIGHT, tickAt, xOf } from "./paint/line.js";
import { Run } from "./runStore.js";
import { browserStorage } from "../core/storage.js";
import { clock } from "../core/words.js";

/** @import { Act } from "../core/commands.js" */
/** @import { Page } from "../main.js" */
/** @import { Looking } from "./past.js" */
/** @import { Inks } from "./paint/line.js" */
/** @import { Mark } from "./runChart.js" */
/** @import { Panel } from "../panels/index.js" */

const NEAR_PX = 5;
const LEAP = 10;
const MOST_TOLD = 4;

/**
 * @param {HTMLElement} host
 * @param {Page} page
 * @param {Looking} looking
 * @returns {Panel}
 */
export function createTimeline(host, page, looking) {
  const canvas = make("canvas", { class: "line-canvas" });
  const tip = make("div", { class: "line-tip", hidden: true, "aria-hidden": "true" });
  const slider = make(
    "div",
    { class: "line", role: "slider", tabIndex: 0, "aria-label": "The run so far", "aria-valuemin": 0, "aria-valuenow": 0, "aria-valuemax": 0 },
    canvas,
    tip,
  );
  const kinds = make(
    "select",
    { class: "line-kinds", "aria-label": "Jump between" },
    ...JUMPS.map(({ name, label }) => make("option", { value: name }, name === "any" ? `any ${label}` : label)),
  );
  const note = make("span", { class: "line-note", hidden: true });
  const jumpers = make("div", { class: "jumps", role: "group", "aria-label": "Jump along the run" }, jumper(-1), kinds, jumper(1));
  host.append(slider, jumpers, note);
  const pen = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));

  const run = new Run({
    storage: browserStorage(),
    changed() {
      redraw();
      if (run.coming) return;
      sought?.();
      sought = null;
    },
    rewritten: () => looking.rewritten(),
    failed(error) {
      note.hidden = error === null;
      if (error !== null) setText(note, `Part of the run is not shown. ${words(error)}`);
    },
  });
  /** @type {Inks | null} */ let inks = null;
  /** @type {number | null} */ let over = null;
  /** @type {(() => void) | null} a jump that waits for the part of the run that is about to be known */ let sought = null;
  let dragging = false;
  let stale = true;
  let width = 0;

  /** @param {1 | -1} direction */
  function jumper(direction) {
    const label = direction < 0 ? "Previous" : "Next";
    return make(
      "button",
      {
        class: "button icon small", type: "button", "aria-label": `${label} mark`, title: `${label}  ${direction < 0 ? "[" : "]"}`,
        "data-jump": label.toLowerCase(), "aria-keyshortcuts": direction < 0 ? "[" : "]", onclick: () => jump(kinds.value, direction),
      },
      icon(direction < 0 ? "previous" : "next"),
    );
  }

  /** @param {string} name @param {1 | -1} direction */
  function jump(name, direction) {
    const session = run.session;
    sought = run.coming ? () => session === run.session && jump(name, direction) : null;
    if (sought) return;
    const sort = JUMPS.find((each) => each.name === name) ?? JUMPS[0];
    const from = looking.tick ?? run.chart.now;
    const mark = nextMark(run.chart.marks(), sort.kinds, from, direction);
    if (mark) {
      page.tell({ text: `Tick ${mark.tick}: ${markWords(mark)}`, aloud: true });
      void looking.at(mark.tick);
    } else if (direction > 0 && looking.tick !== null) {
      looking.live();
      page.tell({ text: `No later ${sort.label}: back to the present.` });
    } else page.tell({ text: `No ${direction < 0 ? "earlier" : "later"} ${sort.label}.` });
  }

  const line = () => ({ width, span: spanOf(run.chart.now) });

  /** What is at a tick, or near it where ticks are narrower than a finger: of each kind the nearest. @param {number} tick */
  function near(tick) {
    const reach = Math.floor((NEAR_PX / Math.max(1, width)) * line().span);
    const distance = (/** @type {Mark} */ { tick: at, ticks = 1 }) => Math.max(at - tick, tick - at - ticks + 1, 0);
    const all = marksIn(run.chart.marks(), tick - reach, tick + reach).filter(({ kind }) => kind !== "episode" || reach < 3);
    const kinds = [...new Set(byLoudness(all).map(({ kind }) => kind))];
    return kinds.map((kind) => {
      const alike = all.filter((mark) => mark.kind === kind).sort((a, b) => distance(a) - distance(b));
      const at = distance(alike[0]) > 0 ? ` (tick ${alike[0].tick})` : "";
      return `${markWords(alike[0])}${at}${alike.length > 1 ? ` · ${alike.length} near here` : ""}`;
    });
  }

  // Touching

  slider.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    dragging = true;
    slider.setPointerCapture(event.pointerId);
    point(event);
  });
  slider.addEventListener("pointermove", point);
  for (const end of ["pointerup", "pointercancel"]) slider.addEventListener(end, () => (dragging = false));
  slider.addEventListener("pointerleave", () => {
    over = null;
    redraw();
  });
  slider.addEventListener("focus", () => redraw());
  slider.addEventListener("blur", () => redraw());

  /** @param {PointerEvent} event */
  function point(event) {
    const tick = Math.max(0, Math.min(run.chart.now, tickAt(line(), event.clientX - slider.getBoundingClientRect().left)));
    if (dragging) void looking.at(tick);
    over = tick;
    redraw();
  }

  slider.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const leap = event.shiftKey ? LEAP : 1;
    const ways = /** @type {Record<string, () => unknown>} */ ({
      ArrowLeft: () => looking.step(-leap),
      ArrowDown: () => looking.step(-leap),
      ArrowRight: () => looking.step(leap),
      ArrowUp: () => looking.step(leap),
      PageDown: () => looking.step(-LEAP),
      PageUp: () => looking.step(LEAP),
      Home: () => looking.at(0),
      End: () => looking.live(),
      Escape: () => looking.live(),
    });
    if (!Object.hasOwn(ways, event.key)) return;
    void ways[event.key]();
    event.preventDefault();
    event.stopPropagation();
  });

  // Showing

  function redraw() {
    stale = true;
    page.wake();
  }

  function tell() {
    const tick = looking.tick ?? run.chart.now;
    const live = looking.tick === null;
    // While it runs, the one who has the focus here is not told each tick.
    if (!(live && document.activeElement === slider && slider.dataset.live === "yes")) {
      slider.setAttribute("aria-valuemax", String(run.chart.now));
      slider.setAttribute("aria-valuenow", String(tick));
      const here = byLoudness(marksIn(run.chart.marks(), tick, tick)).map(markWords);
      slider.setAttribute("aria-valuetext", live ? "live" : [`tick ${tick} of ${run.chart.now}`, ...here].join(", "));
    }
    slider.dataset.live = live ? "yes" : "no";
    const shown = over ?? (looking.tick !== null && slider.matches(":focus-visible") ? looking.tick : null);
    tip.hidden = shown === null;
    if (shown === null) return;
    const stepS = page.state().world?.stepS ?? 0.5;
    const marks = near(shown);
    tip.replaceChildren(
      make("b", {}, `Tick ${shown}`),
      make("span", { class: "line-tip-time" }, clock(shown * stepS)),
      ...marks.slice(0, MOST_TOLD).map((mark) => make("span", { class: "line-tip-mark" }, mark)),
    );
    const x = Math.max(0, Math.min(width - tip.offsetWidth, xOf(line(), shown) - tip.offsetWidth / 2));
    tip.style.insetInlineStart = `${x}px`;
  }

  looking.listen(redraw);

  return {
    acts: jumpActs(jump, () => kinds.value),

    update(state) {
      const { world, course } = page.state();
      if (world) run.takeIn(state.session, world.tick, course);
      stale = true;
    },

    repaint() {
      inks = null;
      stale = true;
    },

    draw() {
      if (!stale) return false;
      stale = false;
      const ratio = devicePixelRatio || 1;
      if (inks === null) {
        width = slider.clientWidth;
        canvas.width = Math.max(1, Math.round(width * ratio));
        canvas.height = HEIGHT * ratio;
        inks = readInks(host);
      }
      pen.setTransform(ratio, 0, 0, ratio, 0, 0);
      drawLine(pen, { ...line(), now: run.chart.now, at: looking.tick, over, marks: run.chart.marks(), known: (tick) => run.chart.letter(tick) !== "" }, inks);
      tell();
      return false;
    },
  };
}

/**
 * @param {(name: string, direction: 1 | -1) => void} jump
 * @param {() => string} chosen
 * @returns {Act[]}
 */
function jumpActs(jump, chosen) {
  const group = "Time";
  /** @type {Act[]} */
  const acts = [];
  for (const direction of /** @type {const} */ ([-1, 1])) {
    const which = direction < 0 ? "Previous" : "Next";
    const key = direction < 0 ? "[" : "]";
    const now = () => ({ label: `${which} mark of the chosen kind`, run: () => jump(chosen(), direction) });
    acts.push({ name: which.toLowerCase(), group, key, keyName: key, repeats: true, now });
    for (const { name, label } of JUMPS.slice(1)) {
      acts.push({ name: `${which.toLowerCase()}-${name}`, group, now: () => ({ label: `${which} ${label}`, run: () => jump(name, direction) }) });
    }
  }
  return acts;
}

/** @param {Element} host @returns {Inks} */
function readInks(host) {
  const style = getComputedStyle(host);
  const read = (/** @type {string} */ name) => style.getPropertyValue(`--${name}`).trim();
  return {
    band: read("time-band"), ahead: read("line"), text: read("ink-3"), ink: read("ink"), surface: read("surface"),
    accent: read("accent"), danger: read("danger"), warn: read("time-wait"), good: read("good"),
  };
}
