// @ts-check
/** What the pointer rests on and what has the focus in the log, shown in the bubble. */

import { onRoad, thingAt, viewUnder } from "../road/hitTest.js";
import { sceneOf } from "../core/state.js";
import { alike } from "./bubbleLoader.js";

/** @import { Page } from "../core/page.js" */
/** @import { Card, Target } from "./bubbleLoader.js" */

const REST_MS = 350;
/** On a free cell there is less to say, and the pointer is more often only parked there. */
const FREE_REST_MS = 800;

/**
 * The cell, thing or decision an event points at.
 * @param {Page} page
 * @param {{target: EventTarget | null, clientX: number, clientY: number}} event
 * @returns {Target | null}
 */
export function pointedAt(page, { target: over, clientX: x, clientY: y }) {
  if (!(over instanceof Element) || over.closest("button, input, .verdict, dialog, .tray")) return null;
  const row = over.closest(".log-line");
  if (row instanceof HTMLElement) return decisionOf(row);
  const view = viewUnder(over);
  const { world } = sceneOf(page.state());
  const cell = view?.places.cellAt(x, y);
  if (!view || !cell || world === null || !onRoad(world, cell)) return null;
  const thing = thingAt(view.places, world, x, y);
  const frame = /** @type {HTMLElement} */ (view.element);
  return { kind: "cell", cell: thing?.cell ?? cell, id: thing?.id ?? null, places: view.places, frame };
}

/** The decision that a line of the log tells. @param {HTMLElement} row @returns {Target | null} */
function decisionOf(row) {
  const { type, tick } = row.dataset;
  return type !== "tick" || tick === undefined ? null : { kind: "decision", tick: Number(tick), frame: row };
}

/** @param {Page} page @param {Card} card @param {HTMLElement} log */
export function watchPointing(page, card, log) {
  watchPointer(page, card);
  watchLog(page, card, log);
}

/** What the pointer rests on. @param {Page} page @param {Card} card */
function watchPointer(page, card) {
  let rest = 0;

  addEventListener("pointermove", (event) => {
    clearTimeout(rest);
    if (event.pointerType === "touch" || event.buttons !== 0 || card.pinned() || document.querySelector(".menu-list:popover-open")) return;
    if (event.target instanceof Element && event.target.closest("#bubble")) return card.stay();
    const next = pointedAt(page, event);
    const shown = card.target();
    if (next !== null && shown !== null && alike(shown, next)) return card.stay();
    if (shown !== null) card.leave();
    if (next === null) return;
    const free = next.kind === "cell" && next.id === null;
    rest = setTimeout(() => card.show(next), free ? FREE_REST_MS : REST_MS);
  });
  addEventListener("pointerdown", () => clearTimeout(rest));
  document.documentElement.addEventListener("pointerleave", () => {
    clearTimeout(rest);
    card.leave();
  });

}

/** The lines of the log by keyboard: from line to line with the arrows, into the bubble with Enter. @param {Page} page @param {Card} card @param {HTMLElement} log */
function watchLog(page, card, log) {
  log.addEventListener("keydown", (event) => {
    if (!(event.target instanceof HTMLElement) || event.target instanceof HTMLButtonElement) return;
    const rows = /** @type {HTMLElement[]} */ ([...log.querySelectorAll('.log-line[data-type="tick"]')]);
    const step = { ArrowUp: -1, ArrowDown: 1 }[event.key] ?? 0;
    if (step !== 0 && rows.length > 0) {
      const at = rows.indexOf(event.target);
      const row = rows[at === -1 ? rows.length - 1 : Math.max(0, Math.min(rows.length - 1, at + step))];
      row.tabIndex = -1;
      row.focus();
    } else if (event.key !== "Enter" || card.target()?.kind !== "decision" || !card.focus()) return;
    event.preventDefault();
    event.stopPropagation();
  });
  log.addEventListener("focusin", ({ target: row, relatedTarget: from }) => {
    if (!(row instanceof HTMLElement) || !row.matches(".log-line:focus-visible")) return;
    if (from instanceof Element && from.closest("#bubble")) return; // which was just sent away
    const next = decisionOf(row);
    if (next) card.show(next);
  });
  log.addEventListener("focusout", () => {
    if (card.target()?.kind === "decision") card.leave();
  });
  log.addEventListener("click", (event) => {
    const next = pointedAt(page, event);
    if (next) card.show(next, true);
  });
}
