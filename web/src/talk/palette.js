// @ts-check
/** Everything that can be done, in one list to search: acts with their keys, then sentences. Ctrl K opens it. */

import { perform } from "../core/commands.js";
import { make } from "../ui/dom.js";
import { guide } from "./language.js";
import { turns } from "../core/latest.js";

/** @import { Act } from "../core/commands.js" */
/** @import { Page } from "../main.js" */
/** @import { Panel } from "../panels/index.js" */

/** @typedef {{label: string, group: string, key?: string, run: () => void}} Entry */

const MOST_SHOWN = 60;

/** @param {HTMLDialogElement} dialog @param {Page} page @returns {Panel} */
export function createPalette(dialog, page) {
  const search = make("input", {
    class: "palette-search",
    type: "text",
    role: "combobox",
    placeholder: "Do or say…",
    autocomplete: "off",
    spellcheck: false,
    "aria-label": "Search what can be done or said",
    "aria-controls": "palette-list",
    "aria-expanded": "true",
    "aria-autocomplete": "list",
  });
  const list = make("div", { class: "palette-list", id: "palette-list", role: "listbox", "aria-label": "Found" });
  dialog.append(search, list);
  /** @type {Entry[]} */ let entries = [];
  /** @type {{entry: Entry, element: HTMLElement}[]} */ let found = [];
  let at = 0;
  const asking = turns();

  /** @type {Act} */
  const opens = { name: "palette", group: "Help", keyName: "Ctrl K", now: () => ({ label: "Everything that can be done", run: open }) };

  addEventListener("keydown", (event) => {
    if (event.key.toLowerCase() !== "k" || !(event.ctrlKey || event.metaKey) || event.altKey || event.shiftKey) return;
    event.preventDefault();
    if (dialog.open) dialog.close();
    else open();
  });
  search.addEventListener("input", show);
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog) dialog.close(); // beside it
  });
  dialog.addEventListener("keydown", (event) => {
    if (event.key === "ArrowDown" || event.key === "ArrowUp") mark(at + (event.key === "ArrowDown" ? 1 : -1));
    else if (event.key === "Enter") found[at]?.element.click();
    else return;
    event.preventDefault();
  });

  function open() {
    if (document.querySelector("dialog[open]")) return;
    entries = actsNow(page);
    search.value = "";
    dialog.showModal();
    show();
    const newest = asking();
    void guide().then(({ intents }) => {
      if (!newest() || !dialog.open) return;
      const sentences = intents.filter(({ available }) => available).flatMap(({ examples }) => examples.slice(0, 3));
      entries = [...actsNow(page), ...sentences.map(({ text }) => ({ label: text, group: "Say", run: () => page.put(text) }))];
      const marked = found[at]?.entry.label;
      show();
      const again = found.findIndex(({ entry }) => entry.label === marked);
      if (again > 0) mark(again); // what was chosen meanwhile stays chosen
    }, () => {}); // the acts alone are useful too
  }

  function show() {
    const ranked = rank(entries, search.value).slice(0, MOST_SHOWN);
    let group = "";
    list.replaceChildren();
    found = ranked.map((entry, number) => {
      if (entry.group !== group && search.value === "") {
        group = entry.group;
        list.append(make("p", { class: "palette-group", role: "presentation" }, group));
      }
      const element = make(
        "div",
        { class: "palette-entry", role: "option", id: `palette-${number}`, "aria-selected": "false" },
        make("span", { class: "palette-label" }, entry.group === "Say" ? `“${entry.label}”` : entry.label),
        entry.key && make("kbd", {}, entry.key),
      );
      element.addEventListener("pointermove", () => mark(number, false));
      element.addEventListener("click", () => {
        dialog.close();
        entry.run();
      });
      list.append(element);
      return { entry, element };
    });
    if (found.length === 0) list.append(make("p", { class: "palette-none" }, "Nothing like that."));
    at = 0;
    mark(0);
  }

  /** @param {number} next @param {boolean} [scroll] */
  function mark(next, scroll = true) {
    if (found.length === 0) return search.removeAttribute("aria-activedescendant");
    found[at]?.element.setAttribute("aria-selected", "false");
    at = (next + found.length) % found.length;
    const { element } = found[at];
    element.setAttribute("aria-selected", "true");
    search.setAttribute("aria-activedescendant", element.id);
    if (scroll) element.scrollIntoView({ block: "nearest" });
  }

  return { acts: [opens] };
}

/** What two keys do stands here once. @param {Page} page @returns {Entry[]} */
function actsNow(page) {
  const acts = page.acts().flatMap((act) => {
    const doing = act.now(page.state());
    return doing ? [{ label: doing.label, group: act.group, key: act.keyName, run: () => perform(act, page) }] : [];
  });
  const groups = [...new Set(acts.map(({ group }) => group))];
  return groups.flatMap((group) => {
    const own = acts.filter((act) => act.group === group);
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
