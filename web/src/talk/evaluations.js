// @ts-check
/** Evaluations that were asked for: how far they are, then in a sentence or two what came of them, and their reports. */

import { html, nothing } from "../../vendor/lit-html.js";
import { askJson, Refused } from "../core/http.js";
import { t } from "../core/texts.js";

/** @import { Page } from "../core/page.js" */
/** @import { State } from "../core/state.js" */
/** @import { StartedEvaluation } from "../core/wire.js" */
/** @import { Exchange } from "./exchanges.js" */

/** @typedef {{state: string, done: number, runs: number, text: string[] | null, error: string | null}} Standing */
/** @typedef {StartedEvaluation & Partial<Standing>} Followed  with how it stands, as soon as that is known */
/** @typedef {Standing & {planners: string[], conditions: unknown[]}} Told  by the service */

const [SOON_MS, LATER_MS] = [500, 5000];
const OVER = new Set(["done", "failed", "cancelled"]);
/** An evaluation that was deleted. @type {Told} */
const GONE = { state: "cancelled", done: 0, runs: 0, text: null, error: null, planners: [], conditions: [] };

/** Asks after every evaluation of the conversation until it is over. @param {Page} page */
export function followEvaluations(page) {
  /** @type {Set<string>} */ const followed = new Set();

  /** @param {State} state */
  function look({ talk }) {
    for (const each of talk.flatMap(evaluationsOf)) {
      if (OVER.has(each.state ?? "") || followed.has(each.id)) continue;
      followed.add(each.id);
      void follow(each, SOON_MS).finally(() => followed.delete(each.id));
    }
  }

  /** @param {Followed} evaluation @param {number} pauseMs */
  async function follow({ id, links }, pauseMs) {
    while (page.state().talk.flatMap(evaluationsOf).some((each) => each.id === id)) {
      /** @type {Told | null} */
      const told = await askJson(links.self).catch((error) => (error instanceof Refused && error.status === 404 ? GONE : null));
      if (told !== null) tell(page, id, told);
      if (OVER.has(told?.state ?? "")) return;
      await new Promise((done) => setTimeout(done, pauseMs));
      pauseMs = Math.min(LATER_MS, pauseMs * 1.2);
    }
  }

  page.subscribe(look);
  look(page.state());
}

/** Note in the conversation how an evaluation stands. @param {Page} page @param {string} id @param {Told} told */
function tell(page, id, told) {
  const { session, talk } = page.state();
  const { state, done, runs, error } = told;
  const text = told.text && inShort(told.text, told);
  /** @param {Followed} each */
  const isNews = (each) => each.id === id && (each.state !== state || each.done !== done);
  if (session === null || !talk.flatMap(evaluationsOf).some(isNews)) return;
  const now = talk.map((exchange) => {
    const known = evaluationsOf(exchange);
    if (!exchange.result || !known.some(isNews)) return exchange;
    const evaluations = known.map((each) => (each.id === id ? { ...each, state, done, runs, text, error } : each));
    return { ...exchange, result: { ...exchange.result, evaluations } };
  });
  page.dispatch({ type: "talk", session, talk: now });
  if (text) page.tell({ text: text.join(" "), aloud: true });
}

/**
 * Of each condition or planner the beginning of what is told: how often it arrived; of a single one also how it failed.
 * @param {string[]} paragraphs
 * @param {Told} told
 */
function inShort(paragraphs, { planners, conditions }) {
  const most = planners.length === 1 && conditions.length === 0 ? 2 : Math.max(1, conditions.length > 0 ? planners.length : 1);
  return paragraphs.slice(0, conditions.length || planners.length).map((each) => each.split(/(?<=\.) (?=\p{Lu})/u).slice(0, most).join(" "));
}

/** @param {Exchange} exchange @returns {Followed[]} */
function evaluationsOf({ result }) {
  return result?.evaluations ?? [];
}

/** @param {Followed} evaluation */
export function evaluationTemplate({ links, state, done = 0, runs = 0, text, error }) {
  const under = state === "queued" || state === "running";
  return html`${under ? html`<p class="reply"><progress value=${done} max=${runs}></progress> ${t("exchange.evaluated", { done, runs })}</p>` : nothing}
    ${state === "failed" || state === "cancelled" ? html`<p class="reply">${t(`exchange.${state}`, { error: error ?? "" })}</p>` : nothing}
    ${(text ?? []).map((line) => html`<p class="reply">${line}</p>`)}
    ${state === "cancelled" ? nothing : html`<p class="report-link"><a href=${links.report} target="_blank" rel="noopener">${t("exchange.report")}</a></p>`}`;
}
