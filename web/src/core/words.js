// @ts-check
/** Small words of the page's own: moves, reasons, figures, and marking words inside a sentence. */

/** @import { Change, Move } from "./protocol.js" */

/** Each move's arrow and name. */
export const MOVES = /** @type {Record<Move, {arrow: string, name: string}>} */ ({
  forward: { arrow: "↑", name: "forward" },
  left: { arrow: "←", name: "left" },
  right: { arrow: "→", name: "right" },
  forward_left: { arrow: "↖", name: "forward left" },
  forward_right: { arrow: "↗", name: "forward right" },
  stay: { arrow: "·", name: "stay" },
});

const REASONS = /** @type {Record<string, string>} */ ({
  free: "free",
  off_road: "off the road",
  pothole: "a pothole",
  barrier: "a barrier",
  mover_enters: "something moves in",
  mover_stays: "something stands there",
  mover_swaps: "something comes the other way",
  mover_crosses: "something cuts across the way there",
  ego_enters: "another of our vehicles moves in",
  ego_stays: "another of our vehicles stands there",
  ego_swaps: "another of our vehicles comes the other way",
  ego_crosses: "another of our vehicles cuts across the way there",
  disabled_mover: "a disabled vehicle",
});

/**
 * A planner's reason in words; one the page does not know is shown as it is spelt.
 * @param {string} reason
 */
export function reasonWords(reason) {
  return REASONS[reason] ?? plain(reason);
}

/**
 * A name from the wire as words: "success_rate" → "success rate".
 * @param {string} name
 */
export function plain(name) {
  return name.replaceAll("_", " ").replaceAll(".", " ");
}

/** Planners by the names people know them by; others go by the name they were registered under. */
export const PLANNERS = /** @type {Record<string, string>} */ ({
  rules: "Rules",
  priority: "Priority rules of the source",
  astar: "A*",
  dijkstra: "Dijkstra",
  bfs: "Quickest",
});

/** Families of roads as they are asked for, in the order in which they are offered. @type {Record<string, string>} */
export const LAYOUTS = {
  walls: "walls with gaps",
  narrows: "narrow streets",
  dead_ends: "dead ends",
  crossing: "crossing traffic",
  maze: "a maze",
};

/** @param {string} name */
export function plannerName(name) {
  return PLANNERS[name] ?? plain(name);
}

/**
 * What is called otherwise than it is spelt on the wire: a figure's name, and how its values are said.
 * @type {Record<string, {name?: string, value?: (value: any) => string}>}
 */
const FIGURES = {
  mode: { name: "driver", value: (mode) => (mode === "manual" ? "you" : "itself") },
  queue: { name: "next moves", value: (moves) => listed(moves, (/** @type {Move} */ move) => MOVES[move]?.name ?? plain(move)) },
  playback_speed: { value: (pace) => (pace === "max" ? "max" : `${pace}×`) },
  planner: { value: plannerName },
  layout: { value: (layout) => LAYOUTS[layout] ?? plain(layout) },
  preferences: { value: (wishes) => listed(wishes, plain) },
  columns: { name: "lanes" },
  rows: { name: "length", value: (rows) => `${rows} rows` },
  step_seconds: { name: "time of a tick", value: (seconds) => `${seconds} s` },
};

/**
 * A change in words: `config.preferences` from `[]` to `["smooth_ride"]` is "preferences", "none" and "smooth ride".
 * @param {Change} change
 * @returns {{name: string, before: string, after: string}}
 */
export function changeWords({ path, before, after }) {
  const key = path.replace("config.", "");
  const figure = FIGURES[key] ?? {};
  const said = (/** @type {unknown} */ value) => (figure.value && value !== null && value !== undefined ? figure.value(value) : valueWords(value));
  return { name: figure.name ?? plain(key), before: said(before), after: said(after) };
}

/**
 * A value as text; null is a setting that nobody has chosen.
 * @param {unknown} value
 * @returns {string}
 */
export function valueWords(value) {
  if (value === null || value === undefined) return "not set";
  if (value === true) return "on";
  if (value === false) return "off";
  if (Array.isArray(value)) return listed(value, valueWords);
  if (typeof value === "object") return JSON.stringify(value);
  return String(value).replaceAll("_", " "); // a point belongs to its number
}

/** @param {any[]} values @param {(value: any) => string} words */
function listed(values, words) {
  return values.map(words).join(", ") || "none";
}

/**
 * A number of things: 1, "row" → "1 row"; 2 → "2 rows".
 * @param {number} number
 * @param {string} noun  one of them
 */
export function counted(number, noun) {
  return `${number} ${noun}${number === 1 ? "" : "s"}`;
}

/** @param {number | null} fraction */
export function percent(fraction) {
  return fraction === null ? "–" : `${Math.round(fraction * 100)} %`;
}

/**
 * Seconds as a clock of minutes: 75.5 → "1:15.5".
 * @param {number} seconds
 */
export function clock(seconds) {
  const tenths = Math.round(seconds * 10);
  const minutes = Math.floor(tenths / 600);
  const rest = ((tenths % 600) / 10).toFixed(1).padStart(4, "0");
  return `${minutes}:${rest}`;
}

/**
 * A sentence cut into pieces, those naming `words` marked. Words are taken in the order given, each
 * at its next place after the one before, so that only the second "and" is marked when only that one
 * was not understood; a word out of order is looked for from the start.
 * @param {string} sentence
 * @param {string[]} words
 * @returns {{text: string, marked: boolean}[]}
 */
export function markWords(sentence, words) {
  const lower = sentence.toLowerCase();
  /** @type {[number, number][]} */
  const spans = [];
  let from = 0;
  for (const word of words) {
    const at = wholeWord(lower, word.toLowerCase(), from) ?? wholeWord(lower, word.toLowerCase(), 0);
    if (at === null) continue;
    spans.push([at, at + word.length]);
    from = at + word.length;
  }
  spans.sort(([a], [b]) => a - b);
  const pieces = [];
  let end = 0;
  for (const [start, stop] of spans) {
    if (start < end) continue;
    if (start > end) pieces.push({ text: sentence.slice(end, start), marked: false });
    pieces.push({ text: sentence.slice(start, stop), marked: true });
    end = stop;
  }
  if (end < sentence.length) pieces.push({ text: sentence.slice(end), marked: false });
  return pieces;
}

/**
 * Where `word` stands as a word of its own, from a position on.
 * @param {string} text
 * @param {string} word
 * @param {number} from
 * @returns {number | null}
 */
function wholeWord(text, word, from) {
  if (word === "") return null;
  const partOfWord = /[\p{L}\p{N}]/u;
  for (let at = text.indexOf(word, from); at !== -1; at = text.indexOf(word, at + 1)) {
    const before = text[at - 1] ?? " ";
    const after = text[at + word.length] ?? " ";
    if (!partOfWord.test(before) && !partOfWord.test(after)) return at;
  }
  return null;
}
