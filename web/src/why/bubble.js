// @ts-check
/**
 * What is this, and why: a small card beside any cell, thing or past decision that is pointed at.
 *
 * What is told is in `why.js`, what points in `pointing.js` and `cursor.js`. It goes with what it speaks of, stays
 * while the pointer or the focus is on it, and Escape sends it away.
 */

import { make, setText } from "../ui/dom.js";
import { capital, moveName } from "../road/hitTest.js";
import { fetchDecision } from "./alternatives.js";
import { besides, meets } from "../ui/placement.js";
import { sceneOf } from "../core/state.js";
import { tellOf, thingOf } from "./why.js";
import { MOVES, reasonWords } from "../core/words.js";
import { egoOf } from "../road/world.js";
import { alike, lay } from "./bubbleLoader.js";

/** @import { Place, Places } from "../road/hitTest.js" */
/** @import { Page } from "../main.js" */
/** @import { Decision, Option } from "../core/protocol.js" */
/** @import { Offer } from "./why.js" */
/** @import { Card, Target } from "./bubbleLoader.js" */
/** @import { Panel } from "../panels/index.js" */

/** @typedef {Panel & Card} Bubble */

const LEAVE_MS = 280;
/** A trace is asked for so often at most, however fast the ticks come. */
const APART_MS = 400;

/** @param {HTMLElement} host @param {Page} page @returns {Bubble} */
export function createBubble(host, page) {
  host.setAttribute("role", "dialog");
  const mark = make("div", { class: "cell-mark", hidden: true });
  host.before(mark);

  /** @type {Target | null} */ let target = null;
  let pinned = false;
  let leaving = 0;
  /** @type {Decision | null} the trace of the decision that is spoken of */ let trace = null;
  /** @type {AbortController | null} */ let asking = null;
  let written = "";
  /** A button that is pressed stays where it is until it is let go: made anew, or moved, it would hear no click. */
  let pressed = false;
  let late = false;
  let askedAt = -Infinity;

  /** @param {Target} next @param {boolean} [pin] */
  function show(next, pin = false) {
    clearTimeout(leaving);
    const other = target === null || !alike(target, next);
    target = next;
    pinned = pin || (pinned && !other);
    if (other) {
      trace = null;
      written = "";
    }
    host.hidden = false;
    write();
    place();
    void ask();
  }

  function hide() {
    clearTimeout(leaving);
    asking?.abort();
    asking = null;
    const focused = host.contains(document.activeElement);
    const frame = target?.frame;
    target = null;
    pinned = false;
    host.hidden = mark.hidden = true;
    if (focused) frame?.focus({ preventScroll: true });
  }

  /** The whole trace of the decision; what the stream tells of it is less. */
  async function ask() {
    const state = sceneOf(page.state());
    const tick = target?.kind === "decision" ? target.tick : state.decision?.tick;
    if (tick === undefined || state.session === null || trace?.tick === tick) return;
    asking?.abort();
    askedAt = performance.now();
    const mine = (asking = new AbortController());
    try {
      const told = await fetchDecision(state.session, tick, mine.signal);
      if (mine !== asking) return;
      trace = told;
    } catch {
      // Undone meanwhile, or a result stood: what the stream has told is all there is.
      if (mine === asking && target?.kind === "decision") hide();
      return;
    }
    write();
    place();
  }

  function write() {
    const state = sceneOf(page.state());
    if (target === null) return;
    if (pressed) return void (late = true);
    const decision = target.kind === "decision" ? trace : (trace ?? state.decision);
    const told = tellOf(target, state, decision);
    if (told === null) return;
    const { title, note, lines, moves, offers } = told;
    // Made anew only when it says something else: its buttons keep the focus.
    const key = JSON.stringify([title, note, moves, offers]);
    if (key !== written) {
      written = key;
      const at = document.activeElement;
      const focused = host.contains(at) ? at?.textContent : null;
      host.replaceChildren(
        make("p", { class: "bubble-title", "data-kind": told.kind }, capital(title), note ? make("span", { class: "bubble-id" }, note) : null),
        make("div", { class: "bubble-lines" }),
        moves.length > 0 && decision ? movesElement(moves, decision) : "",
        offers.length > 0 ? offersElement(offers) : "",
      );
      host.setAttribute("aria-label", capital(title));
      if (focused) [...host.querySelectorAll("button")].find(({ textContent }) => textContent === focused)?.focus();
    }
    const box = /** @type {HTMLElement} */ (host.querySelector(".bubble-lines"));
    lines.forEach((line, at) => setText(box.children[at] ?? box.appendChild(make("p")), line));
    while (box.children.length > lines.length) box.lastElementChild?.remove();
  }

  /** @param {Option[]} moves @param {Decision} decision */
  function movesElement(moves, { tick }) {
    const items = moves.map(({ move, reason }) =>
      make(
        "li",
        {},
        make(
          "button",
          {
            class: "bubble-move",
            type: "button",
            title: "Play it beside the real run",
            onclick: () => take({ text: "", pick: { kind: "move", tick, move } }),
          },
          make("span", { class: "option-arrow", "aria-hidden": "true" }, MOVES[move]?.arrow ?? ""),
          make("span", {}, moveName(move)),
          make("span", { class: "bubble-reason" }, reasonWords(reason)),
        ),
      ),
    );
    return make("div", { class: "bubble-moves" }, make("p", {}, "Instead, see what would have been"), make("ul", {}, ...items));
  }

  /** @param {Offer[]} offers */
  function offersElement(offers) {
    const button = (/** @type {Offer} */ offer) =>
      make("button", { class: "button small", type: "button", onclick: () => take(offer) }, offer.text);
    const small = offers.filter((offer) => offer.small).map(button);
    return make(
      "div",
      { class: "bubble-offers" },
      ...offers.filter((offer) => !offer.small).map(button),
      small.length > 0 &&
        make("div", { class: "bubble-put", role: "group", "aria-label": "Put here" }, make("span", {}, "Put here"), ...small),
    );
  }

  /** @param {Offer} offer */
  function take({ act, pick }) {
    hide();
    if (act) page.act(act.actions, act.label, act.quiet);
    if (pick) page.pick?.(pick);
  }

  /** Beside what it speaks of, and wholly in the window. */
  function place() {
    if (target === null || pressed) return;
    const anchor = anchorOf(target);
    const frame = (target.kind === "cell" ? target.frame : target.frame.parentElement)?.getBoundingClientRect();
    if (!anchor || !frame || !meets(anchor, frame)) return hide();
    const [x, y] = besides(anchor, host.offsetWidth, host.offsetHeight, target.kind === "cell" ? egoPlace(target.places) : null);
    host.style.transform = `translate(${x}px, ${y}px)`;
    mark.hidden = target.kind !== "cell";
    lay(mark, anchor);
  }

  /** @param {Target} at @returns {Place | null} */
  function anchorOf(at) {
    if (at.kind === "decision") return at.frame.isConnected ? at.frame.getBoundingClientRect() : null;
    const { world } = sceneOf(page.state());
    const thing = world && thingOf(world, at);
    const pose = thing && at.places.poseOf?.(thing.id);
    return at.places.placeOf(pose ? [pose.column, pose.row] : (thing?.cell ?? at.cell));
  }

  /** @param {Places} places @returns {Place | null} */
  function egoPlace(places) {
    const { world } = sceneOf(page.state());
    const ego = world && egoOf(world);
    return ego && places.placeOf(ego.cell);
  }

  function leave() {
    if (pinned || host.contains(document.activeElement)) return;
    clearTimeout(leaving);
    leaving = setTimeout(hide, LEAVE_MS);
  }

  function release() {
    pressed = false;
    if (late) write();
    late = false;
    place();
  }

  host.addEventListener("pointerdown", () => (pressed = true));
  for (const end of ["pointerup", "pointercancel"]) addEventListener(end, () => pressed && setTimeout(release)); // the click comes first

  const stay = () => clearTimeout(leaving);
  host.addEventListener("pointerenter", stay);
  host.addEventListener("pointerleave", leave);
  host.addEventListener("focusout", ({ relatedTarget }) => {
    if (relatedTarget instanceof Node && !host.contains(relatedTarget)) hide();
  });
  addEventListener("pointerdown", ({ target: over }) => {
    if (over instanceof Node && !host.contains(over)) hide();
  });
  addEventListener(
    "keydown",
    (event) => {
      if (event.key !== "Escape" || target === null) return;
      hide();
      event.preventDefault();
      event.stopPropagation();
    },
    { capture: true },
  );
  addEventListener("scroll", place, { capture: true, passive: true });

  return {
    show,
    hide,
    leave,
    stay,
    focus() {
      const first = host.querySelector("button");
      first?.focus();
      return first !== null;
    },
    target: () => target,
    pinned: () => pinned,

    update(state, before) {
      if (target === null) return;
      if (state.session !== before.session) return hide();
      if (target.kind === "decision" || (state.world === before.world && state.decision === before.decision)) return;
      if (target.id !== null && !state.world?.things.has(target.id)) return hide();
      if (trace !== null && trace.tick !== state.decision?.tick) trace = null;
      write();
      if (performance.now() - askedAt > APART_MS) void ask();
    },

    draw() {
      place();
      return false;
    },
  };
}
