// @ts-check
/**
 * What it is about to do: nine by nine cells around the vehicle with the intended move, where movers are about to
 * be, and the moves that were rejected, each with its reason.
 *
 * While the clock runs this is the move under way; while it stands, the next one.
 */

import { make, setText } from "../ui/dom.js";
import { foreseen, underWay } from "../why/forecast.js";
import { offerPlaces, same } from "../road/hitTest.js";
import { drawPlan, SPAN } from "../road/paint/plan.js";
import { readPalette } from "../core/theme.js";
import { waysOf } from "../why/moveOptions.js";
import { MOVES } from "../core/words.js";
import { egoOf } from "../road/world.js";

/** @import { Page } from "../main.js" */
/** @import { Cell, Decision } from "../core/protocol.js" */
/** @import { State } from "../core/state.js" */
/** @import { Told } from "../why/moveOptions.js" */
/** @import { World } from "../road/world.js" */
/** @import { Panel } from "./index.js" */

/**
 * @typedef {object} Shown
 * @property {World} world
 * @property {Decision | null} decision
 * @property {Record<string, Cell>} next
 * @property {Cell} centre
 * @property {Told[]} ways
 */

/** @param {HTMLElement} host @param {Page} page @returns {Panel} */
export function createPlan(host, page) {
  const canvas = make("canvas", { class: "plan-canvas", role: "img", "aria-label": "The cells around the vehicle" });
  const frame = make("div", { class: "plan-frame" }, canvas);
  const list = make("ul", { class: "ways", "aria-label": "The six moves", hidden: true });
  host.append(frame, list);
  const when = make("span", { class: "panel-note" });
  host.parentElement?.querySelector(".panel-title")?.append(when);
  const pen = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
  let palette = readPalette(document.documentElement);
  /** @type {Shown | null} */ let shown = null;
  /** @type {Cell | null} */ let pointed = null;
  let stale = true;
  const rows = Object.keys(MOVES).map(() => rowOf());
  new ResizeObserver(() => {
    stale = true;
    page.wake();
  }).observe(frame);

  /** One move's line, filled anew with each decision. */
  function rowOf() {
    const arrow = make("span", { class: "way-arrow", "aria-hidden": "true" });
    const name = make("span", { class: "way-name" });
    const reason = make("span", { class: "way-reason" });
    const button = make("button", { class: "way", type: "button" }, arrow, name, reason);
    list.append(make("li", {}, button));
    /** @type {Told | null} */ let told = null;
    button.addEventListener("click", () => {
      if (told && shown?.decision && pickable(told)) page.pick?.({ kind: "move", tick: shown.decision.tick, move: told.move });
    });
    const point = () => told && show(told);
    for (const event of ["pointerenter", "focus"]) button.addEventListener(event, point);
    for (const event of ["pointerleave", "blur"]) button.addEventListener(event, () => show(null));
    return {
      /** @param {Told} way */
      fill(way) {
        told = way;
        setText(arrow, MOVES[way.move].arrow);
        setText(name, way.move === "stay" ? "Stay" : MOVES[way.move].name.replace(/^./, (first) => first.toUpperCase()));
        setText(reason, way.standing === "taken" && way.reason === "free" ? "chosen" : way.reason);
        button.dataset.standing = way.standing;
        button.setAttribute("aria-disabled", String(!pickable(way)));
        button.title = pickable(way) ? `${way.reason}. Press to see what would have come of it` : way.reason;
      },
    };
  }

  /** @param {Told | null} way */
  function show(way) {
    pointed = way?.cell ?? null;
    stale = true;
    page.highlight(way && { ids: way.ids, cells: way.standing === "off_road" ? [] : [way.cell] });
  }

  offerPlaces(canvas, {
    cellAt(x, y) {
      if (!shown) return null;
      const { left, top, width } = canvas.getBoundingClientRect();
      const cell = width / SPAN;
      const half = (SPAN - 1) / 2;
      return [shown.centre[0] - half + Math.floor((x - left) / cell), shown.centre[1] - half + Math.floor((y - top) / cell)];
    },
    placeOf([column, row]) {
      if (!shown) return null;
      const { left, top, width } = canvas.getBoundingClientRect();
      const cell = width / SPAN;
      const half = (SPAN - 1) / 2;
      return { left: left + (column - shown.centre[0] + half) * cell, top: top + (row - shown.centre[1] + half) * cell, width: cell, height: cell };
    },
    poses: () => [...(shown?.world.things.values() ?? [])].map((thing) => ({ thing, column: thing.cell[0], row: thing.cell[1], facing: 0, scale: 1, alpha: 1, stride: 1 })),
  });

  return {
    update(state) {
      if (!state.views.plan) return;
      const next = sightOf(state);
      if (next === null || (next.world === shown?.world && next.decision === shown.decision)) return;
      shown = next;
      stale = true;
      const { decision, world, ways } = next;
      setText(when, decision ? (world === state.world && !state.past ? `next, at tick ${world.tick}` : `tick ${world.tick} → ${world.tick + 1}`) : "");
      ways.forEach((way, at) => rows[at].fill(way));
      list.hidden = ways.length === 0;
      canvas.setAttribute("aria-label", describePlan(next));
    },

    repaint() {
      palette = readPalette(document.documentElement);
      stale = true;
    },

    draw() {
      if (!stale || !shown || frame.clientWidth === 0) return false;
      stale = false;
      const side = Math.max(SPAN, Math.floor(Math.min(frame.clientWidth, frame.clientHeight)));
      const ratio = Math.min(2, devicePixelRatio || 1);
      if (canvas.width !== Math.round(side * ratio)) {
        canvas.width = canvas.height = Math.round(side * ratio);
        canvas.style.inlineSize = canvas.style.blockSize = `${side}px`;
      }
      pen.setTransform(ratio, 0, 0, ratio, 0, 0);
      drawPlan(pen, side, { ...shown, pointed }, palette);
      return false;
    },
  };
}

/** What a person may ask about by pressing it. @param {Told} way */
function pickable({ standing }) {
  return standing === "free" || standing === "blocked";
}

/**
 * The next decision where it is known, else the one under way, else nothing new.
 * @param {State} state
 * @returns {Shown | null}
 */
export function sightOf(state) {
  const known = foreseen(state);
  const moving = underWay(state);
  if (!state.world) return null;
  const running = !state.world.paused && moving !== null;
  const seen =
    known && !running
      ? { world: state.world, decision: known.decision, next: known.ahead[0]?.movers ?? {} }
      : moving;
  const ego = seen && egoOf(seen.world);
  if (!seen || !ego) return null;
  return { ...seen, centre: ego.cell, ways: seen.decision ? waysOf(seen.decision, ego.cell, seen.world) : [] };
}

/** @param {Shown} shown */
function describePlan({ decision, ways, next, world, centre }) {
  if (!decision) return "The episode has ended: no move is intended.";
  const coming = [...world.things.values()].filter(({ id, cell }) => {
    const to = next[id];
    return to && !same(to, cell) && Math.abs(to[0] - centre[0]) <= 1 && centre[1] - to[1] >= 0 && centre[1] - to[1] <= 1;
  });
  const rejected = ways.filter(({ standing }) => standing === "blocked").length;
  const movers = coming.length === 1 ? "One mover comes" : `${coming.length || "No"} movers come`;
  return `Intended: ${MOVES[decision.move].name}. ${rejected} of six moves are blocked. ${movers} next to it.`;
}
