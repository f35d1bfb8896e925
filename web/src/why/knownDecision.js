// @ts-check
/** Which decision is known to have led to the road that is there now. Part of the state. */

/** @import { Decision, WireState } from "../core/protocol.js" */
/** @import { State } from "../core/state.js" */

/**
 * The decision that led to the road that is there now: none known where that is another tick, or another road.
 * @param {State} state
 * @param {WireState} next
 * @returns {Pick<State, "decision" | "narration">}
 */
export function decisionAfter({ decision, narration, world }, { tick, episode }) {
  const led = decision?.tick === tick - 1 && world?.episode === episode;
  return led ? { decision, narration } : { decision: null, narration: null };
}

/**
 * With the latest decision, which was asked for; one that comes late is of no use.
 * @param {State} state
 * @param {string} session
 * @param {Decision} decision
 * @returns {State}
 */
export function withDecision(state, session, decision) {
  if (state.session !== session || state.decision !== null || decision.tick + 1 !== state.world?.tick) return state;
  return { ...state, decision, narration: decision.narration ?? null };
}
