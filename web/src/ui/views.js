// @ts-check
/**
 * What can be shown, hidden and enlarged: the names are those of the language's `show` and `hide`, so that what is
 * pressed here and what is said, by anyone who watches the session, is the same thing.
 */

import { preference, prefer } from "../core/preferences.js";

/** @typedef {Record<string, boolean>} Views  by name, whether it is shown */

/** Parts of the page, in the order of their keys 1–6. */
export const PARTS = ["road", "schematic", "plan", "occupancy", "metrics", "log"];

/** What can lie over the road. */
export const LAYERS = ["path", "potholes", "forecast", "boxes"];

/** How the road is seen: from behind and above the vehicle in place of from above. */
export const PERSPECTIVE = "perspective";

/** What stands under the timeline: the whole run's risk, regret and clearance. */
export const STRIP = "strip";

/** A narrow screen has room for one of them. */
const NARROW_PX = 600;

/** @type {Views} */
export const INITIAL_VIEWS = {
  road: true, schematic: !(globalThis.innerWidth < NARROW_PX), plan: true, occupancy: true, metrics: true, log: true,
  path: true, potholes: false, forecast: false, boxes: false, strip: false, perspective: false,
  service: false, // whether the service's own pictures are seen in place of the page's
};

const KEPT = "views";

/** As it was left, as far as that can be read. @returns {Views} */
export function viewsLeft() {
  try {
    return viewsAfter(INITIAL_VIEWS, JSON.parse(preference(KEPT, "{}")));
  } catch {
    return INITIAL_VIEWS;
  }
}

/** @param {Views} views */
export function keepViews(views) {
  const changed = Object.entries(views).filter(([name, on]) => on !== INITIAL_VIEWS[name]);
  prefer(KEPT, JSON.stringify(Object.fromEntries(changed)));
}

/**
 * With some shown or hidden; what has no place on this page is left out.
 * @param {Views} views
 * @param {Record<string, unknown> | null | undefined} change
 * @returns {Views}  the same where nothing is changed
 */
export function viewsAfter(views, change) {
  const news = Object.entries(change ?? {}).filter(
    ([name, on]) => Object.hasOwn(INITIAL_VIEWS, name) && typeof on === "boolean" && on !== views[name],
  );
  return news.length === 0 ? views : { ...views, .../** @type {Views} */ (Object.fromEntries(news)) };
}
