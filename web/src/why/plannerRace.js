// @ts-check
/** Planner beside planner on one road: who drives at each side, how fast it plays, where they part and why, and its link. */

import { html, live, nothing } from "../../vendor/lit-html.js";
import { hashOf, raceHash } from "../core/address.js";
import { t } from "../core/texts.js";
import { paceText, PLANNERS, plannerName } from "../core/words.js";
import { nameOfOther, nameOfReal } from "./counterfactual.js";

/** @import { Hypothesis } from "./alternatives.js" */
/** @import { Comparison } from "./counterfactual.js" */

/** @typedef {Extract<Hypothesis, {kind: "planners"}>} Race */

const SPEEDS = [0.5, 1, 2, 4, 8];

/**
 * The choice of the planner of a side; another one drives both anew.
 * @param {Race} race
 * @param {"real" | "changed"} side
 * @param {(wanted: Hypothesis) => void} choose
 */
export function plannerChoice(race, side, choose) {
  const at = side === "real" ? 0 : 1;
  const names = [...new Set([...PLANNERS, ...race.planners])];
  const pick = (/** @type {{target: HTMLSelectElement}} */ { target }) => {
    const planners = /** @type {[string, string]} */ ([...race.planners]);
    planners[at] = target.value;
    choose({ ...race, planners });
  };
  return html`<select class="beside-planner" aria-label=${t(at === 0 ? "planner_race.left" : "planner_race.right")} @change=${pick}>
    ${names.map((name) => html`<option value=${name} .selected=${live(name === race.planners[at])}>${plannerName(name)}</option>`)}
  </select>`;
}

/** @param {number} speed @param {(value: number) => void} choose */
export function speedChoice(speed, choose) {
  const pick = (/** @type {{target: HTMLSelectElement}} */ { target }) => choose(Number(target.value));
  return html`<select class="speed" aria-label=${t("clock.speed")} @change=${pick}>
    ${SPEEDS.map((each) => html`<option value=${each} .selected=${live(each === speed)}>${paceText(each)}</option>`)}
  </select>`;
}

/**
 * Where the two first decide differently, with the reason of each.
 * @param {Comparison} found
 * @param {Hypothesis | null} other
 * @param {() => void} go
 */
export function partingTemplate({ parting }, other, go) {
  if (other?.kind !== "planners") return nothing;
  if (parting === null) return html`<p class="beside-part">${t("planner_race.same")}</p>`;
  const { tick, real, changed } = parting;
  return html`<div class="beside-part">
    <button class="button small" type="button" data-part @click=${go}>${t("planner_race.parting", { tick })}</button>
    <span><b>${nameOfReal(other)}:</b> ${real.text} <b>${nameOfOther(other)}:</b> ${changed.text}</span>
  </div>`;
}

/** The address leads to a race of planners while it is seen. @param {string | null} session @param {Hypothesis | null} other */
export function raceAddress(session, other) {
  const seen = other?.kind === "planners";
  if (session === null || (!seen && !location.hash.startsWith("#/c/"))) return;
  history.replaceState(null, "", seen ? raceHash(session, other.planners, other.tick) : hashOf(session));
}
