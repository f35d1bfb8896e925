// @ts-check
/** The address carries the tick that is looked at, and a tick in the address is looked at. */

import { hashOf, momentInHash } from "../core/address.js";

/** @import { Event, State } from "../core/state.js" */
/** @import { Store } from "../core/store.js" */
/** @import { TimeTravel } from "./timeTravel.js" */

/** So long nobody has gone to another tick: the address is written no more often. */
const REST_MS = 300;

/** @param {Store<State, Event>} store @param {TimeTravel} timeTravel */
export function keepAddress(store, timeTravel) {
  /** @type {any} */ let timer = null;
  /** Whether the address has been followed: until then it is not written. */
  let followed = false;

  /** Look where the address says, once there is a run to look at. */
  function follow() {
    followed = true;
    const place = momentInHash(location.hash);
    const { session, world } = store.state();
    if (place === null || place.session !== session || !world) return;
    if (place.race) store.dispatch({ type: "comparison", other: { kind: "planners", ...place.race } });
    else if (place.tick === null) timeTravel.live();
    else void timeTravel.at(place.tick);
  }

  /** Unless the address names another session by now. It is not a step of the browser's own way back. */
  function write() {
    const { look, session } = store.state();
    if (session && !momentInHash(location.hash)?.race && momentInHash(location.hash)?.session === session) history.replaceState(null, "", hashOf(session, look.tick));
  }

  store.subscribe((state, before) => {
    if (state.session !== before.session) {
      followed = false;
      clearTimeout(timer);
    } else if (state.world && before.world === null) follow();
    if (!followed || state.look === before.look) return;
    clearTimeout(timer);
    timer = setTimeout(write, REST_MS);
  });
  addEventListener("hashchange", () => {
    clearTimeout(timer);
    follow();
  });
}
