// @ts-check
/** All that is done with the road by hand, over one surface that takes the pointer and the focus. */

import { html } from "../../vendor/lit-html.js";
import { t } from "../core/texts.js";
import { createSlot, find } from "../ui/slot.js";
import { offerPlaces } from "./hitTest.js";
import { servedView } from "./serverCamera.js";
import { sceneOf } from "../core/state.js";
import { egoOf } from "./world.js";
import { createCursor } from "./cursor.js";
import { watchPointing } from "../why/pointing.js";
import { createDragDrop } from "./dragDrop.js";

/** @import { Places } from "./hitTest.js" */
/** @import { Page } from "../core/page.js" */
/** @import { Card } from "../why/bubbleLoader.js" */
/** @import { Panel } from "../panels/index.js" */

/**
 * @param {HTMLElement} host  the road
 * @param {Places} places
 * @param {HTMLElement} log
 * @param {Page} page
 * @param {Card} card
 * @returns {Panel[]}
 */
export function createRoadInput(host, places, log, page, card) {
  createSlot(host, find(host, ".road-canvas").nextSibling)(
    html`<div class="road-hands" tabindex="0" role="application" aria-label=${t("road.cells")} aria-describedby="cursor-hint"></div>`,
  );
  const surface = find(host, ".road-hands");
  const seen = whereSeen(host, places, page);
  offerPlaces(surface, seen);
  watchPointing(page, card, log);
  const hands = createDragDrop(host, surface, seen, page, card);
  return [hands, createCursor(surface, seen, page, card, hands)];
}

/**
 * Where things are on whatever is shown of the road: the page's own drawing, or the service's picture over it.
 * @param {HTMLElement} host
 * @param {Places} own
 * @param {Page} page
 * @returns {Places}
 */
function whereSeen(host, own, page) {
  function served() {
    const picture = /** @type {HTMLCanvasElement | null} */ (host.querySelector(".service-canvas:not([hidden])"));
    const { world } = sceneOf(page.state());
    const ego = world && egoOf(world);
    if (!picture || !ego || picture.width === 0) return null;
    const frame = host.getBoundingClientRect();
    const view = servedView(frame, picture, world, own.poseOf?.(ego.id)?.row ?? ego.cell[1]);
    return { ...view, left: frame.left + view.left, top: frame.top + view.top };
  }

  return {
    ...own,
    cellAt(x, y) {
      const view = served();
      if (view === null) return own.cellAt(x, y);
      return [Math.floor((x - view.left) / view.cell), Math.floor((y - view.top) / view.cell + view.row)];
    },
    cellPx: () => served()?.cell ?? own.cellPx?.() ?? 0,
    placeOf([column, row]) {
      const view = served();
      if (view === null) return own.placeOf([column, row]);
      const { left, top, cell } = view;
      return { left: left + column * cell, top: top + (row - view.row) * cell, width: cell, height: cell };
    },
  };
}
