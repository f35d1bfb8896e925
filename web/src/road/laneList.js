// @ts-check
/** The road in words, for those who do not see it: to be read when wished, brought up to date quietly. */

import { html } from "../../vendor/lit-html.js";
import { t } from "../core/texts.js";
import { createSlot } from "../ui/slot.js";
import { roadWords } from "./laneSentences.js";

/** @import { State } from "../core/state.js" */
/** @import { Panel } from "../panels/index.js" */

/** While the clock runs, sentences stay this long, so that they can be read to their end. */
const STAYS_MS = 4_000;

/** @param {HTMLElement} road @returns {Panel} */
export function createLanes(road) {
  const show = createSlot(/** @type {HTMLElement} */ (road.parentElement), road.nextSibling);
  let writtenAt = -Infinity;
  /** @type {any} */ let timer = null;
  /** @type {State | null} */ let latest = null;

  function write() {
    clearTimeout(timer);
    timer = null;
    if (!latest?.world) return;
    writtenAt = performance.now();
    const lines = roadWords(latest.world, latest.past ? null : latest.decision);
    show(
      html`<div class="unseen lanes" id="lanes" role="region" aria-label=${t("road.in_words")} tabindex="0">
        <ul>${lines.map((line) => html`<li>${line}</li>`)}</ul>
      </div>`,
    );
  }

  return {
    update(state, before) {
      if (state.world === null || (state.world === before.world && latest !== null)) return;
      latest = state;
      const waits = state.world.paused || state.past ? 0 : STAYS_MS - (performance.now() - writtenAt);
      if (waits <= 0) write();
      else timer ??= setTimeout(write, waits);
    },
  };
}
