// @ts-check
/**
 * Hands on the road: drag a thing to another cell or off the road, drag a new one from the tray, or choose it
 * there and click where it shall be.
 *
 * All of it becomes typed actions, a drop one utterance; what the service refuses is said here. Pointer events,
 * for mouse and finger alike; a finger that does not begin on a thing scrolls the page as ever.
 */

import { make, setText } from "../ui/dom.js";
import { hindrance, isLoose, moving, placing, removing } from "./edit.js";
import { capital, nameOf, onRoad, placeWords, thingAt } from "./hitTest.js";
import { sceneOf } from "../core/state.js";
import { lay } from "../why/bubbleLoader.js";
import { pointedAt } from "../why/pointing.js";
import { createTray, portrait } from "./tray.js";

/** @import { Places } from "./hitTest.js" */
/** @import { Page } from "../main.js" */
/** @import { Cell, Action } from "../core/protocol.js" */
/** @import { Thing } from "./world.js" */
/** @import { Card } from "../why/bubbleLoader.js" */
/** @import { Panel } from "../panels/index.js" */

/** @typedef {{kind: string, thing: Thing | null, x: number, y: number, pointer: number | null}} Held */

/**
 * @typedef {object} Hands
 * @property {(actions: Action[], label: string) => void} doing  do it; a refusal is said over the road
 * @property {(text: string) => void} tell
 */

const DRAG_PX = 6;
const TOLD_MS = 5_000;

/**
 * @param {HTMLElement} host  the road
 * @param {HTMLElement} surface  what lies over its picture and takes the pointer
 * @param {Places} places
 * @param {Page} page
 * @param {Card} card
 * @returns {Panel & Hands}
 */
export function createTouch(host, surface, places, page, card) {
  const target = make("div", { class: "cell-target", hidden: true });
  const ghost = make("div", { class: "ghost", hidden: true, "aria-hidden": "true" });
  const toast = make("p", { class: "road-toast", role: "status", hidden: true });
  const tray = createTray(host, places, {
    grab: (kind, event) => begin({ kind, thing: null, x: event.clientX, y: event.clientY, pointer: event.pointerId }),
    choose: (kind) => !dropped && choose(kind),
  });
  host.append(target, ghost, toast);

  /** @type {Held | null} */ let held = null;
  let dragging = false;
  /** The click that follows a drop is none. */
  let dropped = false;
  /** @type {string | null} */ let chosen = null;
  /** @type {string | null} */ let sent = null;
  let telling = 0;

  /** @param {string | null} kind */
  function choose(kind) {
    chosen = kind;
    tray.press(kind);
    host.toggleAttribute("data-placing", kind !== null);
    if (kind === null) target.hidden = true;
    else tell(`Click where the ${nameOfKind(kind)} shall be · Esc ends`);
  }

  /** @param {Held} what */
  function begin(what) {
    held = what;
    dragging = dropped = false;
    card.hide();
  }

  /** @param {number} x @param {number} y */
  function drag(x, y) {
    if (held === null) return;
    if (!dragging && Math.hypot(x - held.x, y - held.y) < DRAG_PX) return;
    if (!dragging) {
      dragging = true;
      choose(null);
      host.setAttribute("data-dragging", "");
      ghost.replaceChildren(portrait(places, held.kind, held.thing?.id ?? `${held.kind}-0`));
      ghost.hidden = false;
    }
    held = { ...held, x, y };
    aim();
  }

  /** Light the cell under what is held, or say why it cannot go there. */
  function aim() {
    const { world } = sceneOf(page.state());
    if (held === null || world === null) return;
    const size = places.placeOf([0, 0])?.width ?? 40;
    lay(ghost, { left: held.x - size / 2, top: held.y - size / 2, width: size, height: size });
    const cell = over(held.x, held.y);
    const off = cell === null || !onRoad(world, cell);
    const why = off ? null : hindrance(world, held.kind, cell, held.thing?.id);
    ghost.toggleAttribute("data-off", off);
    light(off ? null : cell, why === null);
    const name = held.thing?.id ?? `the ${nameOfKind(held.kind)}`;
    if (off) tell(held.thing ? `Let go to take ${name} off the road` : "Let go over the road to put it there");
    else tell(why ?? capital(placeWords(world, cell)));
  }

  /** @param {Cell | null} cell @param {boolean} good */
  function light(cell, good) {
    const place = cell && places.placeOf(cell);
    target.hidden = !place;
    target.toggleAttribute("data-no", !good);
    if (place) lay(target, place);
  }

  /** The cell at a point that is over the road's picture. @param {number} x @param {number} y */
  function over(x, y) {
    const { left, top, right, bottom } = host.getBoundingClientRect();
    return x < left || y < top || x > right || y > bottom ? null : places.cellAt(x, y);
  }

  function drop() {
    const { world } = sceneOf(page.state());
    if (held === null || world === null) return;
    const { kind, thing, x, y } = held;
    const cell = over(x, y);
    end();
    if (cell === null || !onRoad(world, cell)) {
      if (thing) doing(removing(thing), `Take ${thing.id} off the road`);
      return;
    }
    if (thing && thing.cell[0] === cell[0] && thing.cell[1] === cell[1]) return;
    const why = hindrance(world, kind, cell, thing?.id);
    if (why !== null) return tell(why);
    const where = placeWords(world, cell);
    if (thing) doing(moving(thing, cell), `Move ${thing.id} to ${where}`);
    else doing(placing(kind, cell), `Put ${nameOf({ kind })} in ${where}`);
  }

  function end() {
    held = null;
    dragging = false;
    ghost.hidden = target.hidden = true;
    host.removeAttribute("data-dragging");
    hush();
  }

  /** @param {Action[]} actions @param {string} label */
  function doing(actions, label) {
    if (page.state().past !== null) return tell("This is the past: go back to live, or fork here, to change the road.");
    // A thing moved changes no figure, and would not be listed if it were quiet.
    sent = page.act(actions, label, actions.length === 1);
  }

  /** @param {string} text */
  function tell(text) {
    clearTimeout(telling);
    setText(toast, text);
    toast.hidden = false;
    telling = setTimeout(hush, TOLD_MS);
  }

  function hush() {
    clearTimeout(telling);
    toast.hidden = true;
  }

  surface.addEventListener("pointerdown", (event) => {
    dropped = false;
    if (event.button !== 0) return;
    const { world } = sceneOf(page.state());
    const thing = world && thingAt(places, world, event.clientX, event.clientY);
    if (chosen !== null || !isLoose(thing)) return;
    surface.setPointerCapture(event.pointerId);
    begin({ kind: thing.kind, thing, x: event.clientX, y: event.clientY, pointer: event.pointerId });
  });
  addEventListener("pointermove", (event) => {
    if (held !== null && event.pointerId === held.pointer) drag(event.clientX, event.clientY);
    else if (chosen !== null && held === null) hover(event);
  });
  addEventListener("pointerup", (event) => {
    if (held === null || event.pointerId !== held.pointer) return;
    dropped = dragging;
    if (dragging) drop();
    else end();
  });
  addEventListener("pointercancel", () => held !== null && end());
  // A finger on a thing drags it; anywhere else it scrolls.
  surface.addEventListener(
    "touchstart",
    (event) => {
      const [finger] = event.changedTouches;
      const { world } = page.state();
      const loose = world && finger && isLoose(thingAt(places, world, finger.clientX, finger.clientY));
      if (loose && event.cancelable) event.preventDefault();
    },
    { passive: false },
  );
  surface.addEventListener("touchend", (event) => {
    // Nothing was dragged: what was touched is told, as by a click, which the prevented start has taken.
    const [finger] = event.changedTouches;
    if (!event.cancelable || dropped || !finger) return;
    const { clientX, clientY } = finger;
    const at = pointedAt(page, { target: surface, clientX, clientY });
    if (at?.kind !== "cell" || at.id === null || chosen !== null) return;
    event.preventDefault();
    card.show(at, true);
  });
  surface.addEventListener("click", (event) => {
    if (dropped) return;
    const at = pointedAt(page, event);
    if (at?.kind !== "cell") return;
    if (chosen === null) return card.show(at, true);
    const { world } = sceneOf(page.state());
    const cell = places.cellAt(event.clientX, event.clientY);
    if (world === null || cell === null) return;
    const why = hindrance(world, chosen, cell);
    if (why !== null) tell(why);
    else doing(placing(chosen, cell), `Put ${nameOf({ kind: chosen })} in ${placeWords(world, cell)}`);
  });
  addEventListener(
    "keydown",
    (event) => {
      if (event.key !== "Escape" || (held === null && chosen === null)) return;
      end();
      choose(null);
      dropped = true;
      event.preventDefault();
      event.stopPropagation();
    },
    { capture: true },
  );

  /** @param {PointerEvent} event */
  function hover({ clientX, clientY, target: at }) {
    const { world } = sceneOf(page.state());
    const cell = at === surface ? over(clientX, clientY) : null;
    const on = world !== null && cell !== null && onRoad(world, cell);
    light(on ? cell : null, on && chosen !== null && hindrance(world, chosen, cell) === null);
  }

  return {
    doing,
    tell,

    update({ talk }) {
      if (sent === null) return;
      const exchange = talk.find(({ id }) => id === sent);
      if (!exchange || exchange.standing === "pending") return;
      if (exchange.problem) tell(`Not done: ${exchange.problem.detail}`);
      sent = null;
    },

    draw() {
      if (host.hasAttribute("data-tray")) tray.draw();
      if (dragging) aim();
      return false;
    },

    repaint: tray.repaint,
  };
}

/** @param {string} kind */
function nameOfKind(kind) {
  return nameOf({ kind }).replace(/^an? /, "");
}
