// @ts-check
/** Help: what can be said, by kind, which keys there are, and what the reader may choose. `?` opens it. */

import { html, nothing, render } from "../../vendor/lit-html.js";
import { errorText } from "../core/http.js";
import { newestOnly } from "../core/latest.js";
import { chooseLanguage, LANGUAGE, languages, t } from "../core/texts.js";
import { chooseTheme, theme } from "../core/theme.js";
import { plain } from "../core/words.js";
import { guide } from "./language.js";
import { canSpeak, speak, speaks } from "./speech.js";

/** @import { Page } from "../core/page.js" */
/** @import { LanguageGuide, TaughtPhrase } from "../core/wire.js" */

const MOST_EXAMPLES = 3;
/** Kinds of sentences under people's headings, in the order of a first hour; others follow. */
const HEADINGS = /** @type {[string, string[]][]} */ ([
  ["roads", ["scenario", "goal", "reset"]],
  ["put", ["add", "set_count", "move", "swap", "replace", "copy"]],
  ["take", ["remove"]],
  ["why", ["ask why", "ask why_not", "ask what_if", "ask blame"]],
  ["others", ["ask other"]],
  ["what", ["ask status", "ask scene", "ask next", "ask sight", "ask metrics", "ask confidence"]],
  ["back_and_ahead", ["ask history", "ask pattern", "ask changes", "ask outlook"]],
  ["clock", ["pause", "resume", "step"]],
  ["time", ["undo", "redo", "rewind", "save", "load"]],
  ["drive", ["mode", "drive"]],
  ["planners", ["ask planners", "style", "ask styles"]],
  ["settings", ["set", "adjust", "prefer", "ask setting", "ask world", "ask term", "ask fact"]],
  ["views", ["show", "hide"]],
  ["advice", ["advise", "ask maintenance"]],
  ["rules", ["trigger", "cancel", "ask rules"]],
  ["evaluate", ["evaluate", "evaluation", "find_worst"]],
  ["teach", ["teach", "forget"]],
  ["talk", ["ask help", "ask options", "ask quiz", "ask detail", "ask pending", "drop", "chat"]],
]);
/** Keys that are not commands of their own. */
const MORE_KEYS = [
  ["/", "help.key_box"],
  ["↑ ↓", "help.key_said"],
  ["Tab", "help.key_complete"],
  ["Escape", "help.key_close"],
];

/** @typedef {{guidance: LanguageGuide | null, trouble: string | null}} Known  what the service has told */

/** @param {HTMLDialogElement} dialog @param {Page} page */
export function createHelp(dialog, page) {
  const asking = newestOnly();
  const put = (/** @type {string} */ text) => {
    dialog.close();
    page.put(text);
  };

  /** @param {Known} known */
  function show(known) {
    const sentences = known.guidance ? sayings(known.guidance, put) : waiting(known.trouble);
    render(template([sentences, keys(page), choices()], () => dialog.close()), dialog);
  }

  async function open() {
    if (document.querySelector("dialog[open]")) return;
    show({ guidance: null, trouble: null });
    dialog.showModal();
    dialog.querySelector("button")?.focus();
    const newest = asking();
    try {
      const guidance = await guide();
      if (newest()) show({ guidance, trouble: null });
    } catch (error) {
      if (newest()) show({ guidance: null, trouble: errorText(error) });
    }
  }

  dialog.addEventListener("click", (event) => {
    if (event.target === dialog) dialog.close();
  });
  return { open };
}

/** @param {unknown[]} parts @param {() => void} close */
function template(parts, close) {
  return html`<header>
      <h2 id="help-title">${t("help.title")}</h2>
      <button class="button quiet" type="button" @click=${close}>${t("page.close")}</button>
    </header>
    <div class="help-body">${parts}</div>`;
}

/** @param {string | null} trouble */
function waiting(trouble) {
  if (trouble === null) return html`<p class="help-wait">${t("help.wait")}</p>`;
  return html`<p class="help-wait" role="alert">${t("help.unknown", { reason: trouble })}</p>`;
}

/** @param {LanguageGuide} guidance @param {(text: string) => void} put */
function sayings({ intents, taught }, put) {
  const not = intents.filter(({ available }) => !available).map(({ intent }) => plain(intent));
  return html`<section class="help-sayings" aria-label=${t("help.sentences")}>
    ${byHeading(intents).map(([heading, examples]) => group(heading, examples, put))} ${taught.length > 0 ? phrases(taught) : nothing}
    ${not.length > 0 ? html`<p class="help-not">${t("help.not_yet", { kinds: not.join(", ") })}</p>` : nothing}
  </section>`;
}

/** Examples of what can be said under their headings. @param {LanguageGuide["intents"]} intents @returns {[heading: string, examples: {text: string}[]][]} */
function byHeading(intents) {
  const left = new Map(intents.filter(({ available }) => available).map((intent) => [intent.intent, intent.examples]));
  /** @type {[string, {text: string}[]][]} */
  const groups = [];
  for (const [heading, kinds] of HEADINGS) {
    const found = kinds.flatMap((kind) => left.get(kind)?.slice(0, examplesOf(kinds)) ?? []);
    for (const kind of kinds) left.delete(kind);
    if (found.length > 0) groups.push([t(`help.headings.${heading}`), found]);
  }
  const others = [...left.values()].flatMap((examples) => examples.slice(0, 1));
  if (others.length > 0) groups.push([t("help.headings.more"), others]);
  return groups;
}

/** How many of each of several kinds under a heading. @param {string[]} kinds */
const examplesOf = ({ length }) => (length > 4 ? 1 : length > 1 ? 2 : MOST_EXAMPLES);

/** @param {string} heading @param {{text: string}[]} examples @param {(text: string) => void} put */
function group(heading, examples, put) {
  return html`<div class="help-intent">
    <h3>${heading}</h3>
    ${examples.map(({ text }) => html`<button class="help-example" type="button" title=${t("help.put")} @click=${() => put(text)}>${text}</button>`)}
  </div>`;
}

/** @param {TaughtPhrase[]} taught */
function phrases(taught) {
  return html`<div class="help-intent">
    <h3>${t("help.taught")}</h3>
    ${taught.map((each) => html`<p>${t("help.means", { ...each })}</p>`)}
  </div>`;
}

/** @param {Page} page */
function keys(page) {
  const commands = page.commands().flatMap((act) => {
    const doing = act.keyName ? act.now(page.state()) : null;
    return doing && act.keyName ? [[act.keyName, doing.label]] : [];
  });
  /** @type {Map<string, string[]>} what can be done → the keys that do it */
  const rows = new Map();
  const taken = new Set();
  for (const [key, what] of [...MORE_KEYS.map(([key, text]) => [key, t(text)]), ...commands]) {
    if (taken.has(key)) continue;
    taken.add(key);
    rows.set(what, [...(rows.get(what) ?? []), key]);
  }
  return html`<section class="help-keys" aria-label=${t("help.keys")}>
    <h3>${t("help.keys")}</h3>
    <dl>${[...rows].map(([what, all]) => html`<div><dt>${all.map((key) => html`<kbd>${key}</kbd>`)}</dt><dd>${what}</dd></div>`)}</dl>
  </section>`;
}

/** What the reader may choose. */
function choices() {
  const themes = [["", t("help.system")], ["light", t("help.light")], ["dark", t("help.dark")]];
  return html`<section class="help-choices" aria-label=${t("help.choices")}>
    <h3>${t("help.choices")}</h3>
    ${choice("choose-language", t("help.language"), languages(), LANGUAGE, chooseLanguage)}
    ${choice("choose-theme", t("help.colours"), themes, theme(), chooseTheme)}
    ${
      canSpeak()
        ? html`<label for="choose-aloud"><input type="checkbox" id="choose-aloud" .checked=${speaks()} @change=${aloud}>${t("talk.aloud")}</label>`
        : nothing
    }
  </section>`;
}

/** @param {Event} event */
function aloud({ target }) {
  speak(/** @type {HTMLInputElement} */ (target).checked);
}

/** @param {string} id @param {string} label @param {string[][]} options @param {string} now @param {(value: string) => void} choose */
function choice(id, label, options, now, choose) {
  const chosen = (/** @type {Event} */ { target }) => choose(/** @type {HTMLSelectElement} */ (target).value);
  return html`<label for=${id}>${label}
    <select id=${id} @change=${chosen}>${options.map(([value, name]) => html`<option value=${value} ?selected=${value === now}>${name}</option>`)}</select>
  </label>`;
}
