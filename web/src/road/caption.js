// @ts-check
/** One line under the road: the move under way and its reason; else how the episode ended, or that nothing was decided yet. */

import { html, render } from "../../vendor/lit-html.js";
import { t } from "../core/texts.js";
import { MOVES } from "../core/words.js";

/** @import { Panel } from "../panels/index.js" */
/** @import { World } from "./world.js" */

/** @param {HTMLElement} host @returns {Panel} */
export function createCaption(host) {
  return {
    update({ decision, narration, world }, before) {
      if (decision === before.decision && world === before.world) return;
      const move = decision && MOVES[decision.move];
      host.dataset.move = decision?.move ?? "";
      render(
        html`<span class="caption-arrow" aria-hidden="true">${move?.arrow ?? ""}</span><span class="caption-text">${narration ?? (move ? t("road.moving", { move: move.name }) : world ? without(world) : "")}</span>`,
        host,
      );
    },
  };
}

/** What stands there while no move is under way. @param {World} world */
function without({ status, tick }) {
  if (status !== "running") return t(`verdict.${status}`);
  return tick === 0 ? t("bubble.undecided") : "";
}
