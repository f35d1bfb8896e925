// @ts-check
/** An answer with its evidence: causes to point at, the proof, and what else could have been done. */

import { html, nothing } from "../../vendor/lit-html.js";
import { nameText, t } from "../core/texts.js";
import { MOVES, moveName, plain, reasonWords } from "../core/words.js";
import { icon } from "../ui/icons.js";
import { labelOf } from "../why/alternatives.js";
import { shownBy } from "./shown.js";

/** @import { Page } from "../core/page.js" */
/** @import { Action, Answer, Option } from "../core/protocol.js" */
/** @import { Highlight } from "../core/state.js" */

/** @param {Answer} answer @param {string} reply @param {Page} page */
export function answerTemplate(answer, reply, page) {
  const causes = answer.causes ?? [];
  const others = (answer.alternatives ?? []).filter(({ move }) => move !== answer.move);
  const play = answer.play ?? answer.counterfactual;
  const whole = shownBy(answer);
  const show = () => page.highlight(whole);
  const hide = () => page.highlight(null);
  return html`<div class="answer" @pointerenter=${show} @pointerleave=${hide}>
    <p class="reply">${answer.text || reply}</p>
    ${answer.tick !== null && others.length > 0 ? tickTemplate(answer.tick, page) : nothing}
    ${
      causes.length > 0
        ? html`<ul class="causes" aria-label=${t("answer.causes")}>${causes.map((cause) => causeTemplate(cause, causes, whole, page))}</ul>
            ${proofTemplate(answer)}`
        : nothing
    }
    ${others.length > 0 ? alternativesTemplate(others, answer.tick, page) : nothing}
    ${play?.at_tick === undefined ? nothing : playButton(play, page)}
  </div>`;
}

/** The tick that is spoken of, and the way there. @param {number} tick @param {Page} page */
function tickTemplate(tick, page) {
  const go = () => void page.timeTravel.at(tick);
  return html`<button class="answer-tick" type="button" title=${t("answer.go", { tick })} @click=${go}>${t("answer.at", { tick })}</button>`;
}

/** @typedef {Answer["causes"][number]} Cause */

/** @param {Cause} cause @param {Cause[]} all @param {Highlight | null} whole  what all of the answer points at @param {Page} page */
function causeTemplate(cause, all, whole, page) {
  const show = () => page.highlight({ ids: [cause.id], cells: cause.cell ? [cause.cell] : [] });
  const hide = () => page.highlight(whole);
  return html`<li>
    <button class="cause" type="button" title="${t("answer.show")} (${cause.id})" data-kind=${cause.kind}
      @pointerenter=${show} @pointerleave=${hide} @focus=${show} @blur=${hide} @click=${show}>
      <span class="cause-name">${nameOfCause(cause, all)}</span><span class="cause-role">${roleText(cause)}</span>
    </button>
  </li>`;
}

/** By its kind; among others of that kind by its lane, or its id. @param {Cause} cause @param {Cause[]} all */
function nameOfCause({ id, kind, cell }, all) {
  const alike = all.filter((each) => each.kind === kind);
  const name = nameText("nouns", kind);
  if (alike.length === 1) return name;
  const sameLane = alike.filter((each) => each.cell?.[0] === cell?.[0]).length > 1;
  return cell && !sameLane ? t("place.called", { name, place: t("place.lane", { lane: cell[0] + 1 }) }) : id;
}

/** @param {Cause} cause */
function roleText({ role, moves }) {
  return [plain(role), (moves ?? []).map(moveName).join(", ")].join(" ").trim();
}

const PROOFS = /** @type {const} */ (["necessary", "sufficient", "minimal"]);

/**
 * What was shown by running the moment again; nothing is said that was not.
 * @param {Answer} answer
 */
function proofTemplate({ verified }) {
  const shown = PROOFS.filter((property) => verified?.[property]);
  if (shown.length === 0) return nothing;
  return html`<p class="proof">
    ${icon("proof")}<span>${t("answer.proved")}</span>
    ${shown.map((property) => html`<span class="proof-tag" title=${t(`answer.${property}_for`)}>${t(`answer.${property}`)}</span>`)}
  </p>`;
}

/** Play a move, or a change, beside the real run. @param {NonNullable<Answer["play"] | Answer["counterfactual"]>} play @param {Page} page */
function playButton(play, page) {
  const tick = Number(play.at_tick);
  const move = "move" in play ? play.move : undefined;
  if (move === undefined) return watchButton(tick, play.actions ?? play.change ?? [], page);
  const watch = () => page.pick({ kind: "move", tick, move });
  return html`<button class="button small watch" type="button" @click=${watch}>${icon("play")}${t("answer.watch")}</button>`;
}

/** Play a change beside the real run. @param {number} tick @param {Action[]} actions @param {Page} page */
function watchButton(tick, actions, page) {
  const watch = () => page.pick({ kind: "change", tick, actions, label: labelOf(actions) });
  return html`<button class="button small watch" type="button" @click=${watch}>${icon("play")}${t("answer.watch")}</button>`;
}

/** @param {Option[]} alternatives @param {number | null} tick @param {Page} page */
function alternativesTemplate(alternatives, tick, page) {
  const seen = (/** @type {Event} */ { currentTarget }) => {
    const { open, lastElementChild } = /** @type {HTMLDetailsElement} */ (currentTarget);
    if (open) lastElementChild?.scrollIntoView({ block: "nearest" });
  };
  return html`<details class="alternatives" @toggle=${seen}>
    <summary>${t("answer.others", { count: alternatives.length })}</summary>
    <ul>${alternatives.map((option) => alternativeTemplate(option, tick, page))}</ul>
  </details>`;
}

/** @param {Option} option @param {number | null} tick @param {Page} page */
function alternativeTemplate({ move, cell, verdict, reason }, tick, page) {
  const watch = () => page.pick({ kind: "move", tick: Number(tick), move });
  return html`<li data-verdict=${verdict}>
    <span class="option-arrow" aria-hidden="true">${MOVES[move]?.arrow ?? ""}</span>
    <span class="option-move">${moveName(move)}</span>
    <span class="option-reason">${reasonWords(reason)}</span>
    ${
      cell && tick !== null
        ? html`<button class="option-watch" type="button" aria-label=${t("answer.watch_move", { move: moveName(move) })} title=${t("answer.watch")} @click=${watch}>${icon("play")}</button>`
        : nothing
    }
  </li>`;
}
