// @ts-check
/** Names and figures in words: moves, reasons, planners, changes; and marking words inside a sentence. */

import { decimalText, nameText, t } from "./texts.js";

/** @import { Change, Move } from "./protocol.js" */

const ARROWS = /** @type {Record<Move, string>} */ ({
  forward: "↑",
  left: "←",
  right: "→",
  forward_left: "↖",
  forward_right: "↗",
  stay: "·",
});

/** Each move's arrow and name. */
export const MOVES = /** @type {Record<Move, {arrow: string, name: string}>} */ (
  Object.fromEntries(Object.entries(ARROWS).map(([move, arrow]) => [move, { arrow, name: t(`moves.${move}`) }]))
);

/**
 * The name of a move; one the page does not know is shown as it is spelt.
 * @param {string} move
 */
export function moveName(move) {
  return nameText("moves", move);
}

/**
 * A planner's reason in a word or two; of a mover it is said whether it walks.
 * @param {string} reason
 * @param {string[]} [causes]  ids of what is in the way
 */
export function reasonWords(reason, causes = []) {
  const walks = causes[0]?.startsWith("pedestrian-") ?? false;
  return nameText("reasons", walks ? reason.replace(/^mover_/, "pedestrian_") : reason);
}

/**
 * A name from the wire as words: "success_rate" → "success rate".
 * @param {string} name
 */
export function plain(name) {
  return name.replaceAll("_", " ").replaceAll(".", " ");
}

/** Planners in the order of the choice; others go by the name they were registered under. */
export const PLANNERS = ["rules", "priority", "astar", "dijkstra", "bfs"];

/** Families of roads, in the order in which they are offered. */
export const LAYOUTS = ["walls", "narrows", "dead_ends", "crossing", "maze"];

/** @param {string} name */
export function plannerName(name) {
  return nameText("planners", name);
}

/** @param {string} name */
export function layoutName(name) {
  return nameText("layouts", name);
}

/**
 * How the values of some figures are said.
 * @type {Record<string, ((value: any) => string) | undefined>}
 */
const VALUES = {
  mode: (mode) => nameText("values", mode),
  queue: (moves) => listed(moves, moveName),
  playback_speed: paceText,
  planner: plannerName,
  layout: layoutName,
  preferences: (wishes) => listed(wishes, plain),
  rows: (count) => t("units.rows", { count }),
  step_seconds: (value) => t("units.seconds", { value }),
};

/** How fast the clock plays. @param {number | "max"} pace */
export function paceText(pace) {
  return pace === "max" ? t("units.pace_max") : t("units.pace", { value: pace });
}

/**
 * A change in words: `config.preferences` from `[]` to `["smooth_ride"]` is "preferences", "none" and "smooth ride".
 * @param {Change} change
 * @returns {{name: string, before: string, after: string}}
 */
export function changeWords({ path, before, after }) {
  const key = path.replace("config.", "");
  const value = VALUES[key];
  const said = (/** @type {unknown} */ of) => (value && of !== null && of !== undefined ? value(of) : valueWords(of));
  return { name: nameText("figures", key), before: said(before), after: said(after) };
}

/**
 * A value as text; null is a setting that nobody has chosen.
 * @param {unknown} value
 * @returns {string}
 */
export function valueWords(value) {
  if (value === null || value === undefined) return t("values.unset");
  if (typeof value === "boolean") return t(value ? "values.yes" : "values.no");
  if (Array.isArray(value)) return listed(value, valueWords);
  if (typeof value === "object") return JSON.stringify(value);
  return String(value).replaceAll("_", " "); // a point belongs to its number
}

/** @param {any[]} values @param {(value: any) => string} words */
function listed(values, words) {
  return values.map(words).join(", ") || t("values.none");
}

/** @param {number | null} fraction */
export function percent(fraction) {
  return fraction === null ? t("units.none") : t("units.percent", { value: Math.round(fraction * 100) });
}

/**
 * Seconds as a clock of minutes: 75.5 → "1:15.5".
 * @param {number} seconds
 */
export function clock(seconds) {
  const tenths = Math.round(seconds * 10);
  const minutes = Math.floor(tenths / 600);
  const rest = decimalText((tenths % 600) / 10, 1).padStart(4, "0");
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
