// @ts-check
/**
 * The driving log as lines: quiet ones for ticks, louder ones for what happened or was changed.
 *
 * Ticks that say the same thing share a line ("41–44"), so that an uneventful drive does not push
 * what matters out of sight.
 */

/** @import { State } from "../core/state.js" */
/** @import { LogEvent, TickMessage, ChangedMessage } from "../core/protocol.js" */

/**
 * @typedef {object} Line
 * @property {string} key  unique and stable
 * @property {"tick" | "note" | "event" | "change"} tone  from quiet to loud; a note is about the clock alone
 * @property {string} type  the event's type, or "tick", or "change"
 * @property {number} from  the first tick the line speaks of
 * @property {number} to  the last
 * @property {string} text
 * @property {string} [said]  the words that brought it about
 * @property {boolean} [gone]  it tells of ticks that were taken back
 * @property {number} number  of the event in the session's log; 0 when it has none
 */

export const LOG_LINES = 400;

/** Event types that only repeat what a tick's narration says. */
const TOLD_BY_TICK = new Set(["moved"]);

/** Changes that leave the road as it is. */
const CLOCK = new Set(["paused", "tick"]);

/** Event types that only repeat what a change's own line says. */
const TOLD_BY_CHANGE = new Set(["edited", "changed"]);

/**
 * Lines for events, leaving out those already there.
 * @param {Line[]} log
 * @param {LogEvent[]} events
 * @returns {Line[]}
 */
export function logEvents(log, events) {
  const known = log.reduce((latest, line) => Math.max(latest, line.number), 0);
  const fresh = events.filter((event) => event.number > known && !TOLD_BY_TICK.has(event.type));
  if (fresh.length === 0) return log;
  return trimmed([...log, ...fresh.map(lineOf)]);
}

/** @param {Line[]} log @param {TickMessage} message @returns {Line[]} */
export function logTick(log, message) {
  const text = message.narration;
  let next = log;
  if (text) {
    const tick = message.decision?.tick ?? message.tick - 1;
    const last = log.at(-1);
    next =
      last && last.tone === "tick" && last.text === text && last.to === tick - 1
        ? [...log.slice(0, -1), { ...last, to: tick }]
        : trimmed([
            ...log,
            { key: `t${tick}.${message.sequence}`, tone: "tick", type: "tick", from: tick, to: tick, text, number: 0 },
          ]);
  }
  return logEvents(next, message.events ?? []);
}

/** @param {Line[]} log @param {ChangedMessage} message @returns {Line[]} */
export function logChange(log, message) {
  const { tick } = message.state;
  const events = message.events ?? [];
  const paths = (message.changes ?? []).map(({ path }) => path);
  const number = events.reduce((latest, event) => Math.max(latest, event.number), 0);
  const kept = events.filter(({ type }) => !TOLD_BY_CHANGE.has(type) && !TOLD_BY_TICK.has(type));
  const others = kept.map(lineOf);
  const last = log.at(-1);
  // What was found out beside the clock: the reply is the last event's own text.
  if (message.text === null && paths.length === 0 && message.reply === kept.at(-1)?.text) return logEvents(log, events);
  if (last && paths.length > 0 && message.text === null && paths.every((path) => path === "tick" || path === "queue")) {
    // A step is told by its ticks, and a key that drives by the move it makes. Its number is kept, so that it is not written after a reconnect either.
    return trimmed([...log.slice(0, -1), { ...last, number: Math.max(last.number, number) }, ...others]);
  }
  /** @type {Line} */
  const line = {
    key: `c${message.sequence}`,
    tone: paths.every((path) => CLOCK.has(path)) ? "note" : "change",
    type: "change",
    from: tick,
    to: tick,
    text: message.reply,
    ...(message.text ? { said: message.text } : {}),
    number,
  };
  // What happened on the way of a long step comes before the line that tells where it has led.
  const onTheWay = others.filter(({ from }) => from < tick);
  const after = others.filter(({ from, text }) => from >= tick && !message.reply.includes(text));
  return trimmed([...log, ...onTheWay, line, ...after]);
}

/**
 * The log after a change, which may have moved time: where it went back, lines of what is no more are marked; where that
 * is undone they count again.
 * @param {Pick<State, "log" | "world" | "steps">} before
 * @param {{tick: number, undo: number}} next
 * @returns {Line[]}
 */
export function logJump({ log, world, steps }, { tick, undo }) {
  const from = world?.tick ?? tick;
  if (tick < from) return log.map((line) => (isAfter(line, tick) ? { ...line, gone: true } : line));
  const undone = tick > from && undo < steps.done.length;
  return undone ? log.map((line) => (line.gone && !isAfter(line, tick) ? { ...line, gone: false } : line)) : log;
}

/** A decision leads to the tick after its own. @param {Line} line @param {number} tick */
function isAfter({ tone, to }, tick) {
  return tone === "tick" ? to >= tick : to > tick;
}

/** @param {LogEvent} event @returns {Line} */
function lineOf(event) {
  return {
    key: `e${event.number}`,
    tone: TOLD_BY_CHANGE.has(event.type) ? "change" : "event",
    type: event.type,
    from: event.tick,
    to: event.tick,
    text: event.text,
    number: event.number,
  };
}

/** @param {Line[]} log @returns {Line[]} */
function trimmed(log) {
  return log.length > LOG_LINES ? log.slice(-LOG_LINES) : log;
}
