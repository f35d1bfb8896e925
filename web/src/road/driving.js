// @ts-check
/** Who drives, and by which key that is changed; driving itself (`manualDrive.js`) is fetched when a person first does. */

import { lazyPanel, styled } from "../core/lazy.js";
import { t } from "../core/texts.js";
import { driveAgain } from "../panels/ending.js";

/** @import { Page } from "../core/page.js" */
/** @import { Panel } from "../panels/index.js" */

/** @param {HTMLElement} host  the road @param {HTMLElement} place  where one drives, beside it @param {Page} page @returns {Panel} */
export function createDriving(host, place, page) {
  const manual = lazyPanel(
    page,
    ({ world }) => world?.mode === "manual",
    async () => {
      const [{ createManualDrive }] = await Promise.all([import("./manualDrive.js"), styled("wheel")]);
      return createManualDrive(host, place, page);
    },
  );

  return {
    commands: [
      {
        name: "manual",
        button: true,
        group: t("groups.drive"),
        key: "m",
        keyName: "M",
        now: (state) => {
          const { world } = state;
          // There is nothing to drive at an end.
          if (world && world.status !== "running") return { label: t("ending.drive"), icon: "wheel", turns: [driveAgain(state)] };
          const mode = world?.mode === "manual" ? "auto" : "manual";
          return { label: t(`drive.${mode}`), icon: "wheel", pressed: mode === "auto", turns: [[{ do: "mode", mode }]] };
        },
      },
      {
        name: "pause",
        group: t("groups.clock"),
        key: "p",
        keyName: "P",
        now: ({ world }) =>
          world?.paused
            ? { label: t("clock.resume"), icon: "play", turns: [[{ do: "resume" }]] }
            : { label: t("clock.pause"), icon: "pause", turns: [[{ do: "pause" }]] },
      },
    ],

    update: manual.update,
  };
}
