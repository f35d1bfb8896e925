// @ts-check
/** Marks along a run: in words, by loudness, the next of a kind, and how long the line is that they stand on. */

/** @import { Kind, Mark } from "./runChart.js" */

/** The kinds one can jump between; the first means any of them. */
export const JUMPS = /** @type {{name: string, label: string, kinds: Kind[]}[]} */ ([
  { name: "any", label: "mark", kinds: ["crash", "stuck", "success", "near_miss", "command", "fork"] },
  { name: "crash", label: "crash", kinds: ["crash", "stuck"] },
  { name: "near_miss", label: "near miss", kinds: ["near_miss"] },
  { name: "wait", label: "wait", kinds: ["wait"] },
  { name: "detour", label: "detour", kinds: ["detour"] },
  { name: "command", label: "change", kinds: ["command"] },
  { name: "episode", label: "episode", kinds: ["episode"] },
]);

/**
 * The nearest mark of some kinds before or after a tick.
 * @param {Mark[]} marks  by tick
 * @param {Kind[]} kinds
 * @param {number} tick
 * @param {1 | -1} direction
 * @returns {Mark | null}
 */
export function nextMark(marks, kinds, tick, direction) {
  const found = marks.filter((mark) => kinds.includes(mark.kind) && (mark.tick - tick) * direction > 0);
  return (direction > 0 ? found[0] : found.at(-1)) ?? null;
}

/** How loud a mark is where several share a place. */
const LOUDNESS = /** @type {Kind[]} */ (["crash", "stuck", "success", "fork", "command", "near_miss", "episode", "wait", "detour"]);

/** The loudest first. @param {Mark[]} marks @returns {Mark[]} */
export function byLoudness(marks) {
  return [...marks].sort((a, b) => LOUDNESS.indexOf(a.kind) - LOUDNESS.indexOf(b.kind));
}

/**
 * Marks that touch a stretch of ticks.
 * @param {Mark[]} marks
 * @param {number} first
 * @param {number} last
 */
export function marksIn(marks, first, last) {
  return marks.filter(({ tick, ticks = 1 }) => tick <= last && tick + ticks - 1 >= first);
}

const NAMES = /** @type {Record<Kind, string>} */ ({
  crash: "Crash",
  stuck: "Stuck",
  success: "Arrived",
  near_miss: "Near miss",
  episode: "An episode begins",
  command: "Change",
  fork: "Forked here",
  wait: "Waits",
  detour: "Detour",
});

/**
 * A mark in words.
 * @param {Mark} mark
 */
export function markWords({ kind, ids = [], ticks = 1, text }) {
  const things = ids.map((id) => id.replace("-", " ")).join(" and ");
  const long = ticks > 1 ? ` of ${ticks} ticks` : "";
  if (kind === "crash") return things ? `Crash with ${things}` : "Crash";
  if (kind === "near_miss") return `Near miss: ${things || "something"} moved into the cell just left`;
  if (kind === "command") return `“${text}”`;
  if (kind === "wait") return ticks > 1 ? `Waits for ${ticks} ticks` : "Waits";
  return `${NAMES[kind]}${kind === "detour" ? long : ""}`;
}

/**
 * How many ticks the line is long: round figures, so that it does not crawl with every tick.
 * @param {number} now
 */
export function spanOf(now) {
  for (let decade = 10; ; decade *= 10) {
    for (const share of [1, 1.25, 1.6, 2, 2.5, 3.2, 4, 5, 6.4, 8]) {
      const span = Math.round(decade * share);
      if (span >= 64 && span >= now) return span;
    }
  }
}
