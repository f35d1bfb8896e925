// @ts-check
/**
 * Looking at the past: which tick is looked at, and the worlds shown for it; the latest wish wins.
 *
 * The tick that is looked for is known at once (`state.look`), its world a moment later (`state.past`). Stepping loads
 * pages of ticks and prefetches the next. A jump loads one tick, and its page after a pause at that tick. Only one
 * request is under way at a time: a drag over a hundred ticks sends no hundred requests.
 */

import { MomentCache, PAGE } from "./momentCache.js";
import { errorText } from "../core/http.js";
import { changesOf } from "../talk/exchanges.js";

/** @import { Event, Past, State } from "../core/state.js" */
/** @import { Store } from "../core/store.js" */

/** Who stays so long at a tick is likely to walk on from there. */
const REST_MS = 120;
/** Ticks a second of a session that runs as fast as it can, seen again. */
const FASTEST = 64;

/**
 * @typedef {object} Around
 * @property {typeof fetch} [http]
 * @property {(work: () => void, delayMs: number) => unknown} [later]
 * @property {(timer: any) => void} [cancel]
 */

export class TimeTravel {
  /** @type {MomentCache | null} */ #cache = null;
  /** @type {any} */ #timer = null;
  /** @type {any} */ #rest = null;
  /** @type {object | null} one going on by itself; another begins another */ #going = null;
  /** @type {{cache: MomentCache} | null} the question under way */ #asking = null;
  #direction = 1;

  /** @param {Store<State, Event>} store @param {Around} [around] */
  constructor(store, { http, later = (work, ms) => setTimeout(work, ms), cancel = (timer) => clearTimeout(timer) } = {}) {
    this.store = store;
    this.http = http;
    this.later = later;
    this.cancel = cancel;
    store.subscribe((state, before) => this.#follow(state, before));
  }

  /** The tick wished for; null is the present. @returns {number | null} */
  get tick() {
    return this.store.state().look.tick;
  }

  /** Whether it goes on by itself. */
  get playing() {
    return this.store.state().look.playing;
  }

  /** The latest tick there is. */
  get now() {
    return this.store.state().world?.tick ?? 0;
  }

  /**
   * Look at a tick; at or beyond the present one, at the present.
   * @param {number} wanted
   * @returns {Promise<void>} once it is shown, or another is wished for
   */
  async at(wanted) {
    const { session } = this.store.state();
    const tick = Math.max(0, Math.round(wanted));
    if (session === null || tick >= this.now) return this.live();
    const cache = this.#cacheOf(session);
    const walked = this.tick !== null && tick !== this.tick && Math.abs(tick - this.tick) <= PAGE / 2;
    if (this.tick !== null && this.tick !== tick) this.#direction = Math.sign(tick - this.tick);
    this.#look(tick, this.playing);
    const known = cache.known(tick);
    if (known) return this.#show(known, cache, walked);
    if (this.#asking?.cache === cache) return; // it is asked for as soon as the answer under way is there
    const question = { cache };
    this.#asking = question;
    let failure = null;
    let past = null;
    try {
      past = walked || this.playing ? await cache.at(tick) : await cache.alone(tick);
    } catch (error) {
      failure = error;
    }
    if (this.#asking !== question) return; // of a session left, or a run rewritten, meanwhile
    this.#asking = null;
    if (this.tick === null) return;
    if (this.tick !== tick) return this.at(this.tick);
    if (past) return this.#show(past, cache, walked);
    this.live();
    this.store.dispatch({ type: "notice", notice: { text: errorText(failure), tone: "bad" } });
  }

  /** @param {Past} past @param {MomentCache} cache @param {boolean} walked */
  #show(past, cache, walked) {
    const { tick } = this;
    if (tick === null) return;
    this.store.dispatch({ type: "past", past });
    this.cancel(this.#rest);
    const ahead = () => {
      if (this.tick !== tick) return;
      // Beyond the present there is nothing to be had.
      for (const way of [0, this.#direction, -this.#direction]) cache.ahead(Math.min(this.now, tick + (way * PAGE) / 2));
    };
    if (walked || this.playing) ahead();
    else this.#rest = this.later(ahead, REST_MS);
  }

  /** @param {number} ticks  forwards or back */
  step(ticks) {
    this.stop();
    return this.at((this.tick ?? this.now) + ticks);
  }

  /** Look at the present again. */
  live() {
    this.stop();
    this.cancel(this.#rest);
    this.#look(null, false);
  }

  /** Go on from here at the session's own speed until the present is reached. */
  play() {
    if (this.playing || this.tick === null) return;
    this.#going = {};
    this.#look(this.tick, true);
    this.#next();
  }

  /** Go on, or stand still. */
  toggle() {
    if (this.playing) this.stop();
    else this.play();
  }

  /** Stand still. */
  stop() {
    this.cancel(this.#timer);
    this.#look(this.tick, false);
  }

  /** @param {number | null} tick @param {boolean} playing */
  #look(tick, playing) {
    if (tick !== this.tick || playing !== this.playing) this.store.dispatch({ type: "look", tick, playing });
  }

  /** @param {State} state @param {State} before */
  #follow(state, before) {
    if (state.session !== before.session) {
      this.cancel(this.#timer);
      this.cancel(this.#rest);
      this.#asking = null;
      return;
    }
    // What was just changed is to be seen.
    const latest = state.talk.at(-1);
    const answered = latest?.standing === "done" && before.talk.some(({ id, standing }) => id === latest.id && standing === "pending");
    if (answered && changesOf(latest.result).some(({ path }) => path !== "playback_speed")) {
      return this.live();
    }
    const reopened = before.past !== null && state.past === null && state.look.tick !== null;
    if (reopened || state.timeline.version !== before.timeline.version) this.#rewritten();
  }

  /** The past may have become another one: ask anew, and show what is there now. */
  #rewritten() {
    this.#cache?.clear();
    this.#asking = null;
    if (this.tick === null) return;
    if (this.tick >= this.now) this.live();
    else void this.at(this.tick);
  }

  #next() {
    const { world } = this.store.state();
    const pace = world?.pace === "max" ? FASTEST : (world?.pace ?? 1);
    const going = this.#going;
    this.#timer = this.later(
      async () => {
        if (this.tick !== null) await this.at(this.tick + 1);
        // Stopped and begun anew while that tick was on its way, it goes on already.
        if (this.playing && going === this.#going) this.#next();
      },
      Math.max(16, ((world?.stepS ?? 0.5) * 1000) / pace),
    );
  }

  /** @param {string} session */
  #cacheOf(session) {
    if (this.#cache?.session !== session) {
      this.#cache = new MomentCache(session, this.http);
      this.#asking = null;
    }
    return this.#cache;
  }
}
