// @ts-check
/** A menu behind a button, as the keyboard knows menus: arrows, Home, End, first letters, Escape. */

import { make } from "./dom.js";
import { icon } from "./icons.js";

/**
 * @typedef {object} Item
 * @property {string} label
 * @property {string} [keyName]
 * @property {string} [name]
 * @property {boolean} [checked]  of a thing that is on or off; the menu stays open when it is pressed
 * @property {boolean} [choice]  whether it is one of several of which one is on
 * @property {() => void} run
 */

/**
 * @param {HTMLElement} host
 * @param {string} label
 * @param {() => (Item | null)[]} items  asked for each time it opens; null is a line between groups
 */
export function createMenu(host, label, items) {
  const id = `${host.id}-list`;
  const button = make(
    "button",
    { class: "button quiet menu-button", type: "button", "aria-haspopup": "menu", "aria-expanded": "false", "aria-controls": id, onclick: () => (list.hidden ? open() : close(true)) },
    make("span", { class: "menu-label" }, label),
    icon("down"),
  );
  const list = make("div", { class: "menu-list", id, role: "menu", "aria-label": label, hidden: true });
  host.append(button, list);
  const entries = () => /** @type {HTMLElement[]} */ ([...list.querySelectorAll("[role^=menuitem]")]);

  /** @param {number} [at]  which to begin with; -1 is the last */
  function open(at = 0) {
    list.replaceChildren(...items().map((item) => (item ? entryOf(item) : make("div", { class: "menu-line", role: "separator" }))));
    list.hidden = false;
    button.setAttribute("aria-expanded", "true");
    entries().at(at)?.focus();
  }

  /** @param {boolean} back  whether the button gets the focus */
  function close(back) {
    if (list.hidden) return;
    list.hidden = true;
    button.setAttribute("aria-expanded", "false");
    if (back) button.focus();
  }

  /** @param {Item} item */
  function entryOf({ label: told, keyName, name, checked, choice, run }) {
    const entry = make(
      "button",
      {
        class: "menu-item", type: "button", role: checked === undefined ? "menuitem" : choice ? "menuitemradio" : "menuitemcheckbox", tabIndex: -1, "data-item": name ?? told,
        onclick() {
          if (checked === undefined) close(true);
          run();
          if (checked !== undefined) open(entries().indexOf(entry));
        },
      },
      make("span", {}, told),
      keyName && make("kbd", { "aria-hidden": "true" }, keyName),
    );
    if (checked !== undefined) entry.setAttribute("aria-checked", String(checked));
    return entry;
  }

  button.addEventListener("keydown", (event) => {
    if (event.key !== "ArrowDown" && event.key !== "ArrowUp") return;
    open(event.key === "ArrowDown" ? 0 : -1);
    event.preventDefault();
    event.stopPropagation();
  });
  list.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const all = entries();
    const at = all.indexOf(/** @type {HTMLElement} */ (document.activeElement));
    if (event.key === "Tab") return close(false);
    event.stopPropagation();
    if (event.key === "Escape") close(true);
    else if (event.key === "ArrowDown") all[(at + 1) % all.length]?.focus();
    else if (event.key === "ArrowUp") all.at(at - 1)?.focus();
    else if (event.key === "Home") all[0]?.focus();
    else if (event.key === "End") all.at(-1)?.focus();
    else if (event.key.length === 1 && event.key !== " ") {
      const letter = event.key.toLowerCase();
      [...all.slice(at + 1), ...all].find(({ textContent }) => textContent?.toLowerCase().startsWith(letter))?.focus();
    } else return;
    event.preventDefault();
  });
  host.addEventListener("focusout", (event) => {
    if (event.relatedTarget instanceof Node && host.contains(event.relatedTarget)) return;
    // A press on something that takes no focus is looked after by the listener below.
    if (event.relatedTarget !== null) close(false);
  });
  addEventListener("pointerdown", (event) => {
    if (event.target instanceof Node && !host.contains(event.target)) close(false);
  });
  return { open, close };
}
