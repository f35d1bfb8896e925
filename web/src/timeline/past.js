// @ts-check
/**
 * Looking at the past: worlds asked for, kept, and shown; the latest wish wins.
 *
 * The tick that is wished for is known at once (`tick`), the world a moment later. Who walks along is given
 * pages of ticks, and what comes next ahead of time. Who leaps is given that one tick, which the service has
 * sooner, and its page once they rest there. No more than one wish is asked for at a time: a drag over a
 * hundred ticks must not leave a hundred questions behind.
 */

import { askJson } from "../core/http.js";
import { sessionPath } from "../core/protocol.js";
import { worldOf } from "../road/world.js";

/** @import { Option, WireState, Decision } from "../core/protocol.js" */
/** @import { Past } from "../core/state.js" */

/** Ticks in a page. */
export const PAGE = 16;
/** Pages kept: some 60 KB each as the service tells them. */
const PAGES = 24;
/** Who stays so long at a tick is likely to walk on from there. */
const REST_MS = 120;

/**
 * A moment as the panels know a present: a decision with the reason and causes that a tick message tells.
 * @param {{state: WireState, decision: (Decision & {options: Option[]}) | null}} moment
 * @returns {Past}
 */
export function pastOf({ state, decision }) {
  const first = decision?.options?.[0];
  return {
    world: worldOf(state),
    decision: decision && { reason: first?.reason, causes: first?.causes ?? [], ...decision },
    narration: decision?.narration ?? null,
  };
}

/** Past moments of one session, asked for in pages. */
export class Book {
  /** @type {Map<number, Promise<Past[]>>} pages by number, the latest used last */ #pages = new Map();
  /** @type {Map<number, Past[]>} those that have come */ #here = new Map();
  /** @type {Map<number, Past>} single ticks that were leapt to */ #ones = new Map();

  /** @param {string} session @param {typeof fetch} [http] */
  constructor(session, http) {
    this.session = session;
    this.http = http;
  }

  /** What is here already. @param {number} tick @returns {Past | null} */
  known(tick) {
    return this.#here.get(Math.floor(tick / PAGE))?.[tick % PAGE] ?? this.#ones.get(tick) ?? null;
  }

  /** @param {number} tick @returns {Promise<Past>} throws `Refused` */
  async at(tick) {
    const page = Math.floor(tick / PAGE);
    let asked = this.#pages.get(page);
    // A page that was asked for at the present ends there: it is asked for again when time has gone on.
    const here = this.#here.get(page);
    if (!asked || (here && tick % PAGE >= here.length)) asked = this.#ask(page);
    const past = (await asked)[tick % PAGE];
    if (!past) throw new Error(`Tick ${tick} has not come yet.`);
    return past;
  }

  /** A tick alone. @param {number} tick @returns {Promise<Past>} throws `Refused` */
  async alone(tick) {
    const ones = this.#ones;
    const { items } = await askJson(`${sessionPath(this.session)}/moments?from=${tick}&limit=1`, { http: this.http });
    const past = pastOf(items[0]);
    ones.set(tick, past);
    if (ones.size > PAGES * PAGE) ones.delete(ones.keys().next().value ?? tick);
    return past;
  }

  /** Have a tick at hand before it is wished for; what goes wrong then is told when it is. @param {number} tick */
  ahead(tick) {
    if (tick >= 0 && !this.#pages.has(Math.floor(tick / PAGE))) this.at(tick).catch(() => {});
  }

  /** The run has become another one. */
  clear() {
    this.#pages.clear();
    this.#here.clear();
    this.#ones = new Map();
  }

  /** @param {number} page */
  #ask(page) {
    const path = `${sessionPath(this.session)}/moments?from=${page * PAGE}&limit=${PAGE}`;
    const asked = askJson(path, { http: this.http }).then(({ items }) => {
      const moments = items.map(pastOf);
      if (this.#pages.get(page) === asked) this.#here.set(page, moments);
      return moments;
    });
    this.#pages.delete(page);
    this.#pages.set(page, asked);
    asked.catch(() => this.#pages.get(page) === asked && this.#pages.delete(page));
    for (const oldest of this.#pages.keys()) {
      if (this.#pages.size <= PAGES) break;
      this.#pages.delete(oldest);
      this.#here.delete(oldest);
    }
    return asked;
  }
}

/**
 * @typedef {object} Onlooker  what looking needs of the page
 * @property {() => {session: string | null, tick: number, stepS: number, pace: number}} present
 * @property {(past: Past | null) => void} look
 * @property {(error: unknown) => void} failed
 * @property {typeof fetch} [http]
 * @property {(work: () => void, delayMs: number) => unknown} [later]
 * @property {(timer: any) => void} [cancel]
 */

/** Which tick is looked at. */
export class Looking {
  /** @type {number | null} the tick wished for; null is the present */ tick = null;
  /** Whether it goes on by itself. */ playing = false;
  /** @type {Book | null} */ #book = null;
  /** @type {any} */ #timer = null;
  /** @type {any} */ #rest = null;
  /** @type {object | null} one going on by itself; another begins another */ #going = null;
  /** @type {{book: Book} | null} the question under way */ #asking = null;
  #direction = 1;
  /** @type {(() => void)[]} */ #listeners = [];

  /** @param {Onlooker} page */
  constructor(page) {
    this.page = {
      later: (/** @type {() => void} */ work, /** @type {number} */ delayMs) => setTimeout(work, delayMs),
      cancel: (/** @type {any} */ timer) => clearTimeout(timer),
      ...page,
    };
  }

  /**
   * Look at a tick; at or beyond the present one, at the present.
   * @param {number} wanted
   * @returns {Promise<void>} once it is shown, or another is wished for
   */
  async at(wanted) {
    const { session, tick: now } = this.page.present();
    const tick = Math.max(0, Math.round(wanted));
    if (session === null || tick >= now) return this.live();
    const book = this.#bookOf(session);
    const walked = this.tick !== null && tick !== this.tick && Math.abs(tick - this.tick) <= PAGE / 2;
    if (this.tick !== null && this.tick !== tick) this.#direction = Math.sign(tick - this.tick);
    this.tick = tick;
    this.#told();
    const known = book.known(tick);
    if (known) return this.#show(known, book, walked);
    if (this.#asking?.book === book) return; // it is asked for as soon as the answer under way is there
    const question = { book };
    this.#asking = question;
    let failure = null;
    let past = null;
    try {
      past = walked || this.playing ? await book.at(tick) : await book.alone(tick);
    } catch (error) {
      failure = error;
    }
    if (this.#asking !== question) return; // of a session left, or a run rewritten, meanwhile
    this.#asking = null;
    if (this.tick === null) return;
    if (this.tick !== tick) return this.at(this.tick);
    if (past) return this.#show(past, book, walked);
    this.live();
    this.page.failed(failure);
  }

  /** @param {Past} past @param {Book} book @param {boolean} walked */
  #show(past, book, walked) {
    const { tick } = this;
    if (tick === null) return;
    this.page.look(past);
    this.page.cancel(this.#rest);
    const ahead = () => {
      if (this.tick !== tick) return;
      const now = this.page.present().tick; // beyond it there is nothing to be had
      for (const way of [0, this.#direction, -this.#direction]) book.ahead(Math.min(now, tick + (way * PAGE) / 2));
    };
    if (walked || this.playing) ahead();
    else this.#rest = this.page.later(ahead, REST_MS);
  }

  /** @param {number} ticks  forwards or back */
  step(ticks) {
    this.stop();
    return this.at((this.tick ?? this.page.present().tick) + ticks);
  }

  /** Look at the present again. */
  live() {
    this.stop();
    if (this.tick === null) return;
    this.tick = null;
    this.page.cancel(this.#rest);
    this.page.look(null);
    this.#told();
  }

  /** Go on from here at the session's own speed until the present is reached. */
  play() {
    if (this.playing || this.tick === null) return;
    this.playing = true;
    this.#going = {};
    this.#told();
    this.#next();
  }

  /** Go on, or stand still. */
  toggle() {
    if (this.playing) this.stop();
    else this.play();
  }

  /** Stand still. */
  stop() {
    this.page.cancel(this.#timer);
    if (!this.playing) return;
    this.playing = false;
    this.#told();
  }

  /** The past may have become another one: ask anew, and show what is there now. */
  rewritten() {
    this.#book?.clear();
    this.#asking = null;
    const { tick: now } = this.page.present();
    if (this.tick === null) return;
    if (this.tick >= now) this.live();
    else void this.at(this.tick);
  }

  /** Be called when another tick is wished for, or none, or it begins or ends to go on. @param {() => void} listener */
  listen(listener) {
    this.#listeners.push(listener);
  }

  #told() {
    for (const listener of this.#listeners) listener();
  }

  #next() {
    const { stepS, pace } = this.page.present();
    const going = this.#going;
    this.#timer = this.page.later(
      async () => {
        if (this.tick !== null) await this.at(this.tick + 1);
        // Stopped and begun anew while that tick was on its way, it goes on already.
        if (this.playing && going === this.#going) this.#next();
      },
      Math.max(16, (stepS * 1000) / pace),
    );
  }

  /** @param {string} session */
  #bookOf(session) {
    if (this.#book?.session !== session) {
      this.#book = new Book(session, this.page.http);
      this.#asking = null;
    }
    return this.#book;
  }
}
