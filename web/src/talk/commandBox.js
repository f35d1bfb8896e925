// @ts-check
/** The box to talk in: Enter sends, Tab completes, ↑ and ↓ bring back what was said, Escape clears. */

import { make } from "../ui/dom.js";
import { History } from "./history.js";
import { icon } from "../ui/icons.js";
import { browserStorage } from "../core/storage.js";
import { createMicrophone } from "./speech.js";
import { createSuggest } from "./suggestions.js";

/** @import { Page } from "../main.js" */
/** @import { Panel } from "../panels/index.js" */

/** Well beyond what the service takes, so that it is the one to say that a text is too long. */
const LONGEST_TEXT = 2_000;
const RESTING = matchMedia("(hover: none)").matches
  ? "In plain words · ? tells what can be said"
  : "Enter sends · ↑ brings back · Ctrl K for everything";

/**
 * @param {HTMLElement} host  a form
 * @param {Page} page
 * @returns {Panel}
 */
export function createCommand(host, page) {
  const history = new History(browserStorage());
  const words = make("input", {
    id: "words",
    class: "words",
    type: "text",
    placeholder: "Say it, or ask why",
    autocomplete: "off",
    autocapitalize: "off",
    spellcheck: false,
    enterKeyHint: "send",
    maxLength: LONGEST_TEXT,
    "aria-label": "Say what should happen, or ask why",
    "aria-keyshortcuts": "/",
  });
  const hint = make("kbd", { class: "hint", "aria-hidden": "true" }, "/");
  const send = make("button", { class: "button strong icon send", type: "submit", "aria-label": "Send" }, icon("send"));
  const suggest = createSuggest(words, page, RESTING);
  const microphone = createMicrophone(page.put);
  host.append(suggest.list, make("div", { class: "words-box" }, words, hint), microphone ?? "", send, suggest.line);

  host.addEventListener("submit", (event) => {
    event.preventDefault();
    const text = words.value.trim();
    if (text === "") return;
    history.add(text);
    words.value = "";
    suggest.close();
    page.say(text);
  });

  words.addEventListener("keydown", (event) => {
    if (event.isComposing) return;
    if (suggest.key(event)) event.preventDefault();
    else if (event.key === "ArrowUp") bring(history.back(words.value));
    else if (event.key === "ArrowDown") bring(history.forth());
    else if (event.key === "Escape") {
      if (words.value === "") words.blur();
      words.value = "";
    } else if (event.key !== "/" || words.value !== "") return;
    // A slash in an empty box is the key that leads here, pressed once more.
    event.preventDefault();
  });

  /** @param {string | null} text */
  function bring(text) {
    if (text === null) return;
    words.value = text;
    words.setSelectionRange(text.length, text.length);
    suggest.close();
  }

  return {
    update({ talk }) {
      host.classList.toggle(
        "waiting",
        talk.some(({ standing, quiet }) => standing === "pending" && !quiet),
      );
    },
  };
}
