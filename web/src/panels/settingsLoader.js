// @ts-check
/** Opens the settings and the legend; they are fetched then. */

import { onDemand, styled } from "../core/lazy.js";
import { t } from "../core/texts.js";
import { byId } from "../ui/dom.js";

/** @import { Page } from "../core/page.js" */
/** @import { Panel } from "./index.js" */

/** @param {Page} page @returns {Panel} */
export function createSettings(page) {
  /** @type {(Panel & {toggle: () => void}) | null} */ let drawer = null;
  const wanted = onDemand(page, async () => {
    const [{ createSettingsDrawer }] = await Promise.all([import("./settingsDrawer.js"), styled("settings")]);
    return (drawer = createSettingsDrawer(page));
  });
  const toggle = () => void wanted((made) => made.toggle());
  byId("settings-button").addEventListener("click", toggle);
  return {
    commands: [{ name: "settings", group: t("groups.views"), key: "o", keyName: "O", now: () => ({ label: t("settings.open"), run: toggle }) }],
    update: (state, before) => drawer?.update?.(state, before),
    repaint: () => drawer?.repaint?.(),
  };
}
