// @ts-check
/**
 * Hands on the road: drag a thing to another cell or off the road, drag a new one from the tray, or choose it
 * there and click where it shall be.
 *
 * All of it becomes typed actions, a drop one utterance; what the service refuses is said here. Pointer events,
 * for mouse and finger alike; a finger that does not begin on a thing scrolls the page as ever.
 */

import { html } from "../../vendor/lit-html.js";
import { sceneOf } from "../core/state.js";
import { capital, t } from "../core/texts.js";
import { lay } from "../ui/placement.js";
import { createSlot, find } from "../ui/slot.js";
import { pointedAt } from "../why/pointing.js";
import { hindrance, isLoose, moving, placing, removing } from "./edit.js";
import { cellPx, onRoad, same, thingAt } from "./hitTest.js";
import { calledOf, nameOf, nounOf, placeWords } from "./placeTexts.js";
import { createTray, portrait } from "./tray.js";

/** @import { Kind } from "../core/wire.js" */
/** @import { Places } from "./hitTest.js" */
/** @import { Page } from "../core/page.js" */
/** @import { Cell, Action } from "../core/protocol.js" */
/** @import { State } from "../core/state.js" */
/** @import { Thing, World } from "./world.js" */
/** @import { Card } from "../why/bubbleLoader.js" */
/** @import { Panel } from "../panels/index.js" */

/** @typedef {{kind: Kind, thing: Thing | null, x: number, y: number, pointer: number}} Held */

/**
 * @typedef {object} RoadActions
 * @property {(actions: Action[], label: string) => void} runCommand  do it; a refusal is said over the road
 * @property {(text: string) => void} tell  say something over the road, for a while
 */

const DRAG_PX = 6;
const TOLD_MS = 5_000;

/**
 * @param {HTMLElement} host  the road
 * @param {HTMLElement} surface  what lies over its picture and takes the pointer
 * @param {Places} places
 * @param {Page} page
 * @param {Card} card
 * @returns {Panel & RoadActions}
 */
export function createDragDrop(host, surface, places, page, card) {
  const hands = new DragDrop(host, surface, places, page, card);
  return {
    runCommand: (actions, label) => hands.runCommand(actions, label),
    tell: (text) => hands.tell(text),
    update: (state) => hands.update(state),
    draw() {
      hands.draw();
      return false;
    },
    repaint: () => hands.tray.repaint(),
  };
}

class DragDrop {
  /** @type {Held | null} */ held = null;
  dragging = false;
  /** The click that follows a drop is none. */ dropped = false;
  /** The kind that is chosen in the tray. @type {Kind | null} */ chosen = null;
  /** What is said over the road; empty for nothing. */ told = "";
  /** Of what is held. @type {HTMLCanvasElement | null} */ picture = null;
  /** The exchange whose answer is waited for. @type {string | null} */ sent = null;
  #telling = 0;

  /**
   * @param {HTMLElement} host
   * @param {HTMLElement} surface
   * @param {Places} places
   * @param {Page} page
   * @param {Card} card
   */
  constructor(host, surface, places, page, card) {
    this.host = host;
    this.surface = surface;
    this.places = places;
    this.page = page;
    this.card = card;
    this.tray = createTray(host, places, {
      grab: (kind, { clientX, clientY, pointerId }) => this.#begin({ kind, thing: null, x: clientX, y: clientY, pointer: pointerId }),
      choose: (kind) => this.dropped || this.#choose(kind),
    });
    this.slot = createSlot(host);
    this.#show("", null);
    this.target = find(host, ".cell-target");
    this.ghost = find(host, ".ghost");
    this.#listen();
  }

  get world() {
    return sceneOf(this.page.state()).world;
  }

  /** @param {string} told @param {HTMLCanvasElement | null} [picture] */
  #show(told, picture = this.picture) {
    this.told = told;
    this.picture = picture;
    this.slot(
      html`<div class="cell-target" hidden></div>
        <div class="ghost" aria-hidden="true" ?hidden=${picture === null}>${picture}</div>
        <p class="road-toast" role="status" ?hidden=${told === ""}>${told}</p>`,
    );
  }

  #listen() {
    const { surface } = this;
    surface.addEventListener("pointerdown", (event) => this.#onDown(event));
    surface.addEventListener("touchstart", (event) => this.#onTouch(event), { passive: false });
    surface.addEventListener("touchend", (event) => this.#onTouchEnd(event));
    surface.addEventListener("click", (event) => this.#onClick(event));
    addEventListener("pointermove", (event) => {
      if (this.held !== null && event.pointerId === this.held.pointer) this.#drag(event.clientX, event.clientY);
      else if (this.chosen !== null && this.held === null) this.#hover(event);
    });
    addEventListener("pointerup", (event) => {
      if (this.held === null || event.pointerId !== this.held.pointer) return;
      this.dropped = this.dragging;
      if (this.dragging) this.#drop();
      else this.#end();
    });
    addEventListener("pointercancel", () => this.held !== null && this.#end());
    addEventListener("keydown", (event) => this.#onKey(event), { capture: true });
  }

  /** @param {Kind | null} kind */
  #choose(kind) {
    this.chosen = kind;
    this.tray.press(kind);
    this.host.toggleAttribute("data-placing", kind !== null);
    if (kind === null) this.target.hidden = true;
    else this.tell(t(`edit.click.${kind}`));
  }

  /** @param {Held} what */
  #begin(what) {
    this.held = what;
    this.dragging = this.dropped = false;
    this.card.hide();
  }

  /** @param {number} x @param {number} y */
  #drag(x, y) {
    if (this.held === null) return;
    const { kind, thing } = this.held;
    if (!this.dragging && Math.hypot(x - this.held.x, y - this.held.y) < DRAG_PX) return;
    if (!this.dragging) {
      this.dragging = true;
      this.#choose(null);
      this.host.setAttribute("data-dragging", "");
      this.#show(this.told, portrait(this.places, kind, thing?.id ?? `${kind}-0`));
    }
    this.held = { ...this.held, x, y };
    this.#aim();
  }

  /** Light the cell under what is held, or say why it cannot go there. */
  #aim() {
    const { held, world } = this;
    if (held === null || world === null) return;
    const size = cellPx(this.places) || 40;
    lay(this.ghost, { left: held.x - size / 2, top: held.y - size / 2, width: size, height: size });
    const cell = this.#over(held.x, held.y);
    const off = cell === null || !onRoad(world, cell);
    const why = off ? null : hindrance(world, held.kind, cell, held.thing?.id);
    this.ghost.toggleAttribute("data-off", off);
    this.#light(off ? null : cell, why === null);
    if (!off) this.tell(why ?? capital(placeWords(world, cell)));
    else this.tell(held.thing ? t("edit.let_go_off", { id: calledOf(world, held.thing) }) : t("edit.let_go_over", { name: nounOf(held) }));
  }

  /** @param {Cell | null} cell @param {boolean} good */
  #light(cell, good) {
    const place = cell && this.places.placeOf(cell);
    this.target.hidden = !place;
    this.target.toggleAttribute("data-no", !good);
    if (place) lay(this.target, place);
  }

  /** The cell at a point that is over the road's picture. @param {number} x @param {number} y */
  #over(x, y) {
    const { left, top, right, bottom } = this.host.getBoundingClientRect();
    return x < left || y < top || x > right || y > bottom ? null : this.places.cellAt(x, y);
  }

  #drop() {
    const { held, world } = this;
    if (held === null || world === null) return;
    const { kind, thing, x, y } = held;
    const cell = this.#over(x, y);
    this.#end();
    if (cell === null || !onRoad(world, cell)) {
      if (thing) this.runCommand(removing(thing), t("edit.take_off", { id: calledOf(world, thing) }));
      return;
    }
    if (thing && same(thing.cell, cell)) return;
    const why = hindrance(world, kind, cell, thing?.id);
    if (why !== null) return this.tell(why);
    if (thing) this.runCommand(moving(thing, cell), t("edit.move", { id: calledOf(world, thing), place: placeWords(world, cell) }));
    else this.#put(kind, world, cell);
  }

  /** @param {Kind} kind @param {World} world @param {Cell} cell */
  #put(kind, world, cell) {
    this.runCommand(placing(kind, cell), t("edit.put", { thing: nameOf({ kind }), place: placeWords(world, cell) }));
  }

  #end() {
    this.held = null;
    this.dragging = false;
    this.target.hidden = true;
    this.host.removeAttribute("data-dragging");
    clearTimeout(this.#telling);
    this.#show("", null);
  }

  /** @param {Action[]} actions @param {string} label */
  runCommand(actions, label) {
    if (this.page.state().past !== null) return this.tell(t("edit.past"));
    // A thing moved changes no figure, and would not be listed if it were quiet.
    this.sent = this.page.act(actions, label, actions.length === 1);
  }

  /** @param {string} text */
  tell(text) {
    clearTimeout(this.#telling);
    if (text !== this.told) this.#show(text);
    this.#telling = setTimeout(() => this.#show(""), TOLD_MS);
  }

  /** @param {PointerEvent} event */
  #onDown({ button, clientX, clientY, pointerId }) {
    this.dropped = false;
    if (button !== 0 || this.chosen !== null) return;
    const { world } = this;
    const thing = world && thingAt(this.places, world, clientX, clientY);
    if (!isLoose(thing)) return;
    this.surface.setPointerCapture(pointerId);
    this.#begin({ kind: thing.kind, thing, x: clientX, y: clientY, pointer: pointerId });
  }

  /** A finger on a thing drags it; anywhere else it scrolls. @param {TouchEvent} event */
  #onTouch(event) {
    const [finger] = event.changedTouches;
    const { world } = this.page.state();
    const loose = world && finger && isLoose(thingAt(this.places, world, finger.clientX, finger.clientY));
    if (loose && event.cancelable) event.preventDefault();
  }

  /** Nothing was dragged: what was touched is told, as by a click, which the prevented start has taken. @param {TouchEvent} event */
  #onTouchEnd(event) {
    const [finger] = event.changedTouches;
    if (!event.cancelable || this.dropped || !finger) return;
    const { clientX, clientY } = finger;
    const at = pointedAt(this.page, { target: this.surface, clientX, clientY });
    if (at?.kind !== "cell" || at.id === null || this.chosen !== null) return;
    event.preventDefault();
    this.card.show(at, true);
  }

  /** @param {MouseEvent} event */
  #onClick(event) {
    if (this.dropped) return;
    const at = pointedAt(this.page, event);
    if (at?.kind !== "cell") return;
    if (this.chosen === null) return this.card.show(at, true);
    const { world } = this;
    const cell = this.places.cellAt(event.clientX, event.clientY);
    if (world === null || cell === null) return;
    const why = hindrance(world, this.chosen, cell);
    if (why !== null) this.tell(why);
    else this.#put(this.chosen, world, cell);
  }

  /** @param {KeyboardEvent} event */
  #onKey(event) {
    if (event.key !== "Escape" || (this.held === null && this.chosen === null)) return;
    this.#end();
    this.#choose(null);
    this.dropped = true;
    event.preventDefault();
    event.stopPropagation();
  }

  /** @param {PointerEvent} event */
  #hover({ clientX, clientY, target }) {
    const { world } = this;
    const cell = target === this.surface ? this.#over(clientX, clientY) : null;
    const on = world !== null && cell !== null && onRoad(world, cell);
    this.#light(on ? cell : null, on && this.chosen !== null && hindrance(world, this.chosen, cell) === null);
  }

  /** @param {State} state */
  update({ talk }) {
    if (this.sent === null) return;
    const exchange = talk.find(({ id }) => id === this.sent);
    if (!exchange || exchange.standing === "pending") return;
    if (exchange.problem) this.tell(t("edit.not_done", { reason: exchange.problem.detail }));
    this.sent = null;
  }

  draw() {
    this.tray.draw();
    if (this.dragging) this.#aim();
  }
}
