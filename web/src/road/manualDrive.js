// @ts-check
/**
 * Driving by hand: the arrow keys, or the pad over the road, each press one move.
 *
 * While the clock stands each move makes its own tick, so that one can drive move by move. What is held back because
 * its cell will not be free is said by the service, and shown here.
 */

import { make, setText } from "../ui/dom.js";
import { isArrow, isDriving, moveOf, TOGETHER_MS } from "./drivingKeys.js";
import { MOVES } from "../core/words.js";

/** @import { Page } from "../main.js" */
/** @import { Move } from "../core/protocol.js" */
/** @import { Panel } from "../panels/index.js" */

/** Where the keys mean something else. */
const BUSY = "input, textarea, select, [contenteditable], dialog, .beside, [role=slider], [role=menu], [role=listbox], [role=tablist]";
const PAD = /** @type {Move[]} */ (["forward_left", "forward", "forward_right", "left", "stay", "right"]);

const HOW = () =>
  matchMedia("(pointer: coarse)").matches
    ? "You drive: tap where to go."
    : "You drive: arrow keys, two at once for a diagonal, S to wait.";

/** @param {HTMLElement} host  the road @param {Page} page @returns {Panel} */
export function createWheel(host, page) {
  const words = make("p", { class: "drive-words", role: "status" });
  const pad = make(
    "div",
    { class: "drive-pad", role: "group", "aria-label": "Drive" },
    ...PAD.map((move) =>
      make(
        "button",
        { class: "drive-move", type: "button", "data-move": move, "aria-label": MOVES[move].name, onclick: () => drive(move) },
        move === "stay" ? "•" : MOVES[move].arrow,
      ),
    ),
  );
  const back = make(
    "button",
    { class: "drive-end", type: "button", onclick: () => void page.act([{ do: "mode", mode: "auto" }], "Let it drive itself", true) },
    "Let it drive itself",
  );
  const box = make("div", { class: "driving", hidden: true }, make("div", { class: "drive-side" }, words, back), pad);
  host.append(box);

  /** @type {Set<string>} */ const held = new Set();
  let waiting = 0;
  /** The tick of the latest move of a key held down: one a tick is enough. */
  let drivenAt = -1;
  /** The move that keys held together made: until they change it is not made again at once. */
  let last = 0;

  function manual() {
    const { world, past } = page.state();
    return world?.mode === "manual" && past === null;
  }

  /** @param {Move} move */
  function drive(move) {
    const { world } = page.state();
    if (world === null) return;
    drivenAt = world.tick;
    page.act([{ do: "drive", move }], `Drive ${MOVES[move].name}`, true);
    if (world.paused) page.act([{ do: "step", ticks: 1 }], "Step", true);
  }

  function driveHeld() {
    waiting = 0;
    const move = moveOf(held);
    if (move !== null) drive(move);
  }

  addEventListener(
    "keydown",
    (event) => {
      const { key, repeat, target } = event;
      if (!manual() || !isDriving(key) || event.ctrlKey || event.metaKey || event.altKey) return;
      if (target instanceof Element && target.closest(BUSY)) return;
      event.preventDefault();
      event.stopImmediatePropagation();
      if (repeat) {
        const { world } = page.state();
        if (world && world.tick > drivenAt && waiting === 0 && event.timeStamp - last > TOGETHER_MS * 3) driveHeld();
        return;
      }
      last = event.timeStamp;
      held.add(key);
      if (!isArrow(key)) {
        const move = moveOf([key]);
        if (move !== null) drive(move);
        return;
      }
      clearTimeout(waiting);
      waiting = setTimeout(driveHeld, TOGETHER_MS);
    },
    { capture: true },
  );
  addEventListener("keyup", ({ key }) => {
    // A key let go before the wait is over was meant all the same.
    if (waiting !== 0 && held.has(key)) {
      clearTimeout(waiting);
      driveHeld();
    }
    held.delete(key);
  });
  addEventListener("blur", () => held.clear());

  return {
    update(state, before) {
      const { world, log } = state;
      const on = world?.mode === "manual" && state.past === null;
      box.hidden = !on;
      host.toggleAttribute("data-manual", on);
      if (!on) return held.clear();
      // Nothing is driven before the next episode begins.
      pad.hidden = words.hidden = world.status !== "running";
      if (before.world?.mode !== "manual" || words.textContent === "") setText(words, HOW());
      if (log === before.log) return;
      const line = log.at(-1);
      const back = log.findLast(({ type }) => type === "held_back");
      box.toggleAttribute("data-held", !!back && !!line && back.to >= line.to - 1);
      if (back && line && back.to >= line.to - 1) setText(words, back.text);
    },
  };
}
