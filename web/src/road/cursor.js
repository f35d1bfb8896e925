// @ts-check
/**
 * The road by keyboard: while it has the focus, the arrows move a cursor from cell to cell, and what is there is said.
 *
 * Enter opens the bubble, letters put things there, Delete takes them away, M takes hold of a thing and lets it go
 * again. Where a person drives, the arrows drive instead (`manualDrive.js`).
 */

import { html, nothing } from "../../vendor/lit-html.js";
import { sceneOf } from "../core/state.js";
import { capital, nameText, t } from "../core/texts.js";
import { lay } from "../ui/placement.js";
import { createSlot, find } from "../ui/slot.js";
import { hindrance, isLoose, moving, placing, removing, TOOLS } from "./edit.js";
import { onRoad, same, thingIn } from "./hitTest.js";
import { calledOf, cellWords, nameOf, nounOf, placeWords } from "./placeTexts.js";
import { portrait } from "./tray.js";
import { egoOf } from "./world.js";

/** @import { Kind } from "../core/wire.js" */
/** @import { Places } from "./hitTest.js" */
/** @import { Page } from "../core/page.js" */
/** @import { Cell } from "../core/protocol.js" */
/** @import { State } from "../core/state.js" */
/** @import { Thing, World } from "./world.js" */
/** @import { Card } from "../why/bubbleLoader.js" */
/** @import { Panel } from "../panels/index.js" */
/** @import { RoadActions } from "./dragDrop.js" */

const STEPS = /** @type {Record<string, Cell>} */ ({
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  PageUp: [0, -4],
  PageDown: [0, 4],
});
const REST_MS = 300;
const HINT = [
  ["↑ ↓ ← →", t("cursor.hint_cell")],
  [t("cursor.enter"), t("cursor.hint_what")],
  ...TOOLS.map(({ kind, key }) => [key.toUpperCase(), nounOf({ kind })]),
  ["M", t("cursor.hint_move")],
  [t("cursor.delete"), t("cursor.hint_remove")],
];

/**
 * @param {HTMLElement} host  what lies over the road's picture and takes the focus
 * @param {Places} places
 * @param {Page} page
 * @param {Card} card
 * @param {RoadActions} actions
 * @returns {Panel}
 */
export function createCursor(host, places, page, card, actions) {
  const cursor = new Cursor(host, places, page, card, actions);
  return {
    commands: [
      {
        name: "cursor",
        group: t("groups.road"),
        key: "g",
        keyName: "G",
        now: ({ world }) => world && { label: t("cursor.act"), run: () => cursor.focus() },
      },
    ],
    update: (state, before) => cursor.update(state, before),
    draw() {
      cursor.place();
      return false;
    },
  };
}

class Cursor {
  /** @type {Cell | null} */ cell = null;
  /** @type {Thing | null} */ grabbed = null;
  /** What is said of the cell. */ spoken = "";
  /** Whether the keys were used last: the pointer has a mark of its own. */ byKeys = false;
  #rest = 0;

  /**
   * @param {HTMLElement} host
   * @param {Places} places
   * @param {Page} page
   * @param {Card} card
   * @param {RoadActions} actions
   */
  constructor(host, places, page, card, actions) {
    this.host = host;
    this.places = places;
    this.page = page;
    this.card = card;
    this.actions = actions;
    const road = /** @type {HTMLElement} */ (host.parentElement);
    this.slot = createSlot(road, host.nextSibling);
    this.show();
    this.mark = find(road, ".cell-cursor");
    host.addEventListener("keydown", (event) => this.#onKey(event));
    host.addEventListener("focus", () => this.#onFocus());
    host.addEventListener("blur", () => this.#onBlur());
    host.addEventListener("pointerdown", (event) => this.#onPointer(event));
  }

  get world() {
    return sceneOf(this.page.state()).world;
  }

  show() {
    const picture = this.grabbed ? portrait(this.places, this.grabbed.kind, this.grabbed.id) : nothing;
    this.slot(
      html`<div class="cell-cursor" hidden ?data-holding=${this.grabbed !== null}>${picture}</div>
        <p class="unseen" aria-live="polite">${this.spoken}</p>
        <p class="cursor-hint" id="cursor-hint">${HINT.map(([key, what]) => html`<span><kbd>${key}</kbd> ${what}</span>`)}</p>`,
    );
  }

  /** @param {State} state @param {State} before */
  update({ world, session }, before) {
    if (session !== before.session) {
      this.cell = null;
      this.letGo();
    }
    if (world !== null && this.cell !== null && document.activeElement === this.host) this.#carry(world, this.cell);
  }

  place() {
    const at = this.byKeys && this.cell ? this.places.placeOf(this.cell) : null;
    const shown = at !== null && document.activeElement === this.host && this.world?.mode !== "manual";
    this.mark.hidden = !shown;
    if (shown) lay(this.mark, at);
  }

  focus() {
    this.host.focus({ preventScroll: true });
    const { world } = this;
    if (world === null || world.mode === "manual") return;
    this.byKeys = true;
    this.go(this.#start(world));
  }

  /** @param {Cell} next @param {boolean} [aloud] */
  go(next, aloud = true) {
    const { world } = this;
    if (world === null) return;
    this.cell = [clamp(next[0], world.columns - 1), clamp(next[1], world.rows - 1)];
    this.place();
    if (!aloud) return;
    this.spoken = capital(cellWords(world, this.cell));
    this.show();
    this.card.hide();
    clearTimeout(this.#rest);
    if (this.grabbed === null) this.#rest = setTimeout(() => this.#tellMore(), REST_MS);
  }

  /** Escape while holding: it stays where it is. */
  letGo() {
    if (this.grabbed === null) return;
    this.grabbed = null;
    this.show();
  }

  /** @param {boolean} [pin] */
  #tellMore(pin = false) {
    const { world, cell, places, host } = this;
    if (world === null || cell === null || (!pin && document.activeElement !== host)) return;
    this.card.show({ kind: "cell", cell, id: thingIn(world, cell)?.id ?? null, places, frame: host }, pin, pin);
  }

  /** Where it was, or before the vehicle. @param {World} world @returns {Cell} */
  #start(world) {
    return this.cell !== null && onRoad(world, this.cell) ? this.cell : ahead(world);
  }

  /** What left the view below is carried along with it. @param {World} world @param {Cell} cell */
  #carry(world, [column, at]) {
    const frame = this.host.getBoundingClientRect();
    const lowest = this.places.cellAt(frame.left, frame.bottom - 8);
    const highest = this.places.cellAt(frame.left, frame.top + 8);
    if (!lowest || !highest || at >= world.rows) return;
    const row = Math.max(highest[1], Math.min(lowest[1], at));
    if (row !== at) this.go([column, row], false);
  }

  /** @param {KeyboardEvent} event */
  #onKey(event) {
    const { world } = this;
    if (event.target !== this.host || event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
    if (world === null || world.mode === "manual") return;
    this.byKeys = true;
    if (!this.#press(event, world)) return;
    event.preventDefault();
    event.stopPropagation();
  }

  /** @param {KeyboardEvent} event @param {World} world @returns {boolean} whether the key was for the cursor */
  #press({ key, repeat }, world) {
    const at = this.cell ?? ahead(world);
    const step = STEPS[key];
    const tool = TOOLS.find((each) => each.key === key.toLowerCase());
    if (step) this.go(this.cell === null ? at : [at[0] + step[0], at[1] + step[1]]);
    else if (key === "Home") this.go(ahead(world));
    else if (repeat) return tool !== undefined;
    else if (key === "Escape" && this.grabbed !== null) {
      this.#say(t("cursor.stays", { id: capital(calledOf(world, this.grabbed)) }));
      this.letGo();
    } else if (key === "m" || key === "M" || (key === "Enter" && this.grabbed !== null)) this.#takeOrPut(world, at);
    else if (key === "Enter") {
      clearTimeout(this.#rest);
      this.go(at, false);
      this.#tellMore(true);
    } else if (key === "Delete" || key === "Backspace") this.#remove(world, at);
    else if (tool) this.#put(tool.kind, world, at);
    else return false;
    return true;
  }

  /** @param {World} world @param {Cell} at */
  #takeOrPut(world, at) {
    if (this.grabbed === null) return this.#take(thingIn(world, at));
    const thing = world.things.get(this.grabbed.id);
    if (!thing) {
      this.letGo();
      return this.#say(t("cursor.gone"));
    }
    const why = hindrance(world, thing.kind, at, thing.id);
    if (why !== null) return this.#say(why);
    this.letGo();
    if (!same(thing.cell, at)) this.actions.runCommand(moving(thing, at), t("edit.move", { id: calledOf(world, thing), place: placeWords(world, at) }));
  }

  /** @param {Thing | null} thing */
  #take(thing) {
    if (!isLoose(thing)) return this.#say(t(thing ? "cursor.drives_itself_move" : "cursor.nothing_to_move"));
    this.grabbed = thing;
    this.show();
    this.card.hide();
    this.#say(t("cursor.holding", { id: nameText("the", thing.kind) }));
  }

  /** @param {World} world @param {Cell} at */
  #remove(world, at) {
    const thing = thingIn(world, at);
    if (isLoose(thing)) this.actions.runCommand(removing(thing), t("edit.take_off", { id: calledOf(world, thing) }));
    else this.#say(t(thing ? "cursor.drives_itself_remove" : "cursor.nothing_to_remove"));
  }

  /** @param {Kind} kind @param {World} world @param {Cell} at */
  #put(kind, world, at) {
    const why = hindrance(world, kind, at);
    if (why !== null) this.#say(why);
    else this.actions.runCommand(placing(kind, at), t("edit.put", { thing: nameOf({ kind }), place: placeWords(world, at) }));
  }

  /** @param {string} text */
  #say(text) {
    clearTimeout(this.#rest);
    this.actions.tell(text);
  }

  #onFocus() {
    const { world } = this;
    if (world === null || !this.host.matches(":focus-visible")) return;
    this.byKeys = true;
    this.go(this.#start(world), world.mode !== "manual");
  }

  #onBlur() {
    clearTimeout(this.#rest);
    this.letGo();
    this.place();
    this.card.leave();
  }

  /** @param {PointerEvent} event */
  #onPointer({ clientX, clientY }) {
    this.byKeys = false;
    this.letGo();
    const { world } = this;
    const at = this.places.cellAt(clientX, clientY);
    if (world !== null && at !== null && onRoad(world, at)) this.cell = at;
    this.place();
  }
}

/** Where the cursor begins: before the vehicle. @param {World} world @returns {Cell} */
function ahead(world) {
  const ego = egoOf(world);
  return ego ? [ego.cell[0], Math.max(0, ego.cell[1] - 2)] : [0, world.rows - 1];
}

/** @param {number} value @param {number} most */
function clamp(value, most) {
  return Math.max(0, Math.min(most, value));
}
