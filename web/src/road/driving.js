// @ts-check
/** Who drives, and by which key that is changed; the wheel itself (`wheel.js`) is fetched when a person first takes it. */

import { onDemand, styled } from "../core/lazy.js";

/** @import { Page } from "../main.js" */
/** @import { Panel } from "../panels/index.js" */

/** @param {HTMLElement} host  the road @param {Page} page @returns {Panel} */
export function createDriving(host, page) {
  /** @type {Panel | null} */ let wheel = null;
  const wanted = onDemand(page, async () => {
    const [{ createWheel }] = await Promise.all([import("./manualDrive.js"), styled("wheel")]);
    return (wheel = createWheel(host, page));
  });

  return {
    acts: [
      {
        name: "manual",
        group: "Drive",
        key: "m",
        keyName: "M",
        now: ({ world }) =>
          world?.mode === "manual"
            ? { label: "Let it drive itself", icon: "wheel", turns: [[{ do: "mode", mode: "auto" }]] }
            : { label: "Drive by hand", icon: "wheel", turns: [[{ do: "mode", mode: "manual" }]] },
      },
      {
        name: "pause",
        group: "Clock",
        key: "p",
        keyName: "P",
        now: ({ world }) =>
          world?.paused
            ? { label: "Resume", icon: "play", turns: [[{ do: "resume" }]] }
            : { label: "Pause", icon: "pause", turns: [[{ do: "pause" }]] },
      },
    ],

    update(state, before) {
      if (wheel) wheel.update?.(state, before);
      else if (state.world?.mode === "manual") wanted((made) => made.update?.(page.state(), before));
    },
  };
}
