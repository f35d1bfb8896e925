// @ts-check
/** Asks what decisions have lost, while the metrics are seen: stretches of ticks, and not too often while the clock runs. */

import { askJson, errorText } from "../core/http.js";
import { sessionPath } from "../core/protocol.js";
import { missingFrom, WINDOW } from "./regret.js";

/** @import { Event, State } from "../core/state.js" */
/** @import { Store } from "../core/store.js" */
/** @import { Judged } from "../core/wire.js" */

/** While the clock runs it is asked for this much at once, and no more often than this. */
const STRETCH = 8;
const APART_MS = 3_000;

/** The tick that is looked at. @param {State} state */
const tickOf = ({ past, world }) => (past?.world ?? world)?.tick ?? 0;

export class RegretLoader {
  #asking = false;
  #askedAt = -Infinity;

  /** @param {Store<State, Event>} store @param {{http?: typeof fetch, now?: () => number, seen?: () => boolean}} [around] */
  constructor(store, { http, now = () => performance.now(), seen = () => !document.hidden } = {}) {
    this.store = store;
    this.http = http;
    this.now = now;
    this.seen = seen;
    store.subscribe((state, before) => {
      if (state.regret.age !== before.regret.age || state.session !== before.session) this.#askedAt = -Infinity;
      const same = state.world === before.world && state.past === before.past && state.views === before.views && state.connection === before.connection;
      if (!same) void this.fill();
    });
  }

  /** Ask for what is missing before the tick that is looked at, when it is time. */
  async fill() {
    const { connection, past, regret, session, views, world } = this.store.state();
    if (this.#asking || !session || !world || !views.metrics || connection.phase !== "live" || !this.seen()) return;
    const tick = tickOf(this.store.state());
    const from = missingFrom(regret, tick);
    if (from === null) return;
    const running = past === null && !world.paused && world.status === "running";
    if (running && (tick - from < STRETCH || this.now() - this.#askedAt < APART_MS)) return;
    this.#asking = true;
    this.#askedAt = this.now();
    const { age } = regret;
    const here = () => this.store.state().session === session;
    try {
      /** @type {Judged} */
      const { items, now } = await askJson(`${sessionPath(session)}/regret?from=${from}&limit=${WINDOW}`, { http: this.http });
      if (here()) this.store.dispatch({ type: "regret", age, from, items, now });
    } catch (error) {
      if (here()) this.store.dispatch({ type: "regret-trouble", text: errorText(error) });
    } finally {
      this.#asking = false;
    }
    // What came meanwhile was not asked for, and what was told of a run that is no more is not kept.
    const state = this.store.state();
    if (tickOf(state) !== tick || state.regret.age !== age || !here()) await this.fill();
  }
}
