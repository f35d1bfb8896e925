// @ts-check
/** Asks for the decision that led to the present tick where the stream has not told it: after a leap in time. */

import { fetchDecision } from "./alternatives.js";

/** @import { Event, State } from "../core/state.js" */
/** @import { Store } from "../core/store.js" */

/** @param {Store<State, Event>} store @param {{http?: typeof fetch}} [around] */
export function knowLatestDecision(store, { http } = {}) {
  store.subscribe(({ session, world, decision, prior }, before) => {
    const leapt = world !== null && before.world !== null && session === before.session && world.tick !== before.world.tick;
    if (!leapt || prior !== null || decision !== null || session === null || world.tick === 0 || world.status !== "running") return;
    const asked = fetchDecision(session, world.tick - 1, new AbortController().signal, http);
    // None was taken where a result stood: then there is nothing to tell.
    asked.then((found) => store.dispatch({ type: "decision", session, decision: found })).catch(() => {});
  });
}
