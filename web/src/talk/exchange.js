// @ts-check
/** One exchange: the words, the reply, what changed, or why nothing did. */

import { html, nothing } from "../../vendor/lit-html.js";
import { t } from "../core/texts.js";
import { changeWords, markWords } from "../core/words.js";
import { linked } from "../panels/log.js";
import { answerTemplate } from "./answer.js";
import { evaluationTemplate } from "./evaluations.js";
import { changesOf } from "./exchanges.js";

/** @import { Page } from "../core/page.js" */
/** @import { CommandResult, Problem, Change } from "../core/protocol.js" */
/** @import { Exchange } from "./exchanges.js" */

/**
 * @param {Exchange} exchange
 * @param {Page} page
 * @param {{undos: number, taken: boolean, open: boolean}} standing  how many undos would take it back, 0 where none would;
 *     whether it was; whether its question waits for an answer
 */
export function exchangeTemplate({ id, said, standing, result, problem, asks }, page, { undos, taken, open }) {
  return html`<article class="exchange" data-standing=${problem?.choices?.length ? "asked" : standing} data-id=${id}>
    <p class="said">${sentence(said, problem?.unparsed ?? [])}</p>
    ${standing === "pending" ? html`<p class="reply pending"><span class="dots" role="img" aria-label=${t("exchange.waiting")}></span></p>` : nothing}
    ${standing === "unknown" ? html`<p class="reply">${t(asks ? "exchange.lost_question" : "exchange.lost")}</p>` : nothing}
    ${result ? resultTemplate(result, page, undos, taken) : nothing} ${problem ? problemTemplate(problem, page, open) : nothing}
  </article>`;
}

/** @param {CommandResult} result @param {Page} page @param {number} undos @param {boolean} taken */
function resultTemplate(result, page, undos, taken) {
  const changes = changesOf(result);
  // Settings stand behind what is on the road; one that changes alone is what the sentence was about.
  const onRoad = changes.length === 1 ? changes : changes.filter(({ path }) => !isSetting(path));
  const settings = changes.filter((change) => !onRoad.includes(change));
  return html`${(result.corrections ?? []).map(correction)}
    ${readAs(result)} ${result.answer ? answerTemplate(result.answer, result.reply, page) : html`<p class="reply">${linked(result.reply.replaceAll(" → ", "\u00a0→\u00a0"))}</p>`}
    ${(result.evaluations ?? []).map(evaluationTemplate)}
    ${
      // A thing moved changes no figure, and can be taken back all the same.
      changes.length > 0 || undos > 0 || taken
        ? html`<ul class="changes" aria-label=${t("exchange.changes")}>
            ${onRoad.map(changeTemplate)} ${undos > 0 ? html`<li class="change-undo">${undoButton(undos, page)}</li>` : nothing}
            ${taken ? html`<li class="change-taken">${t("exchange.taken_back")}</li>` : nothing}
          </ul>`
        : nothing
    }
    ${
      settings.length > 0
        ? html`<details class="settings">
            <summary>${t("exchange.settings", { count: settings.length })}</summary>
            <ul class="changes">${settings.map(changeTemplate)}</ul>
          </details>`
        : nothing
    }`;
}

/** What a question in free words was read as: it stands before the answer. @param {CommandResult} result */
function readAs({ source, reply, answer }) {
  const end = answer?.text ? reply.indexOf(answer.text) : -1;
  return source === "matched" && end > 0 ? html`<p class="reply read-as">${reply.slice(0, end).trim()}</p>` : nothing;
}

/** A word that was read as another. @param {{from: string, to: string}} read */
function correction({ from, to }) {
  const words = t("exchange.correction", { from: "\n1\n", to: "\n2\n" }).split("\n");
  return html`<p class="correction">${words.map((each) => (each === "1" ? html`<s>${from}</s>` : each === "2" ? html`<b>${to}</b>` : each))}</p>`;
}

/**
 * The latest change is undone; an earlier one together with all that came after it, which is said.
 * @param {number} undos
 * @param {Page} page
 */
function undoButton(undos, page) {
  const label = undos === 1 ? t("clock.undo") : t("exchange.undo_all", { count: undos - 1 });
  const undo = () => page.act(Array.from({ length: undos }, () => ({ do: "undo" })), label, true);
  return html`<button class="button quiet small" type="button" @click=${undo}>${label}</button>`;
}

/** What future roads are made from, rather than what is on this one. @param {string} path */
function isSetting(path) {
  return path.startsWith("config.");
}

/** @param {Change} change */
function changeTemplate(change) {
  const { name, before, after } = changeWords(change);
  return html`<li class="change">${name} <span class="before">${before}</span> → <span class="after">${after}</span></li>`;
}

/** @param {Problem} problem @param {Page} page @param {boolean} open */
function problemTemplate(problem, page, open) {
  const errors = (problem.errors ?? []).filter(({ message }) => message && message !== problem.detail);
  const choices = problem.choices ?? [];
  const suggestions = problem.suggestions ?? [];
  return html`<p class="reply">${problem.detail || problem.title}</p>
    ${errors.length > 0 ? html`<ul class="errors">${errors.map(({ message }) => html`<li>${message}</li>`)}</ul>` : nothing}
    ${
      // Once a question is answered or dropped its choices say something else, or nothing.
      choices.length > 0 && (open || !problem.pending)
        ? offers(t("exchange.choices"), [
            ...choices.map(({ text, actions }) => offer(text, () => page.act(actions, text))),
            open ? dropButton(page) : nothing,
          ])
        : nothing
    }
    ${
      suggestions.length > 0
        ? html`<p class="offers-title">${t("exchange.could_say")}</p>
            ${offers(t("exchange.suggestions"), suggestions.map((text) => offer(text, () => page.say(text))))}`
        : nothing
    }`;
}

/** Drops the question that is open. @param {Page} page */
function dropButton(page) {
  const label = t("exchange.drop");
  const drop = () => page.act([{ do: "drop" }], label, true);
  return html`<button class="button quiet small" type="button" title=${label} aria-label=${label} @click=${drop}>✕</button>`;
}

/** @param {string} name @param {unknown[]} buttons */
function offers(name, buttons) {
  return html`<div class="offers" role="group" aria-label=${name}>${buttons}</div>`;
}

/** @param {string} text @param {() => void} press */
function offer(text, press) {
  return html`<button class="button offer" type="button" @click=${press}>${text}</button>`;
}

/**
 * The words said, those not understood marked.
 * @param {string} said
 * @param {string[]} unparsed
 */
function sentence(said, unparsed) {
  const title = t("exchange.not_understood");
  return markWords(said, unparsed).map(({ text, marked }) => (marked ? html`<mark title=${title}>${text}</mark>` : text));
}
