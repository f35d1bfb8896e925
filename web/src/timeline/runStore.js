// @ts-check
/**
 * Keeps one session's chart: from the stream what comes, from the service what was before or was missed.
 *
 * The older part comes in pages, one after the other and the newest first, so that nobody else waits for
 * the service. When something was said, the list of what stands tells from which tick on the run is another.
 */

import { askJson } from "../core/http.js";
import { turns } from "../core/latest.js";
import { forks } from "./links.js";
import { sessionPath } from "../core/protocol.js";
import { Chart, NO_COURSE } from "./runChart.js";

/** @import { Store } from "./links.js" */
/** @import { Course } from "./runChart.js" */

const PAGE_TICKS = 500;
const PAUSE_MS = { page: 60, later: 1_000, failed: 5_000 };
/** So many pages come quickly: 10,000 ticks. */
const QUICK_PAGES = 20;

/**
 * @typedef {object} Around
 * @property {() => void} changed  there is more to show
 * @property {() => void} rewritten  the past may have become another
 * @property {(error: unknown) => void} failed  null: all is well again
 * @property {Store | null} storage
 * @property {typeof fetch} [http]
 * @property {(work: () => void, delayMs: number) => any} [later]
 */

/** One session's run; another session begins another. */
export class Run {
  chart = new Chart();
  /** @type {string | null} */ session = null;
  #course = NO_COURSE;
  /** @type {string[]} tick and number of each change that stands */ #said = [];
  #pages = 0;
  #asking = false;
  #waiting = false;
  #failed = false;
  /** Questions under way about what stands. */ #revisions = 0;
  #revising = turns();
  /** Raised whenever a part is forgotten: a page that was asked for before tells of a run that is no more. */ #age = 0;

  /** @param {Around} around */
  constructor(around) {
    this.around = { later: (/** @type {() => void} */ work, /** @type {number} */ ms) => setTimeout(work, ms), ...around };
  }

  /**
   * Take in what is known now.
   * @param {string | null} session
   * @param {number} now
   * @param {Course} course
   */
  takeIn(session, now, course) {
    if (session !== this.session) {
      this.session = session;
      this.chart = new Chart();
      this.#course = NO_COURSE;
      this.#said = [];
      this.#pages = 0;
      this.#age += 1;
      this.#tell(null);
    }
    const old = this.#course;
    if (course === old) return;
    this.#course = course;
    if (now < this.chart.now) this.#age += 1;
    this.chart.arrive(now);
    const heard = course.from === old.from && course.letters.length >= old.letters.length ? old.letters.length : 0;
    this.chart.write(course.from + heard, course.letters.slice(heard));
    this.chart.mark(course.marks.filter(({ tick }) => tick >= course.from + heard));
    if (course.edition !== old.edition) void this.revise();
    if (this.chart.gap(1)) this.#later(this.#pages < QUICK_PAGES ? PAUSE_MS.page : PAUSE_MS.later);
  }

  /** Whether more of it is about to be known: whoever looks for something there does well to wait for that. */
  get coming() {
    const quick = this.#pages < QUICK_PAGES && this.chart.gap(1) !== null;
    return this.session !== null && !this.#failed && (this.#revisions > 0 || quick);
  }

  /** Ask what stands of what was said, and forget what is no longer so. */
  async revise() {
    const { session } = this;
    if (!session) return;
    const newest = this.#revising();
    this.#revisions += 1;
    try {
      /** @type {{items: {tick: number, sequence: number, text: string}[], more: boolean}} */
      const { items, more } = await askJson(`${sessionPath(session)}/changes?limit=1000`, { http: this.around.http });
      if (!newest() || session !== this.session) return;
      const said = items.map(({ tick, sequence }) => `${tick} ${sequence}`);
      // Of very many only the newest are told: those before them are taken to stand.
      const known = more ? this.#said.slice(Math.max(0, this.#said.indexOf(said[0]))) : this.#said;
      const from = firstDifference(known, said);
      if (from < this.chart.now) {
        this.chart.forget(from);
        this.#age += 1;
        this.around.rewritten();
      }
      this.#said = said;
      this.chart.replace("command", items.map(({ tick, text }) => ({ tick, kind: "command", text })));
      const own = forks(this.around.storage).filter(({ parent }) => parent === session);
      this.chart.replace("fork", own.map(({ tick, child }) => ({ tick, kind: "fork", session: child })));
      this.#tell(null);
      this.#later(PAUSE_MS.page);
    } catch (error) {
      if (newest() && session === this.session) this.#tell(error);
    } finally {
      this.#revisions -= 1;
      this.around.changed();
    }
  }

  /** @param {unknown} error  null: all is well */
  #tell(error) {
    this.#failed = error !== null;
    this.around.failed(error);
  }

  /** @param {number} delayMs */
  #later(delayMs) {
    if (this.#waiting) return;
    this.#waiting = true;
    this.around.later(() => {
      this.#waiting = false;
      void this.#fill();
    }, delayMs);
  }

  async #fill() {
    const { session } = this;
    const gap = this.chart.gap(PAGE_TICKS);
    if (this.#asking || !session || gap === null) return;
    this.#asking = true;
    const age = this.#age;
    let pause = PAUSE_MS.page;
    try {
      const path = `${sessionPath(session)}/timeline?from=${gap.from}&limit=${gap.limit}`;
      const { from, moves, marks } = await askJson(path, { http: this.around.http });
      if (age === this.#age) {
        this.chart.write(from, moves);
        this.chart.mark(marks);
        this.#pages += 1;
        if (this.#pages >= QUICK_PAGES) pause = PAUSE_MS.later;
        this.#tell(null);
        this.around.changed();
      }
    } catch (error) {
      if (age === this.#age) {
        this.#tell(error);
        this.around.changed();
        pause = PAUSE_MS.failed;
      }
    } finally {
      this.#asking = false;
    }
    if (this.chart.gap(1)) this.#later(pause);
  }
}

/**
 * The tick from which on two lists of what was said lead to different runs; Infinity when they do not.
 * @param {string[]} before
 * @param {string[]} now
 */
function firstDifference(before, now) {
  const at = Math.min(before.length, now.length);
  const first = before.slice(0, at).findIndex((each, place) => each !== now[place]);
  const rest = [...before.slice(at), ...now.slice(at)];
  const ticks = (first < 0 ? rest : [before[first], now[first]]).map((each) => Number.parseInt(each, 10));
  return Math.min(Infinity, ...ticks);
}
