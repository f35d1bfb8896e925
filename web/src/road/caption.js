// @ts-check
/** One line under the road: the move under way and its reason. */

import { html, render } from "../../vendor/lit-html.js";
import { t } from "../core/texts.js";
import { MOVES } from "../core/words.js";

/** @import { Panel } from "../panels/index.js" */

/** @param {HTMLElement} host @returns {Panel} */
export function createCaption(host) {
  return {
    update({ decision, narration, world }, before) {
      if (decision === before.decision && world === before.world) return;
      const move = decision && MOVES[decision.move];
      host.dataset.move = decision?.move ?? "";
      render(
        html`<span class="caption-arrow" aria-hidden="true">${move?.arrow ?? ""}</span><span class="caption-text">${narration ?? (move ? t("road.moving", { move: move.name }) : "")}</span>`,
        host,
      );
    },
  };
}
