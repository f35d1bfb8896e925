// @ts-check
/** The quiz: what will it do next, and why? Before and after explanations, then two scales, then the scores. */

import { html, nothing, repeat } from "../../vendor/lit-html.js";
import { LANGUAGE, listText, t } from "../core/texts.js";
import { save } from "../timeline/downloads.js";
import { dialogSlot, makeDialog } from "../ui/dialog.js";
import { resultText, scoreOf } from "./quizResult.js";
import { quizRoad, thingsIn } from "./quizRoad.js";

/** @import { Choice, Given, Quiz, Rated, Situation } from "./quizResult.js" */

/** @typedef {{quiz: Quiz, at: number, given: Given[], rated: Rated | null}} Shown */

/** @returns {(quiz: Quiz) => void} opens it */
export function createQuizDialog() {
  const dialog = makeDialog(t("quiz.title"));
  const body = dialogSlot(dialog);
  dialog.id = "quiz";

  /** @param {Shown} shown */
  function show(shown) {
    body(content(shown, show));
    /** @type {HTMLElement | null} */ (dialog.querySelector("input, .dialog-body .button"))?.focus();
  }

  return (quiz) => {
    show({ quiz, at: 0, given: [], rated: null });
    if (!dialog.open) dialog.showModal();
  };
}

/** @param {Shown} shown @param {(shown: Shown) => void} show */
function content(shown, show) {
  const situation = shown.quiz.situations[shown.at];
  if (situation) return repeat([shown], ({ at }) => at, () => situationForm(shown, situation, show)); // a form of its own: nothing chosen yet
  return shown.rated === null ? scalesForm(shown, show) : scores(shown);
}

/** @param {Shown} shown @param {Situation} situation @param {(shown: Shown) => void} show */
function situationForm(shown, situation, show) {
  const { quiz, at } = shown;
  const own = quiz.situations.filter(({ phase }) => phase === situation.phase);
  /** @param {SubmitEvent} event */
  const submit = (event) => {
    event.preventDefault();
    const said = new FormData(/** @type {HTMLFormElement} */ (event.target));
    const given = situation.phase === "explained" ? [] : [{ situation, move: `${said.get("move")}`, reason: `${said.get("reason")}` }];
    show({ ...shown, at: at + 1, given: [...shown.given, ...given] });
  };
  return html`<form class="form" @submit=${submit}>
    <p class="dialog-note">${quiz.phases[situation.phase]} ${t("quiz.road", { number: own.indexOf(situation) + 1, count: own.length })}</p>
    <div class="quiz-situation">
      <div class="quiz-seen">
        ${quizRoad(situation.picture, `${t("quiz.picture")}: ${wordsOf(situation.picture)}`)}
        <p class="dialog-note">${t("quiz.blue")}</p>
      </div>
      <div class="quiz-asked">${
      situation.phase === "explained"
        ? html`<p><b>${t("quiz.did", { move: quiz.moves.find(({ id }) => id === situation.right.move)?.text ?? "" })}</b></p>
            <p>${situation.explanation}</p>`
        : html`<p class="dialog-note">${t("quiz.later")}</p>${choices("move", t("quiz.what"), quiz.moves)} ${choices("reason", t("quiz.why"), situation.reasons)}`
    }</div>
    </div>
    <button class="button strong" type="submit">${t("quiz.next")}</button>
  </form>`;
}

/** The picture for those who do not see it: what is where, as seen from the vehicle. @param {string[]} rows */
function wordsOf(rows) {
  const things = thingsIn(rows);
  const own = things.find(({ kind }) => kind === "av");
  const placed = things.filter(({ kind }) => kind !== "av").map((thing) => {
    const across = thing.cell[0] - (own?.cell[0] ?? 0);
    const side = across === 0 ? t("moves.forward") : t("quiz.aside", { count: Math.abs(across), side: t(across < 0 ? "moves.left" : "moves.right") });
    return t("quiz.thing", { thing: t(`kinds.${thing.kind}`), ahead: (own?.cell[1] ?? 0) - thing.cell[1], side });
  });
  return listText(placed);
}

/** @param {string} name @param {string} label @param {Choice[]} each */
function choices(name, label, each) {
  return html`<fieldset class="quiz-choices">
    <legend>${label}</legend>
    ${each.map(({ id, text }) => html`<label><input type="radio" name=${name} value=${id} required> ${text}</label>`)}
  </fieldset>`;
}

/** @param {Shown} shown @param {(shown: Shown) => void} show */
function scalesForm(shown, show) {
  const { scales, scale } = shown.quiz;
  const rates = Array.from({ length: scale.most - scale.least + 1 }, (_, at) => scale.least + at);
  /** @param {SubmitEvent} event */
  const submit = (event) => {
    event.preventDefault();
    const said = new FormData(/** @type {HTMLFormElement} */ (event.target));
    /** @type {Rated} */ const rated = {};
    for (const [key, value] of said) {
      const [name, item] = key.split(".");
      rated[name] = { ...rated[name], [item]: Number(value) };
    }
    show({ ...shown, rated });
  };
  return html`<form class="form" @submit=${submit}>
    <p class="dialog-note">${t("quiz.scales", scale)}</p>
    ${Object.entries(scales).flatMap(([name, items]) =>
      items.map(
        ({ id, text }) => html`<fieldset class="quiz-rates">
          <legend>${text}</legend>
          ${rates.map((rate) => html`<label><input type="radio" name=${`${name}.${id}`} value=${rate}> ${rate}</label>`)}
        </fieldset>`,
      ),
    )}
    <button class="button strong" type="submit">${t("quiz.next")}</button>
  </form>`;
}

/** What was said of a road, and what was right. @param {Given} given @param {Quiz} quiz */
function answered({ situation: { right, reasons }, move, reason }, { moves }) {
  const said = (/** @type {Choice[]} */ all, /** @type {string} */ wanted) => all.find(({ id }) => id === wanted)?.text ?? "";
  const both = (/** @type {string} */ of, /** @type {string} */ why) => t("quiz.both", { move: said(moves, of), reason: said(reasons, why) });
  const good = move === right.move && reason === right.reason;
  return html`<li data-right=${good}>
    ${t(good ? "quiz.right" : "quiz.wrong", { said: both(move, reason) })} ${good ? nothing : t("quiz.was", { right: both(right.move, right.reason) })}
  </li>`;
}

/** @param {Shown} shown */
function scores({ quiz, given, rated }) {
  const [before, after] = [scoreOf(given, "before"), scoreOf(given, "after")];
  const right = (/** @type {number} */ share, /** @type {number} */ count) => `${Math.round(share * count)}`;
  const keep = () => save(new Blob([resultText(quiz, given, rated ?? {}, LANGUAGE)], { type: "application/json" }), `roadtalk-quiz-${quiz.planner}-${quiz.seed}.json`);
  return html`<p>${t("quiz.moves_right", { before: right(before.moves, before.count), after: right(after.moves, after.count), count: before.count })}</p>
    <p>${t("quiz.reasons_right", { before: right(before.reasons, before.count), after: right(after.reasons, after.count), count: before.count })}</p>
    ${given.length > 0 ? html`<ol class="quiz-given">${given.map((each) => answered(each, quiz))}</ol>` : nothing}
    ${given.length > 0 ? html`<button class="button strong" type="button" @click=${keep}>${t("quiz.save")}</button>` : nothing}`;
}
