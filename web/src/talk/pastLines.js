// @ts-check
/**
 * Lines of the driving log from before the page was opened. Its `hello` tells events alone; decisions, and the words by
 * which things were changed, are asked for and put between them.
 */

import { LOG_LINES } from "./journal.js";

/** @import { RoadChange } from "../core/wire.js" */
/** @import { Exchange } from "./exchanges.js" */
/** @import { Line } from "./journal.js" */

/** @typedef {{tick: number, narration?: string | null}} Told  a decision */

/**
 * The log with what was decided and said before its first own tick.
 * @param {Line[]} log
 * @param {Told[]} decisions  in the order of their ticks
 * @param {RoadChange[]} changes
 * @param {Exchange[]} talk  as far as it was kept: it tells which line is the reply to what
 * @returns {Line[]}
 */
export function withPastLines(log, decisions, changes, talk) {
  const live = log.find(({ type }) => type === "tick")?.from ?? Infinity;
  const events = log.filter(({ from, type }) => type !== "tick" && from <= live);
  const rest = log.filter((line) => !events.includes(line));
  const told = decisions.filter(({ tick, narration }) => tick < live && narration);
  const first = told[0]?.tick ?? Infinity;
  return [...merged(withWords(events, changes, first, repliesIn(talk)), told), ...rest].slice(-LOG_LINES);
}

/**
 * Changes with the words that brought them about. What changed nothing on the road, where its ticks are told, is the
 * clock's own and left out.
 * @param {Line[]} events
 * @param {RoadChange[]} changes
 * @param {number} first  tick that is told
 * @param {Map<string, string>} replies
 * @returns {Line[]}
 */
function withWords(events, changes, first, replies) {
  return events.flatMap((line) => {
    if (line.tone !== "change" || line.said) return [line];
    const [lines, words] = [events.filter(({ tone, from }) => tone === "change" && from === line.from), changes.filter(({ tick }) => tick === line.from)];
    if (words.length === 0) return line.from >= first ? [] : [{ ...line, tone: /** @type {const} */ ("note") }];
    const said = replies.get(line.text);
    if (said !== undefined && words.some(({ text }) => text === said)) return [{ ...line, said }];
    const word = lines.length === words.length ? words[lines.indexOf(line)] : undefined;
    return [word?.said ? { ...line, said: word.text } : line];
  });
}

/** What each reply was the answer to. @param {Exchange[]} talk */
function repliesIn(talk) {
  return new Map(talk.flatMap(({ said, quiet, result }) => (result && !quiet ? [/** @type {[string, string]} */ ([result.reply, said])] : [])));
}

/** @param {Line[]} events @param {Told[]} told @returns {Line[]} */
function merged(events, told) {
  /** @type {Line[]} */ const lines = [];
  let at = 0;
  for (const { tick, narration } of told) {
    while (at < events.length && events[at].from <= tick) lines.push(events[at++]);
    const last = lines.at(-1);
    const text = String(narration);
    if (last?.type === "tick" && last.text === text && last.to === tick - 1) lines[lines.length - 1] = { ...last, to: tick };
    else lines.push({ key: `p${tick}`, tone: "tick", type: "tick", from: tick, to: tick, text, number: 0 });
  }
  return [...lines, ...events.slice(at)];
}
