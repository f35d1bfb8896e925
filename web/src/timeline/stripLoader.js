// @ts-check
/** The strip under the timeline (`strip.js`), fetched when it is first shown. */

import { lazyPanel, styled } from "../core/lazy.js";

/** @import { Page } from "../core/page.js" */
/** @import { Panel } from "../panels/index.js" */

/** @param {HTMLElement} host @param {Page} page @returns {Panel} */
export function createStripLoader(host, page) {
  return lazyPanel(
    page,
    ({ views }) => views.strip,
    async () => {
      const [{ createStrip }] = await Promise.all([import("./strip.js"), styled("strip")]);
      return createStrip(host, page);
    },
  );
}
