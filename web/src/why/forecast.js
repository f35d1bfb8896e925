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
 */

/** How far ahead is looked. */
const TICKS = 3;

/**
 * @param {string} session
 * @param {World} world  the one that is seen
 * @param {boolean} past  whether that is an earlier tick than the present
 * @param {typeof fetch} [http]
 * @returns {Promise<Foresight>}
 */
export async function foresee(session, world, past, http = fetch) {
  const at = past ? `&tick=${world.tick}` : "";
  const { tick, decision, ahead } = await askJson(`${sessionPath(session)}/forecast?ticks=${TICKS}${at}`, { http });
  return { of: world.things, tick, decision, ahead };
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
