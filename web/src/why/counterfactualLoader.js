// @ts-check
/** What would have been beside what was (`beside.js`), fetched when somebody first wants to see it. */

import { onDemand, styled } from "../core/lazy.js";

/** @import { Page } from "../main.js" */
/** @import { Panel } from "../panels/index.js" */

/** @param {HTMLElement} host @param {Page} page @returns {Panel} */
export function createComparison(host, page) {
  /** @type {Panel | null} */ let panel = null;
  const wanted = onDemand(page, async () => {
    const [{ createBeside }] = await Promise.all([import("./counterfactualView.js"), styled("beside")]);
    const beside = createBeside(host, page);
    panel = beside;
    return beside;
  });
  page.pick = (other) => wanted(({ open }) => open(other));

  return {
    update: (state, before) => panel?.update?.(state, before),
    repaint: () => panel?.repaint?.(),
  };
}
