// @ts-check
/** What may be asked to be otherwise, in words; and past decisions with all that spoke for and against them. */

import { askJson } from "../core/http.js";
import { sessionPath } from "../core/protocol.js";

/** @import { Action, Decision, Move } from "../core/protocol.js" */

/**
 * @typedef {{kind: "move", tick: number, move: Move}
 *   | {kind: "change", tick: number | null, actions: Action[], label: string}} Otherwise  what is otherwise, and when
 */

/**
 * A decision with its whole trace.
 * @param {string} session
 * @param {number} tick
 * @param {AbortSignal} [signal]
 * @param {typeof fetch} [http]
 * @returns {Promise<Decision>}
 */
export function fetchDecision(session, tick, signal, http) {
  return askJson(`${sessionPath(session)}/decisions/${tick}`, { signal, http });
}

/**
 * A change as the beginning of a sentence.
 * @param {Action[]} actions
 */
export function labelOf(actions) {
  const ids = actions.map((action) => (action.do === "remove" ? /** @type {{id?: string}} */ (action.where)?.id : undefined));
  if (ids.every((id) => id !== undefined)) return `If ${ids.join(" and ")} ${ids.length === 1 ? "wasn’t" : "weren’t"} there`;
  if (actions.length === 1 && actions[0].do === "remove" && actions[0].count === "all") {
    const { kind } = actions[0];
    return kind === "everything" ? "If the road were empty" : `If there were no ${kind === "vehicle" ? "car" : kind}s`;
  }
  return "With that change";
}
