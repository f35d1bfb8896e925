// @ts-check
/**
 * A whole run as part of the state: a letter a tick, and the events that matter. The stream tells what happens from its
 * opening on; what was before, or was missed, is asked for page by page (`timelineLoader.js`).
 */

import { egoOf } from "../road/world.js";

/** @import { ChangedMessage, Move, ServerMessage, TickMessage } from "../core/protocol.js" */
/** @import { RoadChange, TimelineMark } from "../core/wire.js" */
/** @import { World } from "../road/world.js" */
/** @import { Fork } from "./links.js" */

/** @typedef {"crash" | "stuck" | "success" | "near_miss" | "episode" | "command" | "fork" | "wait" | "detour"} Kind */

/**
 * @typedef {object} TimelineEvent
 * @property {number} tick
 * @property {Kind} kind
 * @property {number} [ticks]  how long, for a wait or a detour
 * @property {string[]} [ids]
 * @property {string} [text]  what was said
 * @property {string} [session]  of a fork
 */

/**
 * @typedef {object} Timeline
 * @property {string} letters  see `LETTERS`, one for each tick until now; "?" where it is not known
 * @property {TimelineEvent[]} events  without waits and detours, which are read off the letters
 * @property {number} maybeChanged  a counter, raised when the past may have changed
 * @property {number} version  a counter, raised when the past has changed: answers to older requests are dropped
 * @property {number} sequence  how many changes the session has accepted
 * @property {string[]} changes  tick and number of each change that stands, as last heard
 * @property {boolean} loading  whether more of it is about to be known
 * @property {string | null} trouble  why a part of it could not be had
 */

/**
 * Answers to requests about it. A `version` is that of the timeline when the request was sent.
 * @typedef {{type: "timeline-page", version: number, from: number, moves: string, marks: Pick<TimelineMark, "tick" | "kind" | "ids">[]}
 *   | {type: "timeline-changes", items: RoadChange[], more: boolean, forks: Fork[]}
 *   | {type: "timeline-trouble", text: string | null}
 *   | {type: "timeline-loading", loading: boolean}} LoaderEvent
 */

/** How the service writes a move in one letter; "-" where the result of an episode stood. */
const LETTERS = /** @type {Record<Move, string>} */ ({
  forward: "F",
  left: "L",
  right: "R",
  forward_left: "l",
  forward_right: "r",
  stay: "s",
});
const UNKNOWN = "?";

/** @type {Timeline} */
export const NO_TIMELINE = { letters: "", events: [], maybeChanged: 0, version: 0, sequence: 0, changes: [], loading: false, trouble: null };

const CLOCK = new Set(["paused", "tick", "playback_speed"]);

/**
 * The timeline after an event.
 * @param {Timeline} timeline
 * @param {ServerMessage | LoaderEvent} event
 * @param {World | null} before  the world until then
 * @returns {Timeline}
 */
export function timelineAfter(timeline, event, before) {
  if (before === null && event.type !== "hello") return timeline;
  switch (event.type) {
    case "hello":
      return { ...cut(timeline, event.state.tick), maybeChanged: timeline.maybeChanged + 1, sequence: event.sequence };
    case "tick":
      return afterTick(timeline, event, before);
    case "state":
      return cut(timeline, event.state.tick);
    case "changed":
      return afterChange(timeline, event);
    case "timeline-page":
      return event.version === timeline.version ? afterPage(timeline, event) : timeline;
    case "timeline-changes":
      return afterChanges(timeline, event);
    case "timeline-trouble":
      return event.text === timeline.trouble ? timeline : { ...timeline, trouble: event.text };
    case "timeline-loading":
      return event.loading === timeline.loading ? timeline : { ...timeline, loading: event.loading };
    default:
      return timeline;
  }
}

/** The present tick. @param {Timeline} timeline */
export function nowOf({ letters }) {
  return letters.length;
}

/** @param {Timeline} timeline @param {TickMessage} message @param {World | null} before @returns {Timeline} */
function afterTick(timeline, message, before) {
  const until = cut(timeline, message.tick - 1);
  const letter = message.decision ? LETTERS[message.decision.move] : "-";
  return { ...until, letters: until.letters + letter, events: merge(until.events, before ? eventsOf(message, before) : []) };
}

/** @param {Timeline} timeline @param {ChangedMessage} message @returns {Timeline} */
function afterChange(timeline, message) {
  const until = { ...cut(timeline, message.state.tick), sequence: message.sequence };
  const paths = (message.changes ?? []).map(({ path }) => path);
  const aboutClock = paths.length > 0 && paths.every((path) => CLOCK.has(path));
  const back = nowOf(until) < nowOf(timeline);
  // Words about the clock alone leave the road's past as it is; anything else may have rewritten it.
  if (message.sequence === timeline.sequence || (aboutClock && !back)) return until;
  return { ...until, maybeChanged: timeline.maybeChanged + 1 };
}

/** The present is this tick: what was beyond it is gone, but not what was forked from there. @param {Timeline} timeline @param {number} tick @returns {Timeline} */
function cut(timeline, tick) {
  const missing = tick - nowOf(timeline);
  if (missing === 0) return timeline;
  if (missing > 0) return { ...timeline, letters: timeline.letters + UNKNOWN.repeat(missing) };
  const events = timeline.events.filter((each) => each.tick <= tick || each.kind === "fork");
  return { ...timeline, letters: timeline.letters.slice(0, tick), events, version: timeline.version + 1 };
}

/** @param {Timeline} timeline @param {LoaderEvent & {type: "timeline-page"}} page @returns {Timeline} */
function afterPage(timeline, { from, moves, marks }) {
  const { letters } = timeline;
  const told = moves.slice(0, Math.max(0, nowOf(timeline) - from));
  return {
    ...timeline,
    letters: letters.slice(0, from) + told + letters.slice(from + told.length),
    events: merge(timeline.events, marks),
  };
}

/**
 * What stands of what was said: from where that differs from what stood, the run is another.
 * @param {Timeline} timeline
 * @param {LoaderEvent & {type: "timeline-changes"}} event
 * @returns {Timeline}
 */
function afterChanges(timeline, { items, more, forks }) {
  const changes = items.map(({ tick, sequence }) => `${tick} ${sequence}`);
  // Of very many only the newest are told: those before them are taken to stand.
  const known = more ? timeline.changes.slice(Math.max(0, timeline.changes.indexOf(changes[0]))) : timeline.changes;
  const from = firstDifference(known, changes);
  const kept = from < nowOf(timeline) ? forget(timeline, from) : timeline;
  const others = kept.events.filter(({ kind }) => kind !== "command" && kind !== "fork");
  return {
    ...kept,
    changes,
    events: [
      ...others,
      .../** @type {TimelineEvent[]} */ (items.map(({ tick, text }) => ({ tick, kind: "command", text }))),
      .../** @type {TimelineEvent[]} */ (forks.map(({ tick, child }) => ({ tick, kind: "fork", session: child }))),
    ],
  };
}

/** From this tick on the run is another, and not known. @param {Timeline} timeline @param {number} tick @returns {Timeline} */
function forget(timeline, tick) {
  const { letters, events, version } = timeline;
  return {
    ...timeline,
    letters: letters.slice(0, tick) + UNKNOWN.repeat(letters.length - tick),
    events: events.filter(({ tick: at, kind }) => at <= tick && !(tick === 0 && kind === "episode")),
    version: version + 1,
  };
}

/**
 * The tick from which on two lists of changes lead to different runs; Infinity when they do not.
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

/** Events with more of them, each once. @param {TimelineEvent[]} events @param {TimelineEvent[]} more @returns {TimelineEvent[]} */
function merge(events, more) {
  if (more.length === 0) return events;
  const key = (/** @type {TimelineEvent} */ { kind, tick }) => `${kind} ${tick}`;
  const fresh = new Set(more.map(key));
  return [...events.filter((each) => !fresh.has(key(each))), ...more];
}

/**
 * What of a tick is worth an event, by the same rules as the service's own (`GET …/timeline`).
 * @param {TickMessage} message
 * @param {World} before
 * @returns {TimelineEvent[]}
 */
function eventsOf(message, before) {
  const { tick, status } = message;
  if (message.state && message.state.episode !== before.episode) return [{ tick, kind: "episode" }];
  if (before.status !== "running") return [];
  /** @type {TimelineEvent[]} */
  const events = [];
  const ego = egoOf(before);
  const came = ego && message.vehicles?.[ego.id];
  if (ego && came && (came[0] !== ego.cell[0] || came[1] !== ego.cell[1])) {
    const ids = Object.entries(message.moved ?? {}).filter(([, cell]) => cell[0] === ego.cell[0] && cell[1] === ego.cell[1]);
    if (ids.length > 0) events.push({ tick, kind: "near_miss", ids: ids.map(([id]) => id) });
  }
  if (status !== "running") {
    const ids = (message.events ?? []).find(({ type }) => type === "crashed")?.ids ?? [];
    events.push({ tick, kind: status, ids });
  }
  return events;
}

/**
 * The latest stretch that is not known yet, at most so long; null when all is known.
 * @param {Timeline} timeline
 * @param {number} most
 * @returns {{from: number, limit: number} | null}
 */
export function gapOf({ letters }, most) {
  const last = letters.lastIndexOf(UNKNOWN);
  if (last === -1) return null;
  let from = last;
  while (from > 0 && last + 1 - from < most && letters[from - 1] === UNKNOWN) from -= 1;
  return { from, limit: last + 1 - from };
}

/** @type {WeakMap<TimelineEvent[], {letters: string, all: TimelineEvent[]}>} */
const ALL = new WeakMap();

/** Every event, waits and detours too, by tick. @param {Timeline} timeline @returns {TimelineEvent[]} */
export function allEvents({ letters, events }) {
  const known = ALL.get(events);
  if (known?.letters === letters) return known.all;
  const all = [...events, ...stretches(letters)].sort((a, b) => a.tick - b.tick);
  ALL.set(events, { letters, all });
  return all;
}

/** Waits and detours. @param {string} letters @returns {TimelineEvent[]} */
function stretches(letters) {
  const found = [];
  for (const { 0: run, index } of letters.matchAll(/s+|[LRlr]+/g)) {
    found.push({ tick: index, kind: /** @type {Kind} */ (run[0] === "s" ? "wait" : "detour"), ticks: run.length });
  }
  return found;
}
