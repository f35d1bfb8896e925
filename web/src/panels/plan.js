// @ts-check
/**
 * What it is about to do: nine by nine cells around the vehicle with the intended move, where movers are about to
 * be, and the moves that were rejected, each with its reason.
 *
 * While the clock runs this is the move under way; while it stands, the next one.
 */

import { html, nothing, render } from "../../vendor/lit-html.js";
import { capital, t } from "../core/texts.js";
import { readPalette } from "../core/theme.js";
import { MOVES, moveName, reasonWords } from "../core/words.js";
import { offerPlaces, same } from "../road/hitTest.js";
import { drawPlan, SPAN } from "../road/paint/plan.js";
import { egoOf } from "../road/world.js";
import { find, fitCanvas } from "../ui/slot.js";
import { foreseen, underWay } from "../why/forecast.js";
import { moveOptions } from "../why/moveOptions.js";

/** @import { Page } from "../core/page.js" */
/** @import { Cell, Decision } from "../core/protocol.js" */
/** @import { State } from "../core/state.js" */
/** @import { MoveOption } from "../why/moveOptions.js" */
/** @import { Place } from "../road/hitTest.js" */
/** @import { World } from "../road/world.js" */
/** @import { Panel } from "./index.js" */

/**
 * @typedef {object} Shown
 * @property {World} world
 * @property {Decision | null} decision
 * @property {Record<string, Cell>} next
 * @property {Cell} centre
 * @property {MoveOption[]} ways
 */

const HALF = (SPAN - 1) / 2;

/** @param {HTMLElement} host @param {HTMLElement} note  beside the title: of which tick it is @param {Page} page @returns {Panel} */
export function createPlan(host, note, page) {
  let palette = readPalette(document.documentElement);
  /** @type {Shown | null} */ let shown = null;
  /** @type {Cell | null} */ let pointed = null;
  /** @type {State["highlight"]} */ let lit = null;
  let stale = true;

  const show = () => render(template(shown, { point, pick }), host);
  show();
  const [frame, canvas] = [find(host, ".plan-frame"), /** @type {HTMLCanvasElement} */ (find(host, "canvas"))];
  offerPlaces(canvas, placesOf(canvas, () => shown));
  new ResizeObserver(() => {
    stale = true;
    page.wake();
  }).observe(frame);

  /** @param {MoveOption | null} way */
  function point(way) {
    pointed = way?.cell ?? null;
    stale = true;
    page.highlight(way && { ids: way.ids, cells: way.standing === "off_road" ? [] : [way.cell] });
  }

  /** @param {MoveOption} way */
  function pick(way) {
    if (shown?.decision && isPickable(way)) page.pick({ kind: "move", tick: shown.decision.tick, move: way.move });
  }

  return {
    update(state) {
      if (!state.views.plan) return;
      if (state.highlight !== lit) {
        lit = state.highlight;
        stale = true;
      }
      const next = sightOf(state);
      if (next === null || (next.world === shown?.world && next.decision === shown.decision)) return;
      shown = next;
      stale = true;
      render(whenText(next, state), note);
      show();
    },

    repaint() {
      palette = readPalette(document.documentElement);
      stale = true;
    },

    draw() {
      if (!stale || !shown || frame.clientWidth === 0) return false;
      stale = false;
      const side = Math.max(SPAN, Math.floor(Math.min(frame.clientWidth, frame.clientHeight)));
      canvas.style.inlineSize = canvas.style.blockSize = `${side}px`;
      drawPlan(fitCanvas(canvas, side, side), side, { ...shown, pointed, lit: litCells(lit, shown.world) }, palette);
      return false;
    },
  };
}

/**
 * @param {Shown | null} shown
 * @param {{point: (way: MoveOption | null) => void, pick: (way: MoveOption) => void}} hands
 */
function template(shown, hands) {
  const ways = shown?.ways ?? [];
  return html`<div class="plan-frame"><canvas class="plan-canvas" role="img" aria-label=${shown ? planText(shown) : t("plan.label")}></canvas></div>
    <ul class="ways" aria-label=${t("plan.moves")} ?hidden=${ways.length === 0}>
      ${ways.map((way) => html`<li>${row(way, hands)}</li>`)}
    </ul>`;
}

/** @param {MoveOption} way @param {{point: (way: MoveOption | null) => void, pick: (way: MoveOption) => void}} hands */
function row(way, { point, pick }) {
  const { move, standing, reason } = way;
  const [enter, leave] = [() => point(way), () => point(null)];
  return html`<button
    class="way"
    type="button"
    data-standing=${standing}
    aria-disabled=${String(!isPickable(way))}
    title=${isPickable(way) ? t("plan.pick", { reason }) : reason}
    @click=${() => pick(way)}
    @pointerenter=${enter}
    @focus=${enter}
    @pointerleave=${leave}
    @blur=${leave}
  ><span class="way-arrow" aria-hidden="true">${MOVES[move].arrow}</span><span class="way-name">${capital(moveName(move))}</span><span class="way-reason">${standing === "taken" && way.ids.length === 0 ? t("plan.chosen") : reason}</span></button>`;
}

/** What a person may ask about by pressing it. @param {MoveOption} way */
function isPickable({ standing }) {
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
  const ways = seen.decision ? moveOptions(seen.decision, ego.cell) : [];
  return { ...seen, centre: ego.cell, ways: state.world.mode === "manual" ? ways.map(unranked) : ways };
}

/** A move where a person drives: free or not, without what a planner would make of it. @param {MoveOption} way @returns {MoveOption} */
function unranked(way) {
  const blocked = way.standing === "blocked" || way.standing === "off_road" || way.ids.length > 0;
  return blocked ? { ...way, standing: way.standing === "taken" ? "blocked" : way.standing } : { ...way, standing: "free", reason: reasonWords("free") };
}

/** Where what is pointed at stands now; where it stood, if it is gone. @param {State["highlight"]} lit @param {World} world @returns {Cell[]} */
function litCells(lit, world) {
  if (!lit) return [];
  const there = lit.ids.map((id) => world.things.get(id)).filter((thing) => thing !== undefined);
  return there.length > 0 ? there.map(({ cell }) => cell) : lit.cells;
}

/** Of which tick the plan is. @param {Shown} shown @param {State} state */
function whenText({ decision, world }, state) {
  if (!decision) return nothing;
  return world === state.world ? t("plan.next", { tick: world.tick }) : t("plan.under_way", { tick: world.tick, next: world.tick + 1 });
}

/** The plan in words. @param {Shown} shown */
function planText({ decision, ways, next, world, centre }) {
  if (!decision) return t("plan.ended");
  const coming = [...world.things.values()].filter(({ id, cell }) => {
    const to = next[id];
    return to && !same(to, cell) && Math.abs(to[0] - centre[0]) <= 1 && centre[1] - to[1] >= 0 && centre[1] - to[1] <= 1;
  });
  const blocked = t("plan.blocked", { count: ways.filter(({ standing }) => standing === "blocked").length });
  return `${t("plan.text", { move: moveName(decision.move), blocked })} ${t("plan.coming", { count: coming.length })}`;
}

/** Where cells are on the plan. @param {HTMLCanvasElement} canvas @param {() => Shown | null} shown @returns {import("../road/hitTest.js").Places} */
function placesOf(canvas, shown) {
  return {
    cellAt(x, y) {
      const at = shown();
      if (!at) return null;
      const { left, top, width } = canvas.getBoundingClientRect();
      const cell = width / SPAN;
      return [at.centre[0] - HALF + Math.floor((x - left) / cell), at.centre[1] - HALF + Math.floor((y - top) / cell)];
    },
    /** @returns {Place | null} */
    placeOf([column, row]) {
      const at = shown();
      if (!at) return null;
      const { left, top, width } = canvas.getBoundingClientRect();
      const cell = width / SPAN;
      return { left: left + (column - at.centre[0] + HALF) * cell, top: top + (row - at.centre[1] + HALF) * cell, width: cell, height: cell };
    },
    poses: () =>
      [...(shown()?.world.things.values() ?? [])].map((thing) => ({ thing, column: thing.cell[0], row: thing.cell[1], facing: 0, scale: 1, alpha: 1, stride: 1 })),
  };
}
