// @ts-check
/**
 * What would have been beside what was: two roads from one tick on, in step, and how each ends.
 *
 * The service drives both; nothing of the live session is touched. The live road goes on underneath.
 */

import { html, nothing, render } from "../../vendor/lit-html.js";
import { errorText } from "../core/http.js";
import { newestOnly } from "../core/latest.js";
import { createLoop } from "../core/renderLoop.js";
import { INITIAL } from "../core/state.js";
import { capital, t } from "../core/texts.js";
import { wantsStillness } from "../core/theme.js";
import { MOVES } from "../core/words.js";
import { createRoad } from "../road/road.js";
import { icon } from "../ui/icons.js";
import { find } from "../ui/slot.js";
import { fetchComparison, nameOfOther, nameOfReal, partOf, titleOf } from "./counterfactual.js";
import { partingTemplate, plannerChoice, raceAddress, speedChoice } from "./plannerRace.js";

/** @import { Comparison, Frame } from "./counterfactual.js" */
/** @import { Page } from "../core/page.js" */
/** @import { Hypothesis } from "./alternatives.js" */
/** @import { State } from "../core/state.js" */
/** @import { Panel } from "../panels/index.js" */

const SIDES = /** @type {const} */ (["real", "changed"]);
const VERDICTS = /** @type {Record<string, string>} */ ({ crash: t("verdict.crash"), success: t("verdict.arrived"), stuck: t("verdict.stuck") });
const TONES = /** @type {Record<string, string>} */ ({ crash: "bad", stuck: "bad", success: "good" });

/** @param {HTMLElement} host @param {Page} page @returns {Panel & {open: (other: Hypothesis) => void}} */
export function createCounterfactualView(host, page) {
  const view = new CounterfactualView(host, page);
  return {
    open: (other) => void view.open(other),
    update({ session }, before) {
      if (session !== before.session && !host.hidden) view.leave();
    },
    repaint: () => view.repaint(),
  };
}

class CounterfactualView {
  /** What is imagined otherwise. @type {Hypothesis | null} */ other = null;
  /** Both runs, once they have come. @type {Comparison | null} */ found = null;
  /** Why they have not, in words. */ trouble = "";
  /** How many ticks after the first are shown. */ at = 0;
  playing = false;
  /** How many times as fast as the road's own clock it plays. */ speed = 1;
  #timer = 0;
  #asking = newestOnly();
  /** Where the focus was before. @type {Element | null} */ #from = null;

  /** @param {HTMLElement} host @param {Page} page */
  constructor(host, page) {
    this.host = host;
    this.page = page;
    host.setAttribute("role", "dialog");
    host.setAttribute("aria-labelledby", "beside-title");
    host.addEventListener("keydown", (event) => this.#onKey(event));
    this.show();
    this.roads = SIDES.map((key) => ({ key, road: createRoad(find(host, `[data-side=${key}] .beside-road`)), shown: INITIAL }));
    this.loop = createLoop({
      update() {},
      draw: (now) => this.found !== null && this.roads.reduce((moving, { road }) => (road.draw?.(now) ?? false) || moving, false),
    });
    new ResizeObserver(() => !host.hidden && this.repaint()).observe(host);
  }

  /** The last tick of the longer run, from the first. */
  get last() {
    const { found } = this;
    return found ? Math.max(...SIDES.map((side) => found[side].frames.length)) - 1 : 0;
  }

  /** Only the newest question is answered. @param {Hypothesis} other */
  async open(other) {
    const { session } = this.page.state();
    if (session === null) return;
    const newest = this.#asking();
    if (this.host.hidden) this.#from = document.activeElement;
    clearTimeout(this.#timer);
    Object.assign(this, { other, found: null, trouble: "", at: 0, playing: false });
    this.#reveal(true);
    raceAddress(session, other);
    this.show();
    find(this.host, ".beside-head .button").focus();
    try {
      const found = await fetchComparison(session, other);
      if (newest() && !this.host.hidden) this.#begin(found);
    } catch (error) {
      if (!newest()) return;
      this.trouble = errorText(error);
      this.show();
    }
  }

  /** @param {Comparison} found */
  #begin(found) {
    this.found = found;
    this.go(0);
    // Who has gone elsewhere while the two were driven is not called back.
    if (this.#isFocused()) find(this.host, ".beside-controls .button").focus();
    // Moving pictures are not forced on those who do not want them: they get the tick where the two part.
    if (wantsStillness()) this.go(partOf(found)?.at ?? this.last);
    else this.run(true);
  }

  show() {
    const { other, found, trouble, at, last, playing, speed } = this;
    this.host.classList.toggle("waiting", found === null && trouble === "");
    this.host.toggleAttribute("data-trouble", trouble !== "");
    const hands = {
      leave: () => this.leave(),
      toggle: () => this.run(!this.playing),
      slide: (/** @type {{target: HTMLInputElement}} */ { target }) => this.step(Number(target.value) - this.at),
      speed: (/** @type {number} */ value) => void (this.speed = value),
      part: () => this.step((found ? (partOf(found)?.at ?? 1) : 1) - 1 - this.at),
      choose: (/** @type {Hypothesis} */ wanted) => this.page.pick(wanted),
    };
    render(template({ other, found, trouble, at, last, playing, speed }, hands), this.host);
  }

  /** Show a tick of both; a run that has ended stays at its end. @param {number} index */
  go(index) {
    if (this.found === null) return;
    this.at = Math.max(0, Math.min(this.last, index));
    this.show();
    for (const side of this.roads) {
      const { world, decision } = frameAt(this.found[side.key].frames, this.at);
      const next = /** @type {State} */ ({ ...INITIAL, world, decision });
      side.road.update?.(next, side.shown);
      side.shown = next;
    }
    this.loop.wake();
  }

  /** @param {boolean} on */
  run(on) {
    clearTimeout(this.#timer);
    this.playing = on && this.found !== null;
    if (this.playing && this.at >= this.last) this.go(0);
    this.show();
    if (this.playing) this.#timer = setTimeout(() => this.#onward(), this.#stepMs());
  }

  #onward() {
    this.go(this.at + 1);
    if (this.at >= this.last) this.run(false);
    else this.#timer = setTimeout(() => this.#onward(), this.#stepMs());
  }

  #stepMs() {
    return ((this.found?.real.frames[0].world.stepS ?? 0.5) * 1000) / this.speed;
  }

  /** @param {number} by */
  step(by) {
    this.run(false);
    this.go(this.at + by);
  }

  /** @param {boolean} on */
  #reveal(on) {
    this.host.hidden = !on;
    this.host.parentElement?.classList.toggle("comparing", on);
    if (on) this.repaint();
  }

  repaint() {
    for (const { road } of this.roads) road.repaint?.();
    this.loop.wake();
  }

  /** Whether the focus is here, or nowhere else. */
  #isFocused() {
    return document.activeElement === document.body || this.host.contains(document.activeElement);
  }

  leave() {
    this.#asking();
    const focused = this.#isFocused();
    this.run(false);
    this.found = null;
    this.#reveal(false);
    raceAddress(this.page.state().session, null);
    const from = this.#from;
    if (focused && from instanceof HTMLElement && from.isConnected) from.focus({ preventScroll: true });
  }

  /** @param {KeyboardEvent} event */
  #onKey(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.target instanceof HTMLSelectElement && event.key !== "Escape") return;
    const onButton = event.target instanceof HTMLButtonElement;
    if (event.key === "Escape") this.leave();
    else if (event.key === " " && !onButton) this.run(!this.playing);
    else if (event.key === "ArrowRight") this.step(1);
    else if (event.key === "ArrowLeft") this.step(-1);
    else if (event.key === "Home") this.step(-Infinity);
    else if (event.key === "End") this.step(Infinity);
    else if (event.key !== "Enter" && event.key !== " ") return;
    event.stopPropagation();
    if (!(onButton && (event.key === " " || event.key === "Enter"))) event.preventDefault();
  }
}

/** @param {Frame[]} frames @param {number} at */
function frameAt(frames, at) {
  return frames[Math.min(at, frames.length - 1)];
}

/** @typedef {{other: Hypothesis | null, found: Comparison | null, trouble: string, at: number, last: number, playing: boolean, speed: number}} Shown */
/**
 * @typedef {object} Hands
 * @property {() => void} leave
 * @property {() => void} toggle
 * @property {(event: {target: HTMLInputElement}) => void} slide
 * @property {(value: number) => void} speed
 * @property {() => void} part  go where the two part
 * @property {(wanted: Hypothesis) => void} choose  compare something else
 */

/** @param {Shown} shown @param {Hands} hands */
function template(shown, hands) {
  const { other, found, trouble } = shown;
  // Of two planners each reason is told where they part, and each end at its side.
  const told = other?.kind === "planners" ? "" : (found?.text ?? "");
  const summary = trouble || (found ? told : t("counterfactual.waiting"));
  return html`<header class="beside-head">
      <div class="beside-words">
        <h2 class="beside-title" id="beside-title">${other ? titleOf(other, found?.tick) : ""}</h2>
        <p class="beside-summary" role="status">${summary}${found ? html`<span class="unseen"> ${endsText(found, other)}</span>` : nothing}</p>
      </div>
      <button class="button quiet icon" type="button" aria-label=${t("counterfactual.close")} title="${t("page.close")}  Esc" @click=${hands.leave}>${icon("close")}</button>
    </header>
    ${found ? partingTemplate(found, other, hands.part) : nothing}
    <div class="beside-sides">${SIDES.map((key) => side(key, shown, hands))}</div>
    ${controls(shown, hands)}`;
}

/** How each of the two ends. @param {Comparison} found @param {Hypothesis | null} other */
function endsText({ real, changed }, other) {
  return `${other ? nameOfOther(other) : ""}: ${changed.end.text}. ${nameOfReal(other)}: ${real.end.text}.`;
}

/** @param {typeof SIDES[number]} key @param {Shown} shown @param {Hands} hands */
function side(key, { other, found, at }, { choose }) {
  const name = key === "changed" && other && found ? nameOfOther(other) : nameOfReal(other);
  const { frames, end } = found?.[key] ?? { frames: [], end: null };
  const frame = found && frameAt(frames, at);
  const verdict = frame && at >= frames.length - 1 ? VERDICTS[frame.world.status] : undefined;
  const move = frame?.decision && MOVES[frame.decision.move];
  return html`<figure class="beside-side" data-side=${key}>
    <figcaption><span class="beside-name">${other?.kind === "planners" ? plannerChoice(other, key, choose) : name}</span><span class="beside-end" data-tone=${TONES[end?.outcome ?? ""] ?? ""}>${end?.text ?? ""}</span></figcaption>
    <div class="beside-road"><p class="beside-verdict" data-tone=${TONES[frame?.world.status ?? ""] ?? ""} ?hidden=${verdict === undefined}>${verdict ?? ""}</p></div>
    <p class="beside-move">${move ? `${move.arrow} ${capital(move.name)}` : ""}</p>
  </figure>`;
}

/** @param {Shown} shown @param {Hands} hands */
function controls({ found, at, last, playing, speed: pace }, { toggle, slide, speed }) {
  const part = found && partOf(found);
  const tick = t("counterfactual.tick", { tick: (found?.tick ?? 0) + at });
  return html`<div class="beside-controls">
    <button class="button strong icon" type="button" aria-label=${t(playing ? "counterfactual.pause" : "counterfactual.play")} title="${t(playing ? "clock.pause" : "clock.play")}  ${t("clock.space")}" @click=${toggle}>
      ${icon(playing ? "pause" : "play")}
    </button>
    <div class="beside-track">
      <span class="beside-parting" aria-hidden="true" ?hidden=${!part || last === 0} .style=${part && last > 0 ? `inset-inline-start: ${((part.at - 1) / last) * 100}%` : ""}></span>
      <input class="beside-slider" type="range" min="0" step="1" max=${last} aria-label=${t("counterfactual.slider")} aria-valuetext=${tick} .value=${String(at)} @input=${slide} />
    </div>
    ${speedChoice(pace, speed)}
    <output class="beside-tick">${found ? tick : ""}</output>
  </div>`;
}
