// @ts-check
/** The road as the service draws it (`serverVideo.js`), fetched when somebody first wants to see that. */

import { lazyPanel } from "../core/lazy.js";

/** @import { Page } from "../core/page.js" */
/** @import { Panel } from "../panels/index.js" */

/** @param {HTMLElement} host  of the road @param {Page} page @returns {Panel} */
export function createServerVideo(host, page) {
  return lazyPanel(
    page,
    ({ views }) => views.service,
    async () => (await import("./serverVideo.js")).createServerVideo(host, page),
  );
}
