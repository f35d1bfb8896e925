// @ts-check
/** The box to talk in: Enter sends, Tab completes, ↑ and ↓ bring back what was said, Escape clears. */

import { html, live, nothing, render } from "../../vendor/lit-html.js";
import { browserStorage } from "../core/preferences.js";
import { t } from "../core/texts.js";
import { icon } from "../ui/icons.js";
import { find } from "../ui/slot.js";
import { History } from "./history.js";
import { createMicrophone } from "./speech.js";
import { Suggestions } from "./suggestions.js";

/** @import { Page } from "../core/page.js" */
/** @import { Panel } from "../panels/index.js" */

/** Well beyond what the service takes, so that it is the one to say that a text is too long. */
const LONGEST_TEXT = 2_000;

/**
 * @param {HTMLElement} host  a form
 * @param {Page} page
 * @returns {Panel}
 */
export function createCommand(host, page) {
  const history = new History(browserStorage());
  const microphone = createMicrophone(page.put, show);
  let text = "";
  const suggestions = new Suggestions(page, { text: () => text, focused: () => document.activeElement === words, put, changed: show });

  function show() {
    render(template(text, suggestions, { input, key, blur: () => suggestions.close() }, microphone), host);
  }
  show();
  const words = /** @type {HTMLInputElement} */ (find(host, "#words"));

  /** Let a sentence stand in the box. @param {string} sentence */
  function put(sentence) {
    text = sentence;
    show();
    words.setSelectionRange(text.length, text.length);
    host.querySelector('.suggestion[aria-selected="true"]')?.scrollIntoView({ block: "nearest" });
  }

  function input() {
    text = words.value;
    suggestions.typed();
    show();
  }

  /** @param {KeyboardEvent} event */
  function key(event) {
    if (event.isComposing) return;
    if (suggestions.key(event)) event.preventDefault();
    else if (event.key === "ArrowUp") bring(history.back(text));
    else if (event.key === "ArrowDown") bring(history.forth());
    else if (event.key === "Escape") {
      if (text === "") words.blur();
      put("");
    } else if (event.key !== "/" || text !== "") return;
    // A slash in an empty box is the key that leads here, pressed once more.
    event.preventDefault();
  }

  /** @param {string | null} sentence */
  function bring(sentence) {
    if (sentence === null) return;
    suggestions.close();
    put(sentence);
  }

  host.addEventListener("submit", (event) => {
    event.preventDefault();
    const said = text.trim();
    if (said === "") return;
    history.add(said);
    suggestions.close();
    put("");
    page.say(said);
  });

  // A sentence that is offered stands in the box at once: who pressed for it may go on typing.
  page.subscribe(({ draft }, before) => {
    if (draft === null || draft === before.draft) return;
    words.focus();
    suggestions.take(draft.text);
  });

  return {
    update({ talk }) {
      host.classList.toggle("waiting", talk.some(({ standing, quiet }) => standing === "pending" && !quiet));
    },
  };
}

const touch = () => matchMedia("(hover: none)").matches;

/**
 * @param {string} text
 * @param {Suggestions} suggestions
 * @param {{input: () => void, key: (event: KeyboardEvent) => void, blur: () => void}} on
 * @param {(() => unknown) | null} microphone
 */
function template(text, suggestions, { input, key, blur }, microphone) {
  const { chosen, sentences } = suggestions.shown;
  return html`${suggestions.list()}
    <div class="words-box">
      <input id="words" class="words" type="text" placeholder=${t("talk.placeholder")} autocomplete="off" autocapitalize="off" spellcheck="false" enterkeyhint="send"
        maxlength=${LONGEST_TEXT} aria-label=${t("talk.box")} aria-keyshortcuts="/" role="combobox" aria-autocomplete="list" aria-controls="suggestions"
        aria-expanded=${String(sentences.length > 0)} aria-describedby="preview" aria-activedescendant=${chosen < 0 ? nothing : `suggestion-${chosen}`}
        .value=${live(text)} @input=${input} @keydown=${key} @blur=${blur}>
      <kbd class="hint" aria-hidden="true">/</kbd>
    </div>
    ${microphone?.() ?? nothing}
    <button class="button strong icon send" type="submit" aria-label=${t("talk.send")}>${icon("send")}</button>
    ${suggestions.line(t(touch() ? "talk.hint_touch" : "talk.hint"))}`;
}
