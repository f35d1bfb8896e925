// @ts-check
/** What lies over the road: how an episode ended, that the clock stands, that there is no session. */

import { html, nothing } from "../../vendor/lit-html.js";
import { t } from "../core/texts.js";
import { egoOf } from "../road/world.js";
import { icon } from "../ui/icons.js";
import { createSlot } from "../ui/slot.js";
import { createHold, endingTemplate, endOf, endsNow, goOn } from "./ending.js";

/** @import { Page } from "../core/page.js" */
/** @import { State } from "../core/state.js" */
/** @import { Places } from "../road/hitTest.js" */
/** @import { Panel } from "./index.js" */

/** @typedef {{title: string, tone: string, text?: string, offer?: string}} Verdict */

const TONES = /** @type {Record<string, string>} */ ({ crash: "bad", success: "good", stuck: "bad" });

/** @param {HTMLElement} host  the road @param {Page} page @param {Places} places  of the road @returns {Panel} */
export function createVerdict(host, page, places) {
  const show = createSlot(host);
  const hold = createHold(page);
  /** What is shown, and of what: an end keeps the words it came with. */
  let key = "";
  /** Whether of the card only its title is seen, until the next end. */
  let folded = false;
  /** @type {Verdict | null} */ let verdict = null;

  /** @param {State} state */
  function write(state) {
    const ended = verdict !== null && state.world !== null && state.world.status !== "running" && !state.trouble;
    const here = hold.follow() || state.past === null;
    host.toggleAttribute("data-ended", ended && here);
    const paused = state.world?.paused && state.world.status === "running";
    const more = ended && here && state.connection.phase === "live" ? endingTemplate(state, page) : nothing;
    const fold = () => {
      folded = !folded;
      write(state);
    };
    const card = verdict ? over(verdict, { folded, fold: ended ? foldButton(folded, fold) : nothing, more }, page) : nothing;
    show(html`${card}${paused ? html`<p class="paused">${t("verdict.paused")}</p>` : nothing}`);
  }

  return {
    commands: [
      {
        name: "next-episode",
        group: t("groups.clock"),
        key: "e",
        keyName: "E",
        now: ({ past, world, log }) =>
          world && !past && world.status !== "running"
            ? { label: t("ending.next"), run: () => void goOn(page, endOf({ .../** @type {State} */ (page.state()), log })?.to ?? world.tick) }
            : null,
      },
    ],

    update(state, before) {
      const next = keyOf(state);
      if (next !== key) [verdict, folded] = [next === "" ? null : verdictOf(state), false];
      key = next;
      if (endsNow(state, before)) void hold.begin(/** @type {NonNullable<State["world"]>} */ (state.world));
      write(state);
    },

    /** The card stands where the crash is not. */
    draw() {
      const card = /** @type {HTMLElement | null} */ (host.querySelector(".verdict"));
      const { world } = page.state();
      const cell = world && (world.cause?.cell ?? egoOf(world)?.cell);
      const place = card && cell && places.placeOf(cell);
      if (!card || !place) return false;
      const { top, height } = host.getBoundingClientRect();
      card.dataset.at = place.top + place.height / 2 > top + height / 2 ? "top" : "bottom";
      return false;
    },
  };
}

/** Shows the title alone, or all of the card again. @param {boolean} folded @param {() => void} fold */
function foldButton(folded, fold) {
  const label = t(folded ? "ending.unfold" : "ending.fold");
  return html`<button class="verdict-fold" type="button" aria-expanded=${String(!folded)} aria-label=${label} title=${label} @click=${fold}>${icon(folded ? "plus" : "minus")}</button>`;
}

/**
 * @param {Verdict} verdict
 * @param {{folded: boolean, fold: unknown, more: unknown}} parts  `fold`: the button for that; `more`: what can be done about an end
 * @param {Page} page
 */
function over({ title, tone, text, offer }, { folded, fold, more }, page) {
  return html`<div class="verdict" data-tone=${tone} ?data-folded=${folded}>
    <p class="verdict-title">${title}</p>
    ${fold}
    ${text ? html`<p class="verdict-text">${text}</p>` : nothing}
    ${offer ? html`<button class="button strong" type="button" @click=${page.startSession}>${offer}</button>` : nothing}
    ${more}
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
  return { title: t(`verdict.${world.status}`), tone: TONES[world.status] ?? "plain", text: endOf(state)?.text };
}
