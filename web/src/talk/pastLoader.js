// @ts-check
/**
 * Asks, once for each session that is opened, for the decisions that its log does not tell by itself; what was said comes
 * with the timeline's own question (`timelineLoader.js`).
 */

import { askJson } from "../core/http.js";
import { sessionPath } from "../core/protocol.js";

/** @import { Event, State } from "../core/state.js" */
/** @import { Store } from "../core/store.js" */
/** @import { Told } from "./pastLines.js" */

/** How many decisions are asked for. */
const DECISIONS = 60;

/** @param {Store<State, Event>} store @param {typeof fetch} [http] */
export function loadPastLines(store, http) {
  /** @type {string | null} */ let asked = null;
  /** Decisions that wait for what was said. @type {Told[] | null} */ let waiting = null;

  store.subscribe(({ session, world, connection, roadChanges }) => {
    if (session !== asked) waiting = null;
    if (waiting !== null && roadChanges !== null) {
      const decisions = waiting;
      waiting = null;
      store.dispatch({ type: "past-lines", decisions, changes: roadChanges });
    }
    if (!session || session === asked || connection.phase !== "live" || !world) return;
    asked = session;
    if (world.tick > 0) void load(session);
  });

  /** @param {string} session */
  async function load(session) {
    /** @type {{items: Told[]}} */
    const { items } = await askJson(`${sessionPath(session)}/decisions?limit=${DECISIONS}`, { http }).catch(() => ({ items: [] })); // the log tells its events as it is
    const { session: now, roadChanges } = store.state();
    if (now !== session || items.length === 0) return;
    if (roadChanges === null) waiting = items;
    else store.dispatch({ type: "past-lines", decisions: items, changes: roadChanges });
  }
}
