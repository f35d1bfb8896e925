// @ts-check
/**
 * How good and how tight each decision was: moves blocked, from the stream; ticks lost against the best, from the
 * service, which has to search for it and is asked for stretches and not too often.
 */

import { askJson } from "../core/http.js";
import { sessionPath } from "../core/protocol.js";

/**
 * @typedef {object} Judged
 * @property {number} blocked  of the six moves
 * @property {number | null} [ticks]  lost; null where the goal is out of reach; not there while it is not known
 * @property {boolean} [lost]  whether this move has put the goal out of reach
 */

/** How many ticks are looked back over. */
export const WINDOW = 60;
const KEPT = 1_000;
/** While the clock runs it is asked for this much at once, and no more often than this. */
const STRETCH = 8;
const APART_MS = 3_000;

export class Book {
  /** @type {Map<number, Judged | null>} null where no decision was taken */ items = new Map();
  /** @type {string | null} */ session = null;
  #asking = false;
  #askedAt = -Infinity;
  /** Raised when the run becomes another. */ age = 0;

  /** @param {{http?: typeof fetch, now?: () => number}} [with_] */
  constructor({ http, now = () => performance.now() } = {}) {
    this.http = http;
    this.now = now;
  }

  /** The run has become another from a tick on. @param {number} [tick] */
  forget(tick = 0) {
    this.age += 1;
    this.#askedAt = -Infinity;
    for (const each of this.items.keys()) if (each >= tick) this.items.delete(each);
  }

  /** What a tick's message tells. @param {number} tick @param {number | null} blocked */
  note(tick, blocked) {
    if (!this.items.has(tick)) this.items.set(tick, blocked === null ? null : { blocked });
    if (this.items.size > KEPT) this.items.delete(/** @type {number} */ (this.items.keys().next().value));
  }

  /** The first tick before `tick` whose loss is not known; null where all are. @param {number} tick */
  missing(tick) {
    for (let each = Math.max(0, tick - WINDOW); each < tick; each++) {
      const item = this.items.get(each);
      if (item === undefined || (item !== null && item.ticks === undefined)) return each;
    }
    return null;
  }

  /**
   * Ask for what is missing before a tick, when it is time. Answers whether there is something new.
   * @param {number} tick
   * @param {boolean} running  whether ticks follow each other: then stretches are waited for
   * @returns {Promise<boolean>} throws `Refused`
   */
  async fill(tick, running) {
    const from = this.missing(tick);
    if (from === null || this.#asking || this.session === null) return false;
    if (running && (tick - from < STRETCH || this.now() - this.#askedAt < APART_MS)) return false;
    this.#asking = true;
    this.#askedAt = this.now();
    const [age, path] = [this.age, `${sessionPath(this.session)}/regret?from=${from}&limit=${WINDOW}`];
    try {
      const { items, now } = await askJson(path, { http: this.http });
      if (age !== this.age) return true; // about a run that is no more: to be asked for again
      const told = new Map(items.map((/** @type {Judged & {tick: number}} */ item) => [item.tick, item]));
      for (let each = from; each < Math.min(from + WINDOW, now); each++) this.items.set(each, told.get(each) ?? null);
      return true;
    } finally {
      this.#asking = false;
    }
  }

  /**
   * What was lost in the ticks before `tick`, as far as it is known.
   * @param {number} tick
   */
  sum(tick) {
    let [ticks, known, lost] = [0, 0, false];
    for (let each = Math.max(0, tick - WINDOW); each < tick; each++) {
      const item = this.items.get(each);
      if (!item || item.ticks === undefined) continue;
      known += 1;
      ticks += item.ticks ?? 0;
      lost ||= !!item.lost;
    }
    return { ticks, known, lost };
  }
}
