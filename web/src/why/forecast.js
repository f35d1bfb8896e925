// @ts-check
/** What is about to happen, from the service: the next decision, and where the movers will be. */

import { askJson } from "../core/http.js";
import { sessionPath } from "../core/protocol.js";

/** @import { Cell, Decision, Move } from "../core/protocol.js" */
/** @import { State } from "../core/state.js" */
/** @import { World } from "../road/world.js" */

/**
 * @typedef {object} Foresight
 * @property {World["things"]} of  what was on the road when it was asked for
 * @property {number} tick
 * @property {Decision | null} decision
 * @property {{tick: number, movers: Record<string, Cell>}[]} ahead
 * @property {Cell[]} [path]  its own cells in the ticks to come, where they were asked for
 */

/** How far ahead is looked: at the movers, and at the vehicle's own path. */
const TICKS = 3;
const PATH_TICKS = 8;

/**
 * @param {string} session
 * @param {World} world  the one that is seen
 * @param {boolean} past  whether that is an earlier tick than the present
 * @param {{path?: boolean, http?: typeof fetch}} [wish]  `path`: whether the vehicle's own path is wanted
 * @returns {Promise<Foresight>}
 */
export async function foresee(session, world, past, { path: wanted = false, http = fetch } = {}) {
  const at = past ? `&tick=${world.tick}` : "";
  const along = wanted ? `&path=${PATH_TICKS}` : "";
  const { tick, decision, ahead, path } = await askJson(`${sessionPath(session)}/forecast?ticks=${TICKS}${along}${at}`, { http });
  return { of: world.things, tick, decision, ahead, ...(wanted ? { path } : {}) };
}

/**
 * Where movers will be in the ticks to come, as far as that was told, the next tick first.
 * @param {State} state  as it is shown
 */
export function aheadOf({ foresight, world }) {
  const tick = world?.tick ?? 0;
  if (!foresight || foresight.tick > tick) return [];
  return foresight.ahead.filter((each) => each.tick > tick).map(({ movers }) => movers);
}

/** Whether the vehicle's path over several ticks is shown. @param {State} state */
export function showsPath({ views, world }) {
  return views.perspective && views.path && world?.mode !== "manual";
}

/**
 * The path that lies before the vehicle, from where it is seen: to the cell it goes to, and on as far as that was told.
 * @param {State} state  as it is shown
 * @param {{thing: {cell: Cell}, column: number, row: number} | null} ego
 * @returns {Cell[]}  empty where none is shown
 */
export function pathOf(state, ego) {
  const { foresight, world } = state;
  if (!ego || world?.status !== "running" || !showsPath(state)) return [];
  /** @type {Cell} */ const here = [ego.column, ego.row];
  const to = ego.thing.cell;
  const gone = foresight ? world.tick - foresight.tick : -1;
  const rest = gone >= 0 ? (foresight?.path ?? []).slice(gone) : [];
  // What was told before a jump or a change leads elsewhere.
  const joined = rest.length > 0 && Math.abs(rest[0][0] - to[0]) <= 1 && Math.abs(rest[0][1] - to[1]) <= 1;
  return [here, ...(here[0] === to[0] && here[1] === to[1] ? [] : [to]), ...(joined ? rest : [])];
}

/**
 * What is known of what is about to happen on the road that is seen; null where it must be asked for.
 * @param {State} state  as it is shown
 * @returns {Foresight | null}
 */
export function foreseen({ foresight, world }) {
  return foresight && foresight.of === world?.things && foresight.tick === world.tick ? foresight : null;
}

/** Where each move leads, in columns and rows. @type {Record<Move, Cell>} */
export const STEPS = {
  forward: [0, -1],
  forward_left: [-1, -1],
  forward_right: [1, -1],
  left: [-1, 0],
  right: [1, 0],
  stay: [0, 0],
};

/**
 * The decision whose move is being made just now, with the road it was taken on; null while nothing moves, or
 * where the stream has not told the tick before.
 * @param {State} state  as it is shown
 */
export function underWay({ prior, decision, world, past }) {
  return past === null && prior && world && decision?.tick === prior.tick && world.tick === prior.tick + 1
    ? { world: prior, decision, next: cellsOf(world) }
    : null;
}

/** @param {World} world @returns {Record<string, Cell>} */
function cellsOf({ things }) {
  return Object.fromEntries([...things.values()].map(({ id, cell }) => [id, cell]));
}
