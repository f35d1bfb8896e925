// @ts-check
/** Each decision of the whole run judged by the service, asked for page by page while the strip is seen. */

import { askJson, errorText } from "../core/http.js";
import { sessionPath } from "../core/protocol.js";

/** @import { Judged, JudgedDecision } from "../core/wire.js" */
/** @import { Page } from "../core/page.js" */
/** @import { State } from "../core/state.js" */

/** @typedef {JudgedDecision & {clearance_m: number | null}} RunJudgement */

/** Decisions that are asked for at once, and the pause between two questions [ms]: each decision takes searches. */
const PAGE_TICKS = 100;
const PAUSE_MS = 120;
const RUNNING_MS = 3_000;
/** How many of the worst moments are told. */
const WORST = 5;

export class StripData {
  /** By tick; null where no decision was taken. @type {Map<number, RunJudgement | null>} */ items = new Map();
  /** The first tick that is not known yet. */ next = 0;
  /** Why the last question was not answered, in words. @type {string | null} */ trouble = null;
  #asking = false;
  #age = -1;
  /** @type {string | null} */ #session = null;

  /** @param {Page} page @param {() => void} changed */
  constructor(page, changed) {
    this.page = page;
    this.changed = changed;
  }

  /** Asks for what is missing, while the strip is seen. @param {State} state */
  follow(state) {
    if (state.session !== this.#session || state.regret.age !== this.#age) this.#forget(state);
    if (!this.#asking) void this.#ask();
  }

  /** @param {State} state */
  #forget({ session, regret }) {
    this.#session = session;
    this.#age = regret.age;
    this.items = new Map();
    this.next = 0;
  }

  async #ask() {
    const { connection, session, views, world } = this.page.state();
    if (!session || !world || !views.strip || connection.phase !== "live" || this.next >= world.tick) return;
    this.#asking = true;
    const age = this.#age;
    const [from, running] = [this.next, !world.paused];
    let pause = PAUSE_MS;
    try {
      /** @type {Judged} */
      const { items, now, more } = await askJson(`${sessionPath(session)}/regret?from=${from}&limit=${PAGE_TICKS}`);
      if (age === this.#age && session === this.#session) {
        this.next = Math.min(now, from + PAGE_TICKS);
        for (const item of items) this.items.set(item.tick, /** @type {RunJudgement} */ (item));
        this.trouble = null;
        if (!more && running) pause = RUNNING_MS;
      }
    } catch (error) {
      this.trouble = errorText(error);
      pause = RUNNING_MS;
    }
    this.changed();
    setTimeout(() => {
      this.#asking = false;
      void this.#ask();
    }, pause);
  }

  /** The moments in which most was lost, the worst first. */
  worst() {
    const weight = (/** @type {RunJudgement} */ { lost, ticks, blocked }) => (lost ? 1_000 : 0) + 10 * (ticks ?? 0) + blocked;
    const all = [...this.items.values()].filter((item) => item !== null && (item.lost || (item.ticks ?? 0) > 0));
    return /** @type {RunJudgement[]} */ (all).sort((a, b) => weight(b) - weight(a) || a.tick - b.tick).slice(0, WORST);
  }
}
