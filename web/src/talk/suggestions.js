// @ts-check
/**
 * While somebody types: how the sentence could go on, as a list to choose from, and in a line what it would do.
 *
 * A combobox (WAI-ARIA 1.2, list autocomplete): the focus stays in the box, arrows put a sentence there, Tab takes the
 * first one while what stands there is no whole sentence yet. What stands in the box is what is sent, always.
 */

import { make, setText } from "../ui/dom.js";
import { foresee, previewWords } from "./language.js";
import { Latest } from "../core/latest.js";

/** @import { Page } from "../main.js" */
/** @import { Foreseen } from "./language.js" */

const PAUSE_MS = 120;
const MOST_SHOWN = 6;

/**
 * @typedef {object} Suggest
 * @property {HTMLElement} list  over the box
 * @property {HTMLElement} line  under it
 * @property {(event: KeyboardEvent) => boolean} key  whether the list had a use for the key
 * @property {() => void} close
 */

/**
 * @param {HTMLInputElement} words  the box
 * @param {Page} page
 * @param {string} rest  what the line says when there is nothing to foresee
 * @returns {Suggest}
 */
export function createSuggest(words, page, rest) {
  const list = make("div", { class: "suggestions", id: "suggestions", role: "listbox", "aria-label": "Sentences", hidden: true });
  const line = make("p", { class: "preview", id: "preview" }, rest);
  for (const [name, value] of Object.entries({
    role: "combobox",
    "aria-autocomplete": "list",
    "aria-controls": "suggestions",
    "aria-expanded": "false",
    "aria-describedby": "preview",
  })) {
    words.setAttribute(name, value);
  }
  /** @type {HTMLElement[]} */ let options = [];
  let chosen = -1;
  let typed = "";
  let unfinished = false;

  const latest = new Latest({ pauseMs: PAUSE_MS, ask: wanted, tell });

  words.addEventListener("input", () => {
    typed = words.value;
    if (typed.trim() === "" || page.state().session === null) return close();
    // What no longer goes on from what stands there must not be taken by a quick key.
    const fitting = options.map((option) => option.dataset.text ?? "").filter((each) => begins(each, typed));
    if (fitting.length < options.length) show(fitting, typed);
    busy(true);
    latest.want(typed);
  });
  words.addEventListener("blur", close);

  /** @param {string} text */
  function wanted(text) {
    return foresee(text, page.state().session ?? "").finally(() => text === words.value && busy(false));
  }

  /** Whether what is listed is not yet what goes on from what stands in the box. @param {boolean} on */
  function busy(on) {
    list.setAttribute("aria-busy", String(on));
  }

  /** @param {Foreseen} foreseen @param {string} text */
  function tell({ completions, preview }, text) {
    if (words.value !== text || document.activeElement !== words) return;
    show(completions.filter((each) => each !== text).slice(0, MOST_SHOWN), text);
    // Most sentences are not understood before they are whole, and then there is more to choose from than to say.
    unfinished = preview?.standing === "not_understood" && options.length > 0;
    line.dataset.standing = unfinished ? "unfinished" : (preview?.standing ?? "");
    setText(line, unfinished ? "Tab completes it" : previewWords(preview) || rest);
  }

  /** @param {string[]} sentences @param {string} text */
  function show(sentences, text) {
    choose(-1);
    options = sentences.map((sentence, at) => {
      const same = begins(sentence, text) ? text.length : 0;
      const option = make(
        "div",
        { class: "suggestion", id: `suggestion-${at}`, role: "option", "aria-selected": "false", "data-text": sentence },
        make("span", { class: "suggestion-typed" }, sentence.slice(0, same)),
        sentence.slice(same),
      );
      // Before the box loses the focus.
      option.addEventListener("pointerdown", (event) => {
        event.preventDefault();
        take(sentence);
      });
      return option;
    });
    list.replaceChildren(...options);
    list.hidden = options.length === 0;
    words.setAttribute("aria-expanded", String(!list.hidden));
  }

  /** Mark one of the list, and let it stand in the box; none: what was typed. @param {number} at */
  function choose(at) {
    options[chosen]?.setAttribute("aria-selected", "false");
    chosen = at;
    const option = options[at];
    option?.setAttribute("aria-selected", "true");
    option?.scrollIntoView({ block: "nearest" });
    if (option) words.setAttribute("aria-activedescendant", option.id);
    else words.removeAttribute("aria-activedescendant");
  }

  /** Put a sentence into the box as if it had been typed. @param {string} sentence */
  function take(sentence) {
    words.value = sentence;
    words.setSelectionRange(sentence.length, sentence.length);
    words.dispatchEvent(new Event("input"));
  }

  function close() {
    latest.drop();
    busy(false);
    choose(-1);
    options = [];
    unfinished = false;
    list.hidden = true;
    list.replaceChildren();
    words.setAttribute("aria-expanded", "false");
    line.dataset.standing = "";
    setText(line, rest);
  }

  return {
    list,
    line,
    close,
    key(event) {
      if (list.hidden) return false;
      const count = options.length;
      if (event.key === "ArrowDown" || event.key === "ArrowUp") {
        // One place beyond either end stands for what was typed.
        const step = event.key === "ArrowDown" ? 1 : -1;
        choose(((chosen + 1 + step + count + 1) % (count + 1)) - 1);
        const sentence = options[chosen]?.dataset.text ?? typed;
        words.value = sentence;
        words.setSelectionRange(sentence.length, sentence.length);
        return true;
      }
      if (event.key === "Tab" && !event.shiftKey && (chosen >= 0 || unfinished)) {
        take(options[Math.max(0, chosen)].dataset.text ?? typed);
        return true;
      }
      if (event.key === "Escape") {
        words.value = typed;
        close();
        return true;
      }
      return false;
    },
  };
}

/** @param {string} sentence @param {string} typed */
function begins(sentence, typed) {
  return sentence.toLowerCase().startsWith(typed.toLowerCase());
}
