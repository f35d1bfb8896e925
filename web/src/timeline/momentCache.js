// @ts-check
/**
 * Past ticks of one session, asked for and kept: pages of them for those who walk along, one alone for those who leap,
 * which the service has sooner.
 */

import { askJson } from "../core/http.js";
import { sessionPath } from "../core/protocol.js";
import { t } from "../core/texts.js";
import { worldOf } from "../road/world.js";

/** @import { Moments, Moment } from "../core/wire.js" */
/** @import { Past } from "../core/state.js" */

/** Ticks in a page. */
export const PAGE = 16;
/** Pages kept: some 60 KB each as the service tells them. */
const PAGES = 24;
/**
 * A past tick as the panels know a present, with the decision that was taken there, which the service tells with the
 * tick after it. The decision has the reason and causes that a tick message tells.
 * @param {Pick<Moment, "state"> & Partial<Moment>} moment
 * @param {Pick<Moment, "decision">} [after]
 * @returns {Past}
 */
export function pastOf({ state, decision: before }, { decision } = { decision: null }) {
  const first = decision?.options?.[0];
  return {
    world: worldOf(state),
    decision: decision && { reason: first?.reason, causes: first?.causes ?? [], ...decision },
    narration: decision?.narration ?? null,
    led: before?.narration ?? null,
  };
}

/** Past moments of one session, asked for in pages. */
export class MomentCache {
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
    if (!past) throw new Error(t("past.not_yet", { tick }));
    return past;
  }

  /** A tick alone. @param {number} tick @returns {Promise<Past>} throws `Refused` */
  async alone(tick) {
    const ones = this.#ones;
    const { items } = await this.#moments(tick, 2);
    const past = pastOf(items[0], items[1]);
    if (items.length > 1) ones.set(tick, past);
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

  /** @param {number} page @returns {Promise<Past[]>} */
  #ask(page) {
    const asked = this.#moments(page * PAGE, PAGE + 1).then(({ items }) => {
      const moments = items.slice(0, PAGE).map((moment, index) => pastOf(moment, items[index + 1]));
      // The present is not kept: what is decided there is not known yet.
      if (this.#pages.get(page) === asked) this.#here.set(page, moments.slice(0, items.length - 1));
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

  /** @param {number} from @param {number} limit @returns {Promise<Moments>} */
  #moments(from, limit) {
    return askJson(`${sessionPath(this.session)}/moments?from=${from}&limit=${limit}`, { http: this.http });
  }
}
