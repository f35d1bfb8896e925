// @ts-check
/**
 * While somebody types: how the sentence could go on, as a list to choose from, and in a line what it would do.
 *
 * A combobox (WAI-ARIA 1.2, list autocomplete): the focus stays in the box, arrows put a sentence there, Tab takes the
 * first one while what stands there is no whole sentence yet. What stands in the box is what is sent, always.
 */

import { html } from "../../vendor/lit-html.js";
import { Latest } from "../core/latest.js";
import { t } from "../core/texts.js";
import { foresee, previewWords } from "./language.js";

/** Between the parts of what stands under the box; those that have no room are left out. */
const BETWEEN = " · ";

/** @import { Page } from "../core/page.js" */
/** @import { Foreseen } from "./language.js" */

const PAUSE_MS = 120;
const MOST_SHOWN = 6;

/**
 * @typedef {object} Shown
 * @property {string[]} sentences  that go on from what was typed
 * @property {number} chosen  which of them stands in the box; -1: what was typed
 * @property {boolean} busy  whether this is not yet what goes on from what stands in the box
 * @property {boolean} unfinished  whether what was typed is no whole sentence, and could become one
 * @property {string} standing  of what was typed, as it stands
 * @property {string} line  what it would do; empty where there is nothing to tell
 */

/** @type {Shown} */
const CLOSED = { sentences: [], chosen: -1, busy: false, unfinished: false, standing: "", line: "" };

/**
 * @typedef {object} Box
 * @property {() => string} text  what stands there
 * @property {() => boolean} focused
 * @property {(text: string) => void} put  let a sentence stand there
 * @property {() => void} changed  something else is to be shown
 */

export class Suggestions {
  /** @type {Shown} */ shown = CLOSED;
  #typed = "";

  /** @param {Page} page @param {Box} box */
  constructor(page, box) {
    this.page = page;
    this.box = box;
    this.latest = new Latest({
      pauseMs: PAUSE_MS,
      ask: (/** @type {string} */ text) => this.#ask(text),
      tell: (/** @type {Foreseen} */ foreseen, text) => this.#tell(foreseen, text),
    });
  }

  /** Something was typed into the box. */
  typed() {
    this.#typed = this.box.text();
    if (this.#typed.trim() === "" || this.page.state().session === null) return this.close();
    // What no longer goes on from what stands there must not be taken by a quick key.
    const fitting = this.shown.sentences.filter((each) => begins(each, this.#typed));
    this.#show({ busy: true, ...(fitting.length < this.shown.sentences.length ? { sentences: fitting, chosen: -1 } : {}) });
    this.latest.want(this.#typed);
  }

  close() {
    this.latest.drop();
    if (this.shown !== CLOSED) this.#show(CLOSED);
  }

  /** Put a sentence into the box as if it had been typed. @param {string} sentence */
  take(sentence) {
    this.box.put(sentence);
    this.typed();
  }

  /** @param {KeyboardEvent} event @returns {boolean} whether the list had a use for the key */
  key(event) {
    const { sentences, chosen, unfinished } = this.shown;
    if (sentences.length === 0) return false;
    if (event.key === "ArrowDown" || event.key === "ArrowUp") this.#walk(event.key === "ArrowDown" ? 1 : -1);
    else if (event.key === "Tab" && !event.shiftKey && (chosen >= 0 || unfinished)) this.take(sentences[Math.max(0, chosen)]);
    else if (event.key === "Escape") {
      this.box.put(this.#typed);
      this.close();
    } else return false;
    return true;
  }

  /** One place beyond either end stands for what was typed. @param {1 | -1} step */
  #walk(step) {
    const { sentences, chosen } = this.shown;
    const count = sentences.length + 1;
    const next = ((chosen + 1 + step + count) % count) - 1;
    this.#show({ chosen: next });
    this.box.put(sentences[next] ?? this.#typed);
  }

  /** @param {string} text */
  #ask(text) {
    return foresee(text, this.page.state().session ?? "").finally(() => text === this.box.text() && this.#show({ busy: false }));
  }

  /** @param {Foreseen} foreseen @param {string} text */
  #tell({ completions, preview }, text) {
    if (this.box.text() !== text || !this.box.focused()) return;
    const sentences = completions.filter((each) => each !== text).slice(0, MOST_SHOWN);
    // Most sentences are not understood before they are whole, and then there is more to choose from than to say.
    const unfinished = preview?.standing === "not_understood" && sentences.length > 0;
    this.#show({
      sentences,
      chosen: -1,
      unfinished,
      standing: unfinished ? "unfinished" : (preview?.standing ?? ""),
      line: unfinished ? t("suggestions.complete") : previewWords(preview),
    });
  }

  /** @param {Partial<Shown>} change */
  #show(change) {
    this.shown = { ...this.shown, ...change };
    if (change === CLOSED) this.shown = CLOSED;
    this.box.changed();
  }

  /** The list over the box. */
  list() {
    const { sentences, chosen, busy } = this.shown;
    return html`<div class="suggestions" id="suggestions" role="listbox" aria-label=${t("suggestions.label")} aria-busy=${String(busy)} ?hidden=${sentences.length === 0}>
      ${sentences.map((sentence, at) => this.#option(sentence, at, at === chosen))}
    </div>`;
  }

  /** @param {string} sentence @param {number} at @param {boolean} chosen */
  #option(sentence, at, chosen) {
    const same = begins(sentence, this.#typed) ? this.#typed.length : 0;
    // Before the box loses the focus.
    const take = (/** @type {Event} */ event) => {
      event.preventDefault();
      this.take(sentence);
    };
    return html`<div class="suggestion" id="suggestion-${at}" role="option" aria-selected=${String(chosen)} data-text=${sentence} @pointerdown=${take}
      ><span class="suggestion-typed">${sentence.slice(0, same)}</span>${sentence.slice(same)}</div>`;
  }

  /** The line under the box. @param {string} rest  what it says when there is nothing to foresee */
  line(rest) {
    return html`<p class="preview" id="preview" data-standing=${this.shown.standing}>${this.shown.line || rest.split(BETWEEN).map((part, at) => html`<span class="preview-part">${at > 0 ? BETWEEN : ""}${part}</span>`)}</p>`;
  }
}

/** @param {string} sentence @param {string} typed */
function begins(sentence, typed) {
  return sentence.toLowerCase().startsWith(typed.toLowerCase());
}
