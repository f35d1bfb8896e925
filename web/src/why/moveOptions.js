// @ts-check
/** The six moves of a decision, in an order that stays, each with what was found of it, in words. */

import { STEPS } from "./forecast.js";
import { nameOf } from "../road/hitTest.js";
import { counted, reasonWords } from "../core/words.js";

/** @import { Cell, Decision, Move } from "../core/protocol.js" */
/** @import { Way } from "../road/paint/plan.js" */
/** @import { World } from "../road/world.js" */

/** @typedef {Way & {reason: string, ids: string[]}} Told */

const MOVES = /** @type {Move[]} */ (Object.keys(STEPS));

/**
 * @param {Decision} decision
 * @param {Cell} from  where it was taken
 * @param {World} world
 * @returns {Told[]}
 */
export function waysOf(decision, from, world) {
  return MOVES.map((move) => {
    const [across, down] = STEPS[move];
    /** @type {Cell} */
    const cell = [from[0] + across, from[1] + down];
    const option = decision.options?.find((each) => each.move === move);
    const blocked = option ? (option.verdict === "free" ? null : option) : decision.blocked?.find((each) => each.move === move);
    const ids = blocked?.causes ?? [];
    if (blocked) {
      const standing = blocked.reason === "off_road" ? "off_road" : "blocked";
      return { move, cell, standing: decision.move === move ? "taken" : standing, reason: why(blocked.reason, ids, world), ids };
    }
    if (decision.move === move) return { move, cell, standing: "taken", reason: "free", ids };
    return { move, cell, standing: "free", reason: `free, ${behind(option?.cost, decision)}`, ids };
  });
}

/**
 * What a free move has against it: what its planner says that it costs more than the one chosen.
 * @param {number | null | undefined} cost
 * @param {Decision} decision
 */
function behind(cost, { planner, move, options }) {
  if (cost === null) return planner && !MEASURES[planner] ? "less preferred" : "but leads nowhere";
  const best = options?.find((each) => each.move === move)?.cost;
  if (cost === undefined || best === undefined || best === null || !planner || !MEASURES[planner]) return "less preferred";
  const more = Math.round((cost - best) * 10) / 10;
  return more > 0 ? MEASURES[planner](more) : "as good";
}

/** Planners that measure what a move leads to. @type {Record<string, (more: number) => string>} */
const MEASURES = {
  astar: (more) => `costs ${more} more`,
  dijkstra: (more) => `costs ${more} more`,
  bfs: (more) => `${counted(more, "tick")} later`,
};

/** @param {string} reason @param {string[]} ids @param {World} world */
function why(reason, ids, world) {
  const thing = world.things.get(ids[0]);
  const words = reasonWords(reason);
  return thing ? words.replace("something", nameOf(thing)) : words;
}
