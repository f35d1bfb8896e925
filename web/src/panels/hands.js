// @ts-check
/** All that is done with the road by hand, over one surface that takes the pointer and the focus. */

import { make } from "../dom.js";
import { offerPlaces } from "../hits.js";
import { createCursor } from "./cursor.js";
import { createDriving } from "./driving.js";
import { watchPointing } from "./pointing.js";
import { createTouch } from "./touch.js";

/** @import { Places } from "../hits.js" */
/** @import { Page } from "../main.js" */
/** @import { Card } from "./bubble.js" */
/** @import { Panel } from "./index.js" */

/**
 * @param {HTMLElement} host  the road
 * @param {Places} places
 * @param {HTMLElement} log
 * @param {Page} page
 * @param {Card} card
 * @returns {Panel[]}
 */
export function createHands(host, places, log, page, card) {
  const surface = make("div", { class: "road-hands" });
  host.querySelector("canvas")?.after(surface);
  offerPlaces(surface, places);
  watchPointing(page, card, log);
  const touch = createTouch(host, surface, places, page, card);
  return [touch, createCursor(surface, places, page, card, touch), createDriving(host, page)];
}
