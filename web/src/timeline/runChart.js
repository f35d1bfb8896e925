// @ts-check
/**
 * A whole run as a line: a letter a tick, and the places that matter.
 *
 * `Course` is what the stream has told since it was opened, a part of the state; `Chart` is all that is
 * known of the run, the older part asked for page by page. Waits and detours are read off the letters.
 */

import { egoOf } from "../road/world.js";

/** @import { ChangedMessage, Move, ServerMessage, TickMessage } from "../core/protocol.js" */
/** @import { World } from "../road/world.js" */

/** @typedef {"crash" | "stuck" | "success" | "near_miss" | "episode" | "command" | "fork" | "wait" | "detour"} Kind */

/**
 * @typedef {object} Mark
 * @property {number} tick
 * @property {Kind} kind
 * @property {number} [ticks]  how long, for a wait or a detour
 * @property {string[]} [ids]
 * @property {string} [text]  what was said
 * @property {string} [session]  of a fork
 */

/**
 * @typedef {object} Course
 * @property {number} from  the tick of the first letter
 * @property {string} letters  see `LETTERS`; "?" where ticks were not heard
 * @property {Mark[]} marks
 * @property {number} edition  raised when the past may have become another one
 * @property {number} sequence  how many changes the session has accepted
 */

/** How the service writes a move in one letter; "-" where the result of an episode stood. */
export const LETTERS = /** @type {Record<Move, string>} */ ({
  forward: "F",
  left: "L",
  right: "R",
  forward_left: "l",
  forward_right: "r",
  stay: "s",
});

/** @type {Course} */
export const NO_COURSE = { from: 0, letters: "", marks: [], edition: 0, sequence: 0 };

const CLOCK = new Set(["paused", "tick", "playback_speed"]);

/**
 * The course after a message.
 * @param {Course} course
 * @param {ServerMessage} message
 * @param {World | null} before  the world until then
 * @returns {Course}
 */
export function courseAfter(course, message, before) {
  if (before === null && message.type !== "hello") return course;
  switch (message.type) {
    case "hello":
      return { ...NO_COURSE, from: message.state.tick, edition: course.edition + 1, sequence: message.sequence };
    case "tick":
      return afterTick(course, message, before);
    case "state":
      return upTo(course, message.state.tick);
    case "changed":
      return afterChange(course, message);
    default:
      return course;
  }
}

/** @param {Course} course @param {TickMessage} message @param {World | null} before @returns {Course} */
function afterTick(course, message, before) {
  const told = upTo(course, message.tick - 1);
  const letter = message.decision ? LETTERS[message.decision.move] : "-";
  const marks = before ? marksOf(message, before) : [];
  return { ...told, letters: told.letters + letter, marks: marks.length > 0 ? [...told.marks, ...marks] : told.marks };
}

/** @param {Course} course @param {ChangedMessage} message @returns {Course} */
function afterChange(course, message) {
  const told = { ...upTo(course, message.state.tick), sequence: message.sequence };
  const paths = (message.changes ?? []).map(({ path }) => path);
  const aboutClock = paths.length > 0 && paths.every((path) => CLOCK.has(path));
  const back = told.letters.length < course.letters.length || told.from < course.from;
  // Words about the clock alone leave the road's past as it is; anything else may have rewritten it.
  if (message.sequence === course.sequence || (aboutClock && !back)) return told;
  return { ...told, edition: course.edition + 1 };
}

/** @param {Course} course @param {number} tick @returns {Course} */
function upTo(course, tick) {
  const missing = tick - course.from - course.letters.length;
  if (missing === 0) return course;
  if (missing > 0) return { ...course, letters: course.letters + "?".repeat(missing) };
  if (tick < course.from) return { ...course, from: tick, letters: "", marks: [] };
  const marks = course.marks.filter((mark) => mark.tick <= tick);
  return { ...course, letters: course.letters.slice(0, tick - course.from), marks };
}

/**
 * What of a tick is worth a mark, by the same rules as the service's own (`GET …/timeline`).
 * @param {TickMessage} message
 * @param {World} before
 * @returns {Mark[]}
 */
function marksOf(message, before) {
  const { tick, status } = message;
  if (message.state && message.state.episode !== before.episode) return [{ tick, kind: "episode" }];
  if (before.status !== "running") return [];
  /** @type {Mark[]} */
  const marks = [];
  const ego = egoOf(before);
  const came = ego && message.vehicles?.[ego.id];
  if (ego && came && (came[0] !== ego.cell[0] || came[1] !== ego.cell[1])) {
    for (const [id, cell] of Object.entries(message.moved ?? {})) {
      if (cell[0] === ego.cell[0] && cell[1] === ego.cell[1]) marks.push({ tick, kind: "near_miss", ids: [id] });
    }
  }
  if (status !== "running") {
    const ids = (message.events ?? []).find(({ type }) => type === "crashed")?.ids ?? [];
    marks.push({ tick, kind: status, ids });
  }
  return marks;
}

/** All that is known of one session's run. */
export class Chart {
  /** The present tick. */ now = 0;
  /** Raised with every change, so that what was made of it is known to be old. */ version = 0;
  /** @type {Uint8Array} letters as codes, 0 where nothing is known */ #codes = new Uint8Array(1024);
  /** @type {Map<string, Mark>} */ #marks = new Map();
  /** @type {{version: number, all: Mark[]}} */ #sorted = { version: -1, all: [] };

  /** @param {number} first @param {string} letters */
  write(first, letters) {
    this.#reach(first + letters.length);
    for (let at = 0; at < letters.length; at += 1) {
      if (letters[at] !== "?") this.#codes[first + at] = letters.charCodeAt(at);
    }
    this.#arrive(first + letters.length);
  }

  /** @param {Mark[]} marks */
  mark(marks) {
    for (const mark of marks) this.#marks.set(`${mark.kind} ${mark.tick} ${mark.session ?? mark.text ?? ""}`, mark);
    this.version += 1;
  }

  /** The present is this tick: what was beyond it is gone. @param {number} tick */
  arrive(tick) {
    if (tick < this.now) {
      this.#codes.fill(0, tick, this.now);
      this.#drop((mark) => mark.tick > tick && mark.kind !== "fork");
      this.now = tick;
    }
    this.#arrive(tick);
  }

  /** From this tick on the run may be another. @param {number} tick */
  forget(tick) {
    this.#codes.fill(0, tick);
    this.#drop(({ kind, tick: at }) => at > tick && kind !== "fork" && kind !== "command");
    if (tick === 0) this.#drop(({ kind }) => kind === "episode");
    this.version += 1;
  }

  /** Marks of one kind are these and no others. @param {Kind} kind @param {Mark[]} marks */
  replace(kind, marks) {
    this.#drop((mark) => mark.kind === kind);
    this.mark(marks);
  }

  /** @param {number} tick */
  letter(tick) {
    const code = this.#codes[tick];
    return code ? String.fromCharCode(code) : "";
  }

  /**
   * The latest stretch that is not known yet, at most so long; null when all is known.
   * @param {number} most
   * @returns {{from: number, limit: number} | null}
   */
  gap(most) {
    let stop = this.now;
    while (stop > 0 && this.#codes[stop - 1]) stop -= 1;
    if (stop === 0) return null;
    let from = stop;
    while (from > 0 && stop - from < most && !this.#codes[from - 1]) from -= 1;
    return { from, limit: stop - from };
  }

  /** Every mark, waits and detours too, by tick. @returns {Mark[]} */
  marks() {
    if (this.#sorted.version !== this.version) {
      const all = [...this.#marks.values(), ...this.#spans()].sort((a, b) => a.tick - b.tick);
      this.#sorted = { version: this.version, all };
    }
    return this.#sorted.all;
  }

  /** @returns {Mark[]} */
  #spans() {
    const spans = [];
    /** @type {Mark & {ticks: number} | null} */
    let open = null;
    for (let tick = 0; tick <= this.now; tick += 1) {
      const kind = tick < this.now ? kindOf(this.#codes[tick]) : null;
      if (open && kind === open.kind) open.ticks += 1;
      else {
        if (open) spans.push(open);
        open = kind && { tick, kind, ticks: 1 };
      }
    }
    return spans;
  }

  /** @param {(mark: Mark) => boolean} gone */
  #drop(gone) {
    for (const [key, mark] of this.#marks) if (gone(mark)) this.#marks.delete(key);
    this.version += 1;
  }

  /** @param {number} tick */
  #arrive(tick) {
    this.#reach(tick);
    this.now = Math.max(this.now, tick);
    this.version += 1;
  }

  /** @param {number} length */
  #reach(length) {
    if (length <= this.#codes.length) return;
    const codes = new Uint8Array(Math.max(length, this.#codes.length * 2));
    codes.set(this.#codes);
    this.#codes = codes;
  }
}

const STAY = "s".charCodeAt(0);
const SIDEWAYS = new Set([..."LRlr"].map((letter) => letter.charCodeAt(0)));

/** @param {number} code @returns {"wait" | "detour" | null} */
function kindOf(code) {
  return code === STAY ? "wait" : SIDEWAYS.has(code) ? "detour" : null;
}
