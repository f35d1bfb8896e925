// @ts-check
/**
 * What is this, and why: a small card beside any cell, thing or past decision that is pointed at.
 *
 * What is told is in `why.js`, what points in `pointing.js` and `cursor.js`. It is a native popover: it goes with what it
 * speaks of, stays while the pointer or the focus is on it, and Escape or a press elsewhere sends it away.
 */

import { html, nothing, render } from "../../vendor/lit-html.js";
import { sceneOf } from "../core/state.js";
import { capital, t } from "../core/texts.js";
import { MOVES, moveName } from "../core/words.js";
import { egoOf } from "../road/world.js";
import { besides, lay, meets } from "../ui/placement.js";
import { createSlot, find } from "../ui/slot.js";
import { fetchDecision } from "./alternatives.js";
import { alike } from "./bubbleLoader.js";
import { optionText } from "./moveOptions.js";
import { tellOf, thingOf } from "./why.js";

/** @import { Place, Places } from "../road/hitTest.js" */
/** @import { Page } from "../core/page.js" */
/** @import { Decision, Option } from "../core/protocol.js" */
/** @import { State } from "../core/state.js" */
/** @import { Offer, Told } from "./why.js" */
/** @import { Card, Target } from "./bubbleLoader.js" */
/** @import { Panel } from "../panels/index.js" */

/** @typedef {Panel & Card} Bubble */

const LEAVE_MS = 280;
/** A trace is asked for so often at most, however fast the ticks come. */
const APART_MS = 400;

/** @param {HTMLElement} host  a popover @param {Page} page @returns {Bubble} */
export function createBubble(host, page) {
  const bubble = new WhyBubble(host, page);
  return {
    show: (target, pin) => bubble.show(target, pin),
    hide: () => bubble.hide(),
    leave: () => bubble.leave(),
    stay: () => bubble.stay(),
    focus() {
      const first = host.querySelector("button");
      first?.focus();
      return first !== null;
    },
    target: () => bubble.target,
    pinned: () => bubble.pinned,
    update: (state, before) => bubble.update(state, before),
    draw() {
      bubble.place();
      return false;
    },
  };
}

class WhyBubble {
  /** @type {Target | null} */ target = null;
  pinned = false;
  /** The trace of the decision that is spoken of. @type {Decision | null} */ trace = null;
  /** A button that is pressed stays where it is until it is let go: moved, it would hear no click. */ pressed = false;
  /** @type {AbortController | null} */ #asking = null;
  #askedAt = -Infinity;
  #leaving = 0;

  /** @param {HTMLElement} host @param {Page} page */
  constructor(host, page) {
    this.host = host;
    this.page = page;
    createSlot(/** @type {HTMLElement} */ (host.parentElement), host)(html`<div class="cell-mark" hidden></div>`);
    this.mark = find(document, ".cell-mark");
    host.addEventListener("pointerdown", () => (this.pressed = true));
    for (const end of ["pointerup", "pointercancel"]) addEventListener(end, () => this.pressed && setTimeout(() => this.#release())); // the click comes first
    host.addEventListener("pointerenter", () => this.stay());
    host.addEventListener("pointerleave", () => this.leave());
    host.addEventListener("focusout", ({ relatedTarget }) => {
      if (relatedTarget instanceof Node && !host.contains(relatedTarget)) this.hide();
    });
    host.addEventListener("toggle", (event) => /** @type {ToggleEvent} */ (event).newState === "closed" && this.#forget());
    addEventListener("scroll", () => this.place(), { capture: true, passive: true });
  }

  get scene() {
    return sceneOf(this.page.state());
  }

  /** @param {Target} next @param {boolean} [pin] */
  show(next, pin = false) {
    clearTimeout(this.#leaving);
    const other = this.target === null || !alike(this.target, next);
    this.target = next;
    this.pinned = pin || (this.pinned && !other);
    if (other) this.trace = null;
    this.write();
    if (!this.host.matches(":popover-open")) this.host.showPopover();
    this.place();
    void this.#ask();
  }

  hide() {
    this.#forget();
    if (this.host.matches(":popover-open")) this.host.hidePopover();
  }

  /** Hide it soon, unless the pointer comes back. */
  leave() {
    if (this.pinned || this.host.contains(document.activeElement)) return;
    clearTimeout(this.#leaving);
    this.#leaving = setTimeout(() => this.hide(), LEAVE_MS);
  }

  stay() {
    clearTimeout(this.#leaving);
  }

  #forget() {
    clearTimeout(this.#leaving);
    this.#asking?.abort();
    this.#asking = this.target = null;
    this.pinned = this.pressed = false;
    this.mark.hidden = true;
  }

  #release() {
    this.pressed = false;
    this.write();
    this.place();
  }

  /** @param {State} state @param {State} before */
  update(state, before) {
    const { target } = this;
    if (target === null) return;
    if (state.session !== before.session) return this.hide();
    if (target.kind === "decision" || (state.world === before.world && state.decision === before.decision)) return;
    if (target.id !== null && !state.world?.things.has(target.id)) return this.hide();
    if (this.trace?.tick !== state.decision?.tick) this.trace = null;
    this.write();
    if (performance.now() - this.#askedAt > APART_MS) void this.#ask();
  }

  /** The whole trace of the decision; what the stream tells of it is less. */
  async #ask() {
    const { session, decision } = this.scene;
    const tick = this.target?.kind === "decision" ? this.target.tick : decision?.tick;
    if (tick === undefined || session === null || this.trace?.tick === tick) return;
    this.#asking?.abort();
    this.#askedAt = performance.now();
    const mine = (this.#asking = new AbortController());
    try {
      const trace = await fetchDecision(session, tick, mine.signal);
      if (mine !== this.#asking) return;
      this.trace = trace;
    } catch {
      // Undone meanwhile, or a result stood: what the stream has told is all there is.
      if (mine === this.#asking && this.target?.kind === "decision") this.hide();
      return;
    }
    this.write();
    this.place();
  }

  write() {
    const { target, trace, scene } = this;
    if (target === null || this.pressed) return;
    const decision = target.kind === "decision" ? trace : (trace ?? scene.decision);
    const told = tellOf(target, scene, decision);
    if (told === null) return;
    this.host.setAttribute("aria-label", capital(told.title));
    render(template(told, decision?.tick ?? 0, (offer) => this.#take(offer)), this.host);
  }

  /** @param {Offer} offer */
  #take({ act, pick }) {
    this.hide();
    if (act) this.page.act(act.actions, act.label, act.quiet);
    if (pick) this.page.pick(pick);
  }

  /** Beside what it speaks of, and wholly in the window. */
  place() {
    const { target, host } = this;
    if (target === null || this.pressed) return;
    const anchor = this.#anchor(target);
    const frame = (target.kind === "cell" ? target.frame : target.frame.parentElement)?.getBoundingClientRect();
    if (!anchor || !frame || !meets(anchor, frame)) return this.hide();
    const [x, y] = besides(anchor, host.offsetWidth, host.offsetHeight, target.kind === "cell" ? this.#ego(target.places) : null);
    host.style.transform = `translate(${x}px, ${y}px)`;
    this.mark.hidden = target.kind !== "cell";
    lay(this.mark, anchor);
  }

  /** @param {Target} at @returns {Place | null} */
  #anchor(at) {
    if (at.kind === "decision") return at.frame.isConnected ? at.frame.getBoundingClientRect() : null;
    const { world } = this.scene;
    const thing = world && thingOf(world, at);
    const pose = thing && at.places.poseOf?.(thing.id);
    return at.places.placeOf(pose ? [pose.column, pose.row] : (thing?.cell ?? at.cell));
  }

  /** @param {Places} places @returns {Place | null} */
  #ego(places) {
    const { world } = this.scene;
    const ego = world && egoOf(world);
    return ego && places.placeOf(ego.cell);
  }
}

/** @param {Told} told @param {number} tick  of the decision that is spoken of @param {(offer: Offer) => void} take */
function template({ kind, title, note, lines, moves, offers }, tick, take) {
  return html`<p class="bubble-title" data-kind=${kind}>${capital(title)}${note ? html`<span class="bubble-id">${note}</span>` : nothing}</p>
    <div class="bubble-lines">${lines.map((line) => html`<p>${line}</p>`)}</div>
    ${moves.length > 0 ? movesTemplate(moves, tick, take) : nothing}
    ${offers.length > 0 ? offersTemplate(offers, take) : nothing}`;
}

/** @param {Option[]} moves @param {number} tick @param {(offer: Offer) => void} take */
function movesTemplate(moves, tick, take) {
  const item = (/** @type {Option} */ option) => {
    const { move } = option;
    const play = () => take({ text: "", pick: { kind: "move", tick, move } });
    return html`<li>
      <button class="bubble-move" type="button" title=${t("bubble.play")} @click=${play}>
        <span class="option-arrow" aria-hidden="true">${MOVES[move]?.arrow ?? ""}</span><span>${moveName(move)}</span>
        <span class="bubble-reason">${optionText(option)}</span>
      </button>
    </li>`;
  };
  return html`<div class="bubble-moves"><p>${t("bubble.instead")}</p><ul>${moves.map(item)}</ul></div>`;
}

/** @param {Offer[]} offers @param {(offer: Offer) => void} take */
function offersTemplate(offers, take) {
  const button = (/** @type {Offer} */ offer) => html`<button class="button small" type="button" @click=${() => take(offer)}>${offer.text}</button>`;
  const [small, large] = [offers.filter((offer) => offer.small), offers.filter((offer) => !offer.small)];
  return html`<div class="bubble-offers">
    ${large.map(button)}
    ${small.length > 0 ? html`<div class="bubble-put" role="group" aria-label=${t("bubble.put_here")}><span>${t("bubble.put_here")}</span>${small.map(button)}</div>` : nothing}
  </div>`;
}
