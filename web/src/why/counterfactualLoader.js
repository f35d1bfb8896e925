// @ts-check
/** What would have been beside what was (`counterfactualView.js`), fetched when somebody first wants to see it. */

import { onDemand, styled } from "../core/lazy.js";

/** @import { Page } from "../core/page.js" */
/** @import { Panel } from "../panels/index.js" */

/** @param {HTMLElement} host @param {Page} page @returns {Panel} */
export function createCounterfactual(host, page) {
  /** @type {Panel | null} */ let panel = null;
  const wanted = onDemand(page, async () => {
    const [{ createCounterfactualView }] = await Promise.all([import("./counterfactualView.js"), styled("beside")]);
    const view = createCounterfactualView(host, page);
    panel = view;
    return view;
  });

  return {
    update(state, before) {
      const { comparison } = state;
      if (comparison !== null && comparison !== before.comparison) wanted(({ open }) => open(comparison.other));
      panel?.update?.(state, before);
    },
    repaint: () => panel?.repaint?.(),
  };
}
