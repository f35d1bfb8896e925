// @ts-check
/**
 * Asks for what the timeline lacks: what was before the stream was opened, or missed, and what stands of what was said.
 *
 * The older part comes in pages, one after the other and the newest first, so that nobody else waits for the service.
 */

import { askJson, errorText } from "../core/http.js";
import { newestOnly } from "../core/latest.js";
import { forks } from "./links.js";
import { sessionPath } from "../core/protocol.js";
import { gapOf } from "./timelineState.js";

/** @import { RoadChanges, TimelinePage } from "../core/wire.js" */
/** @import { State, Event } from "../core/state.js" */
/** @import { Store } from "../core/store.js" */
/** @import { KeptStorage } from "./links.js" */

const PAGE_TICKS = 500;
const PAUSE_MS = { page: 60, later: 1_000, failed: 5_000 };
/** So many pages come quickly: 10,000 ticks. */
const QUICK_PAGES = 20;

/**
 * @typedef {object} Around
 * @property {KeptStorage | null} storage  where forks are kept
 * @property {typeof fetch} [http]
 * @property {(work: () => void, delayMs: number) => any} [later]
 */

/** Keeps the timeline of the store's session filled. */
export class TimelineLoader {
  /** Pages had of this session. */ #pages = 0;
  #asking = false;
  #waiting = false;
  #failed = false;
  /** Questions under way about what stands. */ #revisions = 0;
  #revising = newestOnly();

  /** @param {Store<State, Event>} store @param {Around} around */
  constructor(store, { storage, http, later = (work, ms) => setTimeout(work, ms) }) {
    this.store = store;
    this.storage = storage;
    this.http = http;
    this.later = later;
    store.subscribe((state, before) => this.#follow(state, before));
  }

  /** @param {State} state @param {State} before */
  #follow(state, before) {
    if (state.session !== before.session) {
      this.#pages = 0;
      this.#failed = false;
    }
    if (state.timeline === before.timeline || state.world === null) return;
    if (state.timeline.maybeChanged !== before.timeline.maybeChanged) void this.#revise();
    if (gapOf(state.timeline, 1)) this.#fillIn(this.#pages < QUICK_PAGES ? PAUSE_MS.page : PAUSE_MS.later);
    this.#tellLoading();
  }

  /** Ask what stands of what was said. */
  async #revise() {
    const { session } = this.store.state();
    if (!session) return;
    const newest = this.#revising();
    const here = () => newest() && session === this.store.state().session;
    this.#revisions += 1;
    try {
      /** @type {RoadChanges} */
      const { items, more } = await askJson(`${sessionPath(session)}/changes?limit=1000`, { http: this.http });
      if (!here()) return;
      const own = forks(this.storage).filter(({ parent }) => parent === session);
      this.store.dispatch({ type: "timeline-changes", items, more, forks: own });
      this.#tell(null);
      this.#fillIn(PAUSE_MS.page);
    } catch (error) {
      if (here()) this.#tell(error);
    } finally {
      this.#revisions -= 1;
      this.#tellLoading();
    }
  }

  /** @param {number} delayMs */
  #fillIn(delayMs) {
    if (this.#waiting) return;
    this.#waiting = true;
    this.later(() => {
      this.#waiting = false;
      void this.#fill();
    }, delayMs);
  }

  async #fill() {
    const { session, timeline } = this.store.state();
    const gap = gapOf(timeline, PAGE_TICKS);
    if (this.#asking || !session || gap === null) return;
    this.#asking = true;
    const { version } = timeline;
    const here = () => this.store.state().session === session && this.store.state().timeline.version === version;
    let pause = PAUSE_MS.page;
    try {
      const path = `${sessionPath(session)}/timeline?from=${gap.from}&limit=${gap.limit}`;
      /** @type {TimelinePage} */
      const { from, moves, marks } = await askJson(path, { http: this.http });
      if (here()) {
        this.#pages += 1;
        if (this.#pages >= QUICK_PAGES) pause = PAUSE_MS.later;
        this.#tell(null);
        this.store.dispatch({ type: "timeline-page", version, from, moves, marks });
      }
    } catch (error) {
      if (here()) {
        this.#tell(error);
        pause = PAUSE_MS.failed;
      }
    } finally {
      this.#asking = false;
    }
    if (gapOf(this.store.state().timeline, 1)) this.#fillIn(pause);
    this.#tellLoading();
  }

  /** @param {unknown} error  null: all is well */
  #tell(error) {
    this.#failed = error !== null;
    this.store.dispatch({ type: "timeline-trouble", text: error === null ? null : errorText(error) });
  }

  /** Whoever looks for something in what is about to be known does well to wait for it. */
  #tellLoading() {
    const { session, timeline } = this.store.state();
    const quick = this.#pages < QUICK_PAGES && gapOf(timeline, 1) !== null;
    const loading = session !== null && !this.#failed && (this.#revisions > 0 || quick);
    this.store.dispatch({ type: "timeline-loading", loading });
  }
}
