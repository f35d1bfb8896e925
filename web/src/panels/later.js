// @ts-check
/** Panels that the first frame does without: fetched together once it is drawn. */

import { createRoadInput } from "../road/roadInput.js";
import { byId } from "../ui/dom.js";
import { createMetrics } from "./metrics.js";

/** @import { Page } from "../core/page.js" */
/** @import { Places } from "../road/hitTest.js" */
/** @import { Card } from "../why/bubbleLoader.js" */
/** @import { Panel } from "./index.js" */

/** @param {Page} page @param {Places} places  of the road @param {Card} card @returns {Panel[]} */
export function createLaterPanels(page, places, card) {
  return [...createRoadInput(byId("road"), places, byId("log"), page, card), createMetrics(byId("metrics"), page)];
}
