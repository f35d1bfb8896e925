// @ts-check
/** Begins the tour when somebody wants it; it is fetched then. */

import { onDemand, styled } from "../core/lazy.js";
import { t } from "../core/texts.js";

/** @import { Page } from "../core/page.js" */
/** @import { Panel } from "./index.js" */

/** @type {((use: (begin: () => void) => unknown) => Promise<unknown>) | null} */ let tour = null;

/** @param {Page} page */
export function beginTour(page) {
  tour ??= onDemand(page, async () => {
    const [{ createTour }] = await Promise.all([import("./tour.js"), styled("tour")]);
    return createTour(page);
  });
  void tour((begin) => begin());
}

/** @param {Page} page @returns {Panel} */
export function createTourLoader(page) {
  return { commands: [{ name: "tour", group: t("groups.help"), now: () => ({ label: t("tour.begin"), run: () => beginTour(page) }) }] };
}
