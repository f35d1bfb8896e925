// @ts-check
/** Follows the session that the page's address names: makes one where it names none, and keeps its stream open. */

import { hashOf, placeInHash } from "./address.js";
import { errorText } from "./http.js";
import { newestOnly } from "./latest.js";
import { createScenario, createSession, findSession, openLink } from "./sessions.js";
import { Connection } from "./socket.js";
import { t } from "./texts.js";

/** @import { ClientMessage } from "./protocol.js" */
/** @import { Event, State } from "./state.js" */
/** @import { Store } from "./store.js" */

export class Connector {
  /** @type {Connection | null} */ #connection = null;
  /** The newest navigation: a session created for an older one that arrives late is ignored. */
  #going = newestOnly();

  /** Called with each picture that the service sends. @type {Set<(data: ArrayBuffer) => void>} */ pictures = new Set();

  /** @param {Store<State, Event>} store */
  constructor(store) {
    this.store = store;
  }

  /** Go where the address says. */
  follow() {
    const place = placeInHash(location.hash);
    if (place === null) return void this.startSession();
    if ("scenario" in place) return void this.#openScenario(place.scenario);
    if ("carried" in place) return void this.#openCarried(place.carried);
    if (place.session === this.#connection?.session) return;
    this.#going();
    this.#leave(place.session);
    this.#connection = new Connection(place.session, {
      page: location,
      find: findSession,
      onMessage: this.store.dispatch,
      onPicture: (data) => this.pictures.forEach((call) => call(data)),
      onPhase: (phase) => this.store.dispatch({ type: "phase", phase }),
    });
    void this.#connection.open();
  }

  /** Make a session, and go there. */
  async startSession() {
    const newest = this.#going();
    try {
      const { id } = await createSession();
      if (newest()) location.hash = hashOf(id);
    } catch (error) {
      if (newest()) this.store.dispatch({ type: "trouble", text: errorText(error) });
    }
  }

  /** Connect now rather than after the pause. */
  reconnect() {
    void this.#connection?.open();
  }

  /** @param {ClientMessage} message @returns {boolean} whether it was sent */
  send(message) {
    return this.#connection?.send(message) ?? false;
  }

  /** A session on a road of the gallery; it takes the link's place. @param {string} name */
  async #openScenario(name) {
    const newest = this.#going();
    const { scenarioNamed } = await import("../timeline/scenarios.js");
    const found = scenarioNamed(name);
    try {
      const { id } = await (found ? createScenario(found) : createSession());
      if (newest()) location.replace(hashOf(id));
    } catch (error) {
      if (newest()) this.store.dispatch({ type: "trouble", text: errorText(error) });
    }
  }

  /** A session out of the address itself; it takes the link's place, so that going back does not make another. @param {string} link */
  async #openCarried(link) {
    const newest = this.#going();
    this.#leave("");
    try {
      const { id } = await openLink(link);
      if (newest()) location.replace(hashOf(id));
    } catch (error) {
      if (newest()) this.store.dispatch({ type: "trouble", text: t("page.link_not_opened", { reason: errorText(error) }) });
    }
  }

  /** @param {string} id  of the session that comes instead */
  #leave(id) {
    this.#connection?.close();
    this.#connection = null;
    this.store.dispatch({ type: "session", id });
  }
}
