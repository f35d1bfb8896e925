// @ts-check
/** Help: what can be said, by kind, which keys there are, and what the reader may choose. `?` opens it. */

import { byId, make } from "../ui/dom.js";
import { guide, spoken } from "./language.js";
import { prefer } from "../core/preferences.js";
import { chooseTheme, theme } from "../core/theme.js";
import { plain } from "../core/words.js";
import { canSpeak, speak, speaks } from "./speech.js";

/** @import { Act } from "../core/commands.js" */
/** @import { Guide } from "./language.js" */
/** @import { Page } from "../main.js" */
/** @import { Panel } from "../panels/index.js" */

const NAMES = /** @type {Record<string, string>} */ ({ en: "English", de: "Deutsch" });
const THEMES = [
  ["", "As the system"],
  ["light", "Light"],
  ["dark", "Dark"],
];
const MOST_EXAMPLES = 3;
/** Kinds of sentences under people's headings, in the order of a first hour; others follow under their own name. */
const HEADINGS = /** @type {[string, string[]][]} */ ([
  ["New roads", ["scenario", "reset"]],
  ["Put things there", ["add", "set_count"]],
  ["Take things away", ["remove"]],
  ["Ask why", ["ask why", "ask why_not", "ask what_if"]],
  ["Ask what is", ["ask status", "ask scene", "ask next", "ask metrics", "ask confidence"]],
  ["Clock", ["pause", "resume", "step"]],
  ["Time", ["undo", "redo", "rewind", "save", "load"]],
  ["Drive yourself", ["mode", "drive"]],
  ["Settings", ["set", "adjust", "prefer"]],
  ["Views", ["show", "hide"]],
  ["Advice", ["advise", "ask maintenance"]],
  ["Teach a phrase", ["teach", "forget"]],
]);
/** Keys that are not acts of their own. */
const MORE_KEYS = [
  ["/", "To the box"],
  ["↑ ↓", "In the box: what was said before"],
  ["Tab", "In the box: complete the sentence"],
  ["Escape", "Close, or clear the box"],
];

/** @param {HTMLElement} button @param {Page} page @returns {Panel} */
export function createHelp(button, page) {
  const body = make("div", { class: "help-body" });
  const close = make("button", { class: "button quiet", type: "button", onclick: () => dialog.close() }, "Close");
  const title = make("h2", { id: "help-title" }, "What can I say?");
  const dialog = make("dialog", { class: "help", "aria-labelledby": "help-title" }, make("header", {}, title, close), body);
  document.body.append(dialog);
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog) dialog.close();
  });
  button.addEventListener("click", open);

  /** @type {Act} */
  const opens = { name: "help", group: "Help", key: "?", keyName: "?", now: () => ({ label: "What can I say?", run: open }) };
  /** @type {Act} */
  const speech = {
    name: "box",
    group: "Talk",
    keyName: "/",
    now: () => ({ label: "To the box", run: () => byId("words").focus() }),
  };

  function open() {
    if (document.querySelector("dialog[open]")) return;
    const wait = make("p", { class: "help-wait" }, "One moment…");
    body.replaceChildren(wait, keys(page), choices(open));
    dialog.showModal();
    close.focus();
    // Each answer takes the place of its own wait: one that was asked for before the language changed, and comes late,
    // finds its place gone.
    void guide().then(
      (told) => wait.replaceWith(sayings(told, page, dialog)),
      (error) => wait.replaceWith(make("p", { class: "help-wait", role: "alert" }, `What can be said is not known just now. ${error.message}`)),
    );
  }

  return { acts: [speech, opens] };
}

/** @param {Guide} told @param {Page} page @param {HTMLDialogElement} dialog */
function sayings({ intents, taught }, page, dialog) {
  const not = intents.filter(({ available }) => !available);
  const section = make("section", { class: "help-sayings", "aria-label": "Sentences" });
  const left = new Map(intents.filter(({ available }) => available).map((intent) => [intent.intent, intent.examples]));
  for (const [heading, kinds] of HEADINGS) {
    const found = kinds.flatMap((kind) => left.get(kind)?.slice(0, kinds.length > 1 ? 2 : MOST_EXAMPLES) ?? []);
    for (const kind of kinds) left.delete(kind);
    if (found.length > 0) section.append(group(heading, found));
  }
  for (const [kind, examples] of left) section.append(group(plain(kind), examples.slice(0, MOST_EXAMPLES)));
  if (taught.length > 0) {
    section.append(
      make(
        "div",
        { class: "help-intent" },
        make("h3", {}, "taught here"),
        ...taught.map(({ phrase, sentence }) => make("p", {}, make("b", {}, phrase), ` means ${sentence}`)),
      ),
    );
  }
  if (not.length > 0) {
    section.append(make("p", { class: "help-not" }, `Understood, but not available yet: ${not.map(({ intent }) => plain(intent)).join(", ")}.`));
  }
  return section;

  /** @param {string} heading @param {{text: string}[]} examples */
  function group(heading, examples) {
    const offers = examples.map(({ text }) => {
      const put = () => {
        dialog.close();
        page.put(text);
      };
      return make("button", { class: "help-example", type: "button", title: "Put it in the box", onclick: put }, text);
    });
    return make("div", { class: "help-intent" }, make("h3", {}, heading), ...offers);
  }
}

/** @param {Page} page */
function keys(page) {
  const acts = page.acts().flatMap((act) => {
    const doing = act.keyName ? act.now(page.state()) : null;
    return doing && act.keyName ? [[act.keyName, doing.label]] : [];
  });
  /** @type {Map<string, string[]>} what can be done → the keys that do it */
  const rows = new Map();
  const taken = new Set();
  for (const [key, what] of [...MORE_KEYS, ...acts]) {
    if (taken.has(key)) continue;
    taken.add(key);
    rows.set(what, [...(rows.get(what) ?? []), key]);
  }
  return make(
    "section",
    { class: "help-keys", "aria-label": "Keys" },
    make("h3", {}, "Keys"),
    make("dl", {}, ...[...rows].map(([what, keys]) => make("div", {}, make("dt", {}, ...keys.map((key) => make("kbd", {}, key))), make("dd", {}, what)))),
  );
}

/** What the reader may choose. @param {() => void} again  show help anew */
function choices(again) {
  const language = make("select", { id: "choose-language" });
  for (const [code, name] of Object.entries(NAMES)) language.append(make("option", { value: code, selected: code === spoken() }, name));
  language.addEventListener("change", () => {
    prefer("language", language.value);
    /** @type {HTMLDialogElement | null} */ (language.closest("dialog"))?.close();
    again();
  });
  const themes = make("select", { id: "choose-theme" });
  for (const [value, name] of THEMES) themes.append(make("option", { value, selected: value === theme() }, name));
  themes.addEventListener("change", () => chooseTheme(themes.value));
  const aloud = make("input", { type: "checkbox", id: "choose-aloud", checked: speaks() });
  aloud.addEventListener("change", () => speak(aloud.checked));
  return make(
    "section",
    { class: "help-choices", "aria-label": "Choices" },
    make("h3", {}, "Choices"),
    make("label", { htmlFor: "choose-language" }, "I speak", language),
    make("label", { htmlFor: "choose-theme" }, "Colours", themes),
    canSpeak() && make("label", { htmlFor: "choose-aloud" }, aloud, "Read aloud what matters"),
  );
}
