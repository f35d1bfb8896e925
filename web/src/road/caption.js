// @ts-check
/** One line under the road: the move under way and its reason. */

import { make, setText } from "../ui/dom.js";
import { MOVES } from "../core/words.js";

/** @import { Panel } from "../panels/index.js" */

/** @param {HTMLElement} host @returns {Panel} */
export function createCaption(host) {
  const arrow = make("span", { class: "caption-arrow", "aria-hidden": "true" });
  const text = make("span", { class: "caption-text" });
  host.append(arrow, text);

  return {
    update({ decision, narration, world }, before) {
      if (decision === before.decision && world === before.world) return;
      const move = decision && MOVES[decision.move];
      setText(arrow, move?.arrow ?? "");
      setText(text, narration ?? (move ? `Moving ${move.name}` : ""));
      host.dataset.move = decision?.move ?? "";
    },
  };
}
