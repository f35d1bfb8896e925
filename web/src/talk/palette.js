// @ts-check
/** Everything that can be done, in one list to search: commands with their keys, then sentences. Ctrl K opens it. */

import { html, live, nothing, render } from "../../vendor/lit-html.js";
import { runCommand } from "../core/commands.js";
import { newestOnly } from "../core/latest.js";
import { t } from "../core/texts.js";
import { guide } from "./language.js";

/** @import { Page } from "../core/page.js" */

/** @typedef {{label: string, group: string, key?: string, said?: boolean, run: () => void}} Entry  said: a sentence */
/** @typedef {{entries: Entry[], typed: string, at: number}} Shown */

const MOST_SHOWN = 60;
/** Sentences of a kind. */
const MOST_EXAMPLES = 3;

/** @param {HTMLDialogElement} dialog @param {Page} page */
export function createPalette(dialog, page) {
  /** @type {Shown} */ let shown = { entries: [], typed: "", at: 0 };
  const asking = newestOnly();
  const found = () => rank(shown.entries, shown.typed).slice(0, MOST_SHOWN);

  /** @param {Partial<Shown>} change @param {boolean} [scroll] */
  function show(change, scroll = true) {
    shown = { ...shown, ...change };
    render(template(found(), shown, { type, mark: (at) => at !== shown.at && show({ at }, false), run }), dialog);
    if (scroll) dialog.querySelector('[aria-selected="true"]')?.scrollIntoView({ block: "nearest" });
  }

  /** @param {Event} event */
  function type({ target }) {
    show({ typed: /** @type {HTMLInputElement} */ (target).value, at: 0 });
  }

  /** @param {Entry} entry */
  function run(entry) {
    dialog.close();
    entry.run();
  }

  /** @param {string} [typed]  what is searched for already @param {boolean} [entered]  whether Enter was pressed after it */
  async function open(typed = "", entered = false) {
    if (document.querySelector("dialog[open]")) return;
    show({ entries: commandsNow(page), typed, at: 0 });
    dialog.showModal();
    if (entered && found().length > 0) return run(found()[0]);
    const newest = asking();
    const guidance = await guide().catch(() => null); // the commands alone are useful too
    if (guidance === null || !newest() || !dialog.open) return;
    const sentences = guidance.intents.filter(({ available }) => available).flatMap(({ examples }) => examples.slice(0, MOST_EXAMPLES));
    const marked = found()[shown.at]?.label;
    shown.entries = [...commandsNow(page), ...sentences.map(({ text }) => ({ label: text, group: t("groups.say"), said: true, run: () => page.put(text) }))];
    // What was chosen meanwhile stays chosen.
    show({ at: Math.max(0, found().findIndex(({ label }) => label === marked)) });
  }

  dialog.addEventListener("click", (event) => {
    if (event.target === dialog) dialog.close(); // beside it
  });
  dialog.addEventListener("keydown", (event) => {
    const all = found();
    if (event.key === "ArrowDown" || event.key === "ArrowUp") {
      if (all.length > 0) show({ at: (shown.at + (event.key === "ArrowDown" ? 1 : -1) + all.length) % all.length });
    } else if (event.key === "Enter") {
      if (all.length > 0) run(all[shown.at]);
    } else return;
    event.preventDefault();
  });

  return { open };
}

/**
 * @param {Entry[]} found
 * @param {Shown} shown
 * @param {{type: (event: Event) => void, mark: (at: number) => void, run: (entry: Entry) => void}} does
 */
function template(found, { typed, at }, { type, mark, run }) {
  return html`<input class="palette-search" type="text" role="combobox" placeholder=${t("palette.placeholder")} autocomplete="off" spellcheck="false" aria-label=${t("palette.search")}
      aria-controls="palette-list" aria-expanded="true" aria-autocomplete="list" aria-activedescendant=${found.length > 0 ? `palette-${at}` : nothing} .value=${live(typed)} @input=${type}>
    <div class="palette-list" id="palette-list" role="listbox" aria-label=${t("palette.found")}>
      ${found.map((entry, number) => {
        const heading = typed === "" && entry.group !== found[number - 1]?.group;
        return html`${heading ? html`<p class="palette-group" role="presentation">${entry.group}</p>` : nothing}
          <div class="palette-entry" role="option" id="palette-${number}" aria-selected=${String(number === at)} @pointermove=${() => mark(number)} @click=${() => run(entry)}>
            <span class="palette-label">${entry.said ? t("palette.sentence", { text: entry.label }) : entry.label}</span>${entry.key ? html`<kbd>${entry.key}</kbd>` : nothing}
          </div>`;
      })}
      ${found.length === 0 ? html`<p class="palette-none">${t("palette.none")}</p>` : nothing}
    </div>`;
}

/** What two keys do stands here once. @param {Page} page @returns {Entry[]} */
function commandsNow(page) {
  const commands = page.commands().flatMap((act) => {
    const doing = act.now(page.state());
    return doing ? [{ label: doing.label, group: act.group, key: act.keyName, run: () => runCommand(act, page) }] : [];
  });
  const groups = [...new Set(commands.map(({ group }) => group))];
  return groups.flatMap((group) => {
    const own = commands.filter((act) => act.group === group);
    return own.filter(({ label }, at) => own.findIndex((act) => act.label === label) === at);
  });
}

/**
 * Those that fit what was typed, best first: whole words before beginnings before letters in order.
 * @template {{label: string}} T
 * @param {T[]} entries
 * @param {string} typed
 * @returns {T[]}
 */
export function rank(entries, typed) {
  const wanted = typed.trim().toLowerCase();
  if (wanted === "") return entries;
  return entries
    .map((entry, order) => ({ entry, order, score: score(entry.label.toLowerCase(), wanted) }))
    .filter(({ score }) => score > 0)
    .sort((a, b) => b.score - a.score || a.order - b.order)
    .map(({ entry }) => entry);
}

/** @param {string} label @param {string} wanted */
function score(label, wanted) {
  const at = label.indexOf(wanted);
  if (at === 0) return 4;
  if (at > 0) return label[at - 1] === " " ? 3 : 2;
  let from = -1;
  for (const letter of wanted.replaceAll(" ", "")) {
    from = label.indexOf(letter, from + 1);
    if (from === -1) return 0;
  }
  return 1;
}
