// @ts-check
/** Events along a run: in words, by importance, the next of a kind, and the length of the timeline. */

import { listText, nameText, t } from "../core/texts.js";

/** @import { Kind, TimelineEvent } from "./timelineState.js" */

/** What one can jump between; the first means any of them. @type {{name: string, kinds: Kind[]}[]} */
export const JUMPS = [
  { name: "any", kinds: ["crash", "stuck", "success", "near_miss", "command", "fork"] },
  { name: "crash", kinds: ["crash", "stuck"] },
  { name: "near_miss", kinds: ["near_miss"] },
  { name: "wait", kinds: ["wait"] },
  { name: "detour", kinds: ["detour"] },
  { name: "command", kinds: ["command"] },
  { name: "episode", kinds: ["episode"] },
];

/**
 * The nearest event of some kinds before or after a tick.
 * @param {TimelineEvent[]} events  by tick
 * @param {Kind[]} kinds
 * @param {number} tick
 * @param {1 | -1} direction
 * @returns {TimelineEvent | null}
 */
export function nextEvent(events, kinds, tick, direction) {
  const found = events.filter((event) => kinds.includes(event.kind) && (event.tick - tick) * direction > 0);
  return (direction > 0 ? found[0] : found.at(-1)) ?? null;
}

/** Where several share a place, the first is told and drawn. @type {Kind[]} */
const IMPORTANCE = ["crash", "stuck", "success", "fork", "command", "near_miss", "episode", "wait", "detour"];

/** The most important first. @param {TimelineEvent[]} events @returns {TimelineEvent[]} */
export function byImportance(events) {
  return [...events].sort((a, b) => IMPORTANCE.indexOf(a.kind) - IMPORTANCE.indexOf(b.kind));
}

/**
 * Events that touch a stretch of ticks.
 * @param {TimelineEvent[]} events
 * @param {number} first
 * @param {number} last
 */
export function eventsIn(events, first, last) {
  return events.filter(({ tick, ticks = 1 }) => tick <= last && tick + ticks - 1 >= first);
}

/**
 * What is at a tick or within a reach of it, in words: of each kind the nearest, and how many more.
 * @param {TimelineEvent[]} events
 * @param {number} tick
 * @param {number} reach  ticks
 */
export function eventsNear(events, tick, reach) {
  const distance = (/** @type {TimelineEvent} */ { tick: at, ticks = 1 }) => Math.max(at - tick, tick - at - ticks + 1, 0);
  const near = eventsIn(events, tick - reach, tick + reach).filter(({ kind }) => kind !== "episode" || reach < 3);
  const kinds = [...new Set(byImportance(near).map(({ kind }) => kind))];
  return kinds.map((kind) => {
    const alike = near.filter((event) => event.kind === kind).sort((a, b) => distance(a) - distance(b));
    const text = eventText(alike[0]);
    const placed = distance(alike[0]) > 0 ? t("timeline.near", { text, tick: alike[0].tick }) : text;
    return alike.length > 1 ? t("timeline.alike", { text: placed, count: alike.length }) : placed;
  });
}

/** An event in words. @param {TimelineEvent} event */
export function eventText({ kind, ids = [], ticks = 1, text = "" }) {
  const things = listText(new Set(ids.map((id) => nameText("kinds", id.split("-")[0])))) || t("timeline.events.something");
  const key = kind === "crash" && ids.length > 0 ? "crash_with" : kind;
  return t(`timeline.events.${key}`, { things, text, count: ticks });
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
