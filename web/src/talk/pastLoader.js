// @ts-check
/** Asks, once for each session that is opened, for what its log does not tell by itself: decisions and words. */

import { askJson } from "../core/http.js";
import { sessionPath } from "../core/protocol.js";

/** @import { Event, State } from "../core/state.js" */
/** @import { Store } from "../core/store.js" */

/** How many decisions are asked for. */
const DECISIONS = 60;

/** @param {Store<State, Event>} store @param {typeof fetch} [http] */
export function loadPastLines(store, http) {
  /** @type {string | null} */ let asked = null;
  store.subscribe(({ session, world, connection }) => {
    if (!session || session === asked || connection.phase !== "live" || !world) return;
    asked = session;
    if (world.tick > 0) void load(session);
  });

  /** @param {string} session */
  async function load(session) {
    try {
      const [{ items: decisions }, { items: changes }] = await Promise.all(
        [`decisions?limit=${DECISIONS}`, "changes?limit=1000"].map((what) => askJson(`${sessionPath(session)}/${what}`, { http })),
      );
      if (store.state().session === session) store.dispatch({ type: "past-lines", decisions, changes });
    } catch {
      // The log tells its events as it is.
    }
  }
}
