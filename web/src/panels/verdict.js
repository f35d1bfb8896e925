// @ts-check
/** What lies over the road: how an episode ended, that the clock stands, that there is no session. */

import { html, nothing } from "../../vendor/lit-html.js";
import { t } from "../core/texts.js";
import { createSlot } from "../ui/slot.js";

/** @import { Page } from "../core/page.js" */
/** @import { State } from "../core/state.js" */
/** @import { Panel } from "./index.js" */

/** @typedef {{title: string, tone: string, text?: string, offer?: string}} Verdict */

const TONES = /** @type {Record<string, string>} */ ({ crash: "bad", success: "good", stuck: "bad" });

/** Events that tell of a road and not of an end. */
const OF_ROADS = new Set(["episode_started", "road_kept", "no_way", "way_open"]);

/** @param {HTMLElement} host @param {Page} page @returns {Panel} */
export function createVerdict(host, page) {
  const show = createSlot(host);
  /** What is shown, and of what: an end keeps the words it came with. */
  let key = "";
  /** @type {Verdict | null} */ let verdict = null;

  return {
    update(state) {
      const next = keyOf(state);
      if (next !== key) verdict = next === "" ? null : verdictOf(state);
      key = next;
      const paused = state.world?.paused && state.world.status === "running";
      show(html`${verdict ? over(verdict, page) : nothing}${paused ? html`<p class="paused">${t("verdict.paused")}</p>` : nothing}`);
    },
  };
}

/** @param {Verdict} verdict @param {Page} page */
function over({ title, tone, text, offer }, page) {
  return html`<div class="verdict" data-tone=${tone}>
    <p class="verdict-title">${title}</p>
    ${text ? html`<p class="verdict-text">${text}</p>` : nothing}
    ${offer ? html`<button class="button strong" type="button" @click=${page.startSession}>${offer}</button>` : nothing}
  </div>`;
}

/** Changes exactly when what is shown must. @param {State} state */
function keyOf(state) {
  if (state.trouble) return `trouble ${state.trouble}`;
  const { phase } = state.connection;
  if (phase === "missing" || phase === "gone") return phase;
  const { world } = state;
  if (world === null) return phase === "lost" ? "waiting" : "";
  return world.status === "running" ? "" : `${world.status} ${world.episode}`;
}

/** @param {State} state @returns {Verdict} */
function verdictOf(state) {
  const { phase } = state.connection;
  if (state.trouble) return { title: t("verdict.no_session"), tone: "bad", text: state.trouble, offer: t("verdict.try_again") };
  if (phase === "missing") return { title: t("verdict.not_found"), tone: "plain", text: t("verdict.not_found_text"), offer: t("verdict.new_session") };
  if (phase === "gone") return { title: t("verdict.ended"), tone: "plain", text: t("verdict.ended_text"), offer: t("verdict.new_session") };
  const { world } = state;
  if (world === null) return { title: t("verdict.waiting"), tone: "plain", text: t("verdict.waiting_text") };
  const last = state.log.findLast(({ tone, type }) => tone === "event" && !OF_ROADS.has(type));
  return { title: t(`verdict.${world.status}`), tone: TONES[world.status] ?? "plain", text: last?.text };
}
