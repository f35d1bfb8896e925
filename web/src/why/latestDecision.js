// @ts-check
/** Asks for the decision that led to the present tick where the stream has not told it: after a leap in time. */

import { askJson } from "../core/http.js";
import { sessionPath } from "../core/protocol.js";

/** @import { Event, State } from "../core/state.js" */
/** @import { Store } from "../core/store.js" */
/** @import { Moments } from "../core/wire.js" */

/** @param {Store<State, Event>} store @param {{http?: typeof fetch}} [around] */
export function knowLatestDecision(store, { http } = {}) {
  store.subscribe(({ session, world, decision, prior }, before) => {
    const leapt = world !== null && before.world !== null && session === before.session && world.tick !== before.world.tick;
    if (!leapt || prior !== null || decision !== null || session === null) return;
    /** @type {Promise<Moments>} */
    const asked = askJson(`${sessionPath(session)}/moments?from=${world.tick}&limit=1`, { http });
    const tell = (/** @type {Moments} */ { items: [moment] }) => {
      if (moment?.decision) store.dispatch({ type: "decision", session, decision: moment.decision });
    };
    // Without it nothing is said of the move, which is not worth a notice.
    asked.then(tell).catch(() => {});
  });
}
