// @ts-check
/** One exchange as an element: the words, the reply, what changed, or why nothing did. */

import { make } from "../ui/dom.js";
import { changesOf } from "./exchanges.js";
import { changeWords, counted, markWords } from "../core/words.js";
import { answerElement } from "./answer.js";

/** @import { Page } from "../main.js" */
/** @import { CommandResult, Problem, Change } from "../core/protocol.js" */
/** @import { Exchange } from "./exchanges.js" */

/**
 * @param {Exchange} exchange
 * @param {Page} page
 * @param {number} undos  how many undos would take it back; 0 where none would
 * @param {boolean} taken  whether it was taken back
 * @returns {HTMLElement}
 */
export function exchangeElement(exchange, page, undos, taken) {
  const { said, standing, result, problem } = exchange;
  const asked = problem?.choices?.length ? "asked" : standing;
  const element = make("article", { class: "exchange", "data-standing": asked, "data-id": exchange.id });
  element.append(make("p", { class: "said" }, ...sentence(said, problem?.unparsed ?? [])));
  if (standing === "pending") element.append(make("p", { class: "reply pending" }, dots()));
  if (standing === "unknown") {
    const text = "The connection was lost before an answer came. The road shows whether it was done.";
    element.append(make("p", { class: "reply" }, text));
  }
  if (result) element.append(...resultParts(result, page, undos, taken));
  if (problem) element.append(...problemParts(problem, page));
  return element;
}

/** @param {CommandResult} result @param {Page} page @param {number} undos @param {boolean} taken */
function resultParts(result, page, undos, taken) {
  const parts = [];
  for (const { from, to } of result.corrections ?? []) {
    parts.push(make("p", { class: "correction" }, "Read “", make("s", {}, from), "” as “", make("b", {}, to), "”."));
  }
  if (result.answer) parts.push(answerElement(result.answer, result.reply, page));
  else parts.push(make("p", { class: "reply" }, result.reply.replaceAll(" → ", "\u00a0→\u00a0")));
  const changes = changesOf(result);
  // A thing moved changes no figure, and can be taken back all the same.
  if (changes.length > 0 || undos > 0 || taken) {
    const list = make("ul", { class: "changes", "aria-label": "What changed" });
    // Settings stand behind what is on the road; one that changes alone is what the sentence was about.
    const onRoad = changes.length === 1 ? changes : changes.filter(({ path }) => !isSetting(path));
    const settings = changes.filter((change) => !onRoad.includes(change));
    list.append(...onRoad.map(changeElement));
    if (undos > 0) list.append(make("li", { class: "change-undo" }, undoButton(undos, page)));
    if (taken) list.append(make("li", { class: "change-taken" }, "taken back"));
    parts.push(list);
    if (settings.length > 0) {
      const title = `${counted(settings.length, "setting")} changed`;
      parts.push(
        make(
          "details",
          { class: "settings" },
          make("summary", {}, title),
          make("ul", { class: "changes" }, ...settings.map(changeElement)),
        ),
      );
    }
  }
  return parts;
}

/**
 * The latest change is undone; an earlier one together with all that came after it, which is said.
 * @param {number} undos
 * @param {Page} page
 */
function undoButton(undos, page) {
  const label = undos === 1 ? "Undo" : `Undo this and the ${undos === 2 ? "one" : undos - 1} after`;
  const undo = () => page.act(Array(undos).fill({ do: "undo" }), label, true);
  return make("button", { class: "button quiet small", type: "button", onclick: undo }, label);
}

/** What future roads are made from, rather than what is on this one. @param {string} path */
function isSetting(path) {
  return path.startsWith("config.");
}

/** @param {Change} change */
function changeElement(change) {
  const { name, before, after } = changeWords(change);
  return make(
    "li",
    { class: "change" },
    `${name} `,
    make("span", { class: "before" }, before),
    " → ",
    make("span", { class: "after" }, after),
  );
}

/** @param {Problem} problem @param {Page} page */
function problemParts(problem, page) {
  /** @type {HTMLElement[]} */
  const parts = [make("p", { class: "reply" }, problem.detail || problem.title)];
  const errors = (problem.errors ?? []).filter(({ message }) => message && message !== problem.detail);
  if (errors.length > 0) {
    parts.push(make("ul", { class: "errors" }, ...errors.map(({ message }) => make("li", {}, message))));
  }
  const choices = problem.choices ?? [];
  const suggestions = problem.suggestions ?? [];
  if (choices.length > 0) {
    parts.push(
      offers(
        "Choices",
        choices.map(({ text, actions }) => offer(text, () => page.act(actions, text))),
      ),
    );
  }
  if (suggestions.length > 0) {
    parts.push(
      make("p", { class: "offers-title" }, "You could say"),
      offers(
        "Suggestions",
        suggestions.map((text) => offer(text, () => page.say(text))),
      ),
    );
  }
  return parts;
}

/** @param {string} name @param {HTMLElement[]} buttons */
function offers(name, buttons) {
  return make("div", { class: "offers", role: "group", "aria-label": name }, ...buttons);
}

/** @param {string} text @param {() => void} onclick */
function offer(text, onclick) {
  return make("button", { class: "button offer", type: "button", onclick }, text);
}

/**
 * The words said, those not understood marked.
 * @param {string} said
 * @param {string[]} unparsed
 */
function sentence(said, unparsed) {
  return markWords(said, unparsed).map(({ text, marked }) =>
    marked ? make("mark", { title: "not understood" }, text) : text,
  );
}

function dots() {
  return make("span", { class: "dots", role: "img", "aria-label": "waiting for the answer" });
}
