// @ts-check
/**
 * Driving by hand: the arrow keys, or the pad over the road, each press one move.
 *
 * While the clock stands each move makes its own tick, so that one can drive move by move. What is held back because
 * its cell will not be free is said by the service, and shown here.
 */

import { html } from "../../vendor/lit-html.js";
import { t } from "../core/texts.js";
import { MOVES, moveName } from "../core/words.js";
import { createSlot } from "../ui/slot.js";
import { isArrow, isDriving, moveOf, TOGETHER_MS } from "./drivingKeys.js";

/** @import { Page } from "../core/page.js" */
/** @import { Move } from "../core/protocol.js" */
/** @import { State } from "../core/state.js" */
/** @import { Panel } from "../panels/index.js" */

/** So many moves wait at most: a person who drives sees what comes of each. */
const MOST_WAITING = 3;
/** While the clock stands a key held down makes a move this often. */
const HELD_MS = 180;
/** Where the keys mean something else. */
const BUSY = "input, textarea, select, [contenteditable], dialog, .beside, [role=slider], [role=menu], [role=listbox], [role=tablist]";
const PAD = /** @type {Move[]} */ (["forward_left", "forward", "forward_right", "left", "stay", "right"]);

const howText = () => t(matchMedia("(pointer: coarse)").matches ? "drive.touch" : "drive.keys");

/** @param {HTMLElement} host  the road @param {HTMLElement} place  beside it @param {Page} page @returns {Panel} */
export function createManualDrive(host, place, page) {
  const show = createSlot(place);
  /** The tick of the latest move of a key held down: one a tick is enough. */
  let drivenAt = -1;
  let drivenMs = 0;
  /** The exchanges of moves that were sent while the clock ran. @type {string[]} */
  let sent = [];

  /** How many moves wait, those among them that the service has not answered yet. */
  function waiting() {
    const { queue, talk } = page.state();
    sent = sent.filter((id) => talk.some((exchange) => exchange.id === id && exchange.standing === "pending"));
    return queue.length + sent.length;
  }

  /** @param {Move} move */
  function drive(move) {
    const { world } = page.state();
    if (world === null || world.status !== "running") return; // a result stays to be seen
    if (waiting() >= MOST_WAITING) return;
    drivenAt = world.tick;
    drivenMs = performance.now();
    const id = page.act([{ do: "drive", move }], t("drive.move", { move: moveName(move) }), true);
    if (!world.paused) sent.push(id);
    else page.act([{ do: "step", ticks: 1 }], t("clock.step"), true);
  }

  const keys = watchDrivingKeys(page, drive, () => (page.state().world?.paused && performance.now() - drivenMs < HELD_MS ? Infinity : drivenAt));

  return {
    update(state) {
      const { world } = state;
      const on = world?.mode === "manual" && state.past === null;
      host.toggleAttribute("data-manual", on);
      if (!on) keys.clear();
      const back = on ? heldBack(state) : null;
      const words = back ?? (world?.paused === false ? `${howText()} ${t("drive.runs")}` : howText());
      show(template({ on, ended: world?.status !== "running", words, queue: state.queue, held: back !== null, drive, page }));
    },
  };
}

/** What the service last held back, in its words, where that was just now. @param {State} state */
function heldBack({ log }) {
  const line = log.at(-1);
  const back = log.findLast(({ type }) => type === "held_back");
  return back && line && back.to >= line.to - 1 ? back.text : null;
}

/** @param {Move} move */
const arrowOf = (move) => (move === "stay" ? "•" : (MOVES[move]?.arrow ?? move));

/**
 * @param {object} shown
 * @param {boolean} shown.on
 * @param {boolean} shown.ended  nothing is driven before the next episode begins
 * @param {string} shown.words
 * @param {string[]} shown.queue
 * @param {boolean} shown.held
 * @param {(move: Move) => void} shown.drive
 * @param {Page} shown.page
 */
function template({ on, ended, words, queue, held, drive, page }) {
  const end = () => void page.act([{ do: "mode", mode: "auto" }], t("drive.auto"), true);
  return html`<div class="driving" ?hidden=${!on} ?data-held=${held}>
    <div class="drive-side">
      <p class="drive-words" role="status" ?hidden=${ended}>${words}</p>
      <p class="drive-queue" ?hidden=${queue.length === 0}>${t("drive.next", { moves: queue.map((move) => arrowOf(/** @type {Move} */ (move))).join(" ") })}</p>
      <button class="drive-end" type="button" @click=${end}>${t("drive.auto")}</button>
    </div>
    <div class="drive-pad" role="group" aria-label=${t("drive.label")} ?hidden=${ended}>
      ${PAD.map(
        (move) =>
          html`<button class="drive-move" type="button" data-move=${move} aria-label=${moveName(move)} @click=${() => drive(move)}>${arrowOf(move)}</button>`,
      )}
    </div>
  </div>`;
}

/**
 * Keys held together make one move; keys held down make one a tick.
 * @param {Page} page
 * @param {(move: Move) => void} drive
 * @param {() => number} drivenAt  the tick of the latest move
 * @returns {Set<string>} the keys that are held
 */
function watchDrivingKeys(page, drive, drivenAt) {
  /** @type {Set<string>} */ const held = new Set();
  let waiting = 0;
  /** When keys held together made a move: until they change it is not made again at once. */
  let last = 0;

  function driveHeld() {
    clearTimeout(waiting);
    waiting = 0;
    const move = moveOf(held);
    if (move !== null) drive(move);
  }

  /** @param {KeyboardEvent} event */
  function press(event) {
    const { key, repeat, target } = event;
    const { world, past } = page.state();
    if (world?.mode !== "manual" || past !== null || !isDriving(key) || event.ctrlKey || event.metaKey || event.altKey) return;
    if (target instanceof Element && target.closest(BUSY)) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    if (repeat) {
      if (world.tick > drivenAt() && waiting === 0 && event.timeStamp - last > TOGETHER_MS * 3) driveHeld();
      return;
    }
    last = event.timeStamp;
    held.add(key);
    const alone = isArrow(key) ? null : moveOf([key]);
    if (alone !== null) return drive(alone);
    clearTimeout(waiting);
    waiting = setTimeout(driveHeld, TOGETHER_MS);
  }

  addEventListener("keydown", press, { capture: true });
  addEventListener("keyup", ({ key }) => {
    // A key let go before the wait is over was meant all the same.
    if (waiting !== 0 && held.has(key)) driveHeld();
    held.delete(key);
  });
  addEventListener("blur", () => held.clear());
  return held;
}
