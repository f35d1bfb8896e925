// @ts-check
/** The road in perspective (`perspective/`), fetched when somebody first wants to see it; until then it is seen from above. */

import { lazyPanel } from "../core/lazy.js";

/** @import { Page } from "../core/page.js" */
/** @import { Panel } from "../panels/index.js" */
/** @import { Perspective } from "./perspective/perspective.js" */

/** @param {{deepen: (view: Perspective) => void}} road @param {Page} page @returns {Panel} */
export function createPerspective(road, page) {
  return lazyPanel(
    page,
    ({ views }) => views.perspective,
    async () => {
      const { Perspective } = await import("./perspective/perspective.js");
      road.deepen(new Perspective());
      page.wake();
      return {};
    },
  );
}
