// @ts-check
/** A menu behind a button: a native popover, with the keys that menus have: arrows, Home, End, first letters. */

import { html, nothing, render } from "../../vendor/lit-html.js";
import { icon } from "./icons.js";
import { find } from "./slot.js";

/**
 * @typedef {object} Item
 * @property {string} label
 * @property {string} [keyName]
 * @property {string} [note]  a line under the label
 * @property {string} [name]
 * @property {boolean} [checked]  of a thing that is on or off; the menu stays open when it is pressed
 * @property {boolean} [choice]  whether it is one of several of which one is on
 * @property {boolean} [closes]  whether the menu closes although it is one of several
 * @property {() => void} run
 */

const GAP_PX = 4;
const EDGE_PX = 8;
/** A menu with less room than this beneath its button opens over it, where there is more. */
const LEAST_ROOM_PX = 320;
/** So narrow that menus open at the edge. */
const NARROW_PX = 480;

/**
 * @param {HTMLElement} host
 * @param {string} label
 * @param {() => (Item | null)[]} items  asked for each time it opens; null is a line between groups
 * @param {string} [says]  its name for assistive technology, where the label alone does not tell it
 * @returns {(label: string, off: boolean) => void}  names it otherwise, and says whether it can be opened
 */
export function createMenu(host, label, items, says) {
  const id = `${host.id}-list`;
  let open = false;
  let off = false;
  /** What stands in it; kept when it closes, since the focus goes back from there. @type {(Item | null)[]} */
  let entered = [];

  function show() {
    if (open) entered = items();
    render(template({ id, label, says: says ?? label, off, open, items: entered, pressed, toggles, toggled, opens }), host);
  }
  show();
  const list = find(host, ".menu-list");
  const entries = () => /** @type {HTMLElement[]} */ ([...list.querySelectorAll("[role^=menuitem]")]);

  /** @param {ToggleEvent} event */
  function toggles({ newState }) {
    open = newState === "open";
    if (open) place(list, find(host, ".menu-button"));
    show();
  }

  /** @param {ToggleEvent} event */
  function toggled({ newState }) {
    if (newState === "open" && !list.contains(document.activeElement)) entries()[0]?.focus();
  }

  /** @param {KeyboardEvent} event */
  function opens(event) {
    if (event.key !== "ArrowDown" && event.key !== "ArrowUp") return;
    list.showPopover();
    entries().at(event.key === "ArrowDown" ? 0 : -1)?.focus();
    event.preventDefault();
    event.stopPropagation();
  }

  /** @param {Item} item */
  function pressed({ checked, closes, run }) {
    const over = checked === undefined || closes;
    if (over) list.hidePopover();
    run();
    if (!over) show();
  }

  list.addEventListener("keydown", (event) => walk(event, entries(), list));
  return (name, disabled) => {
    if (name === label && disabled === off) return;
    label = name;
    off = disabled;
    show();
  };
}

/**
 * @param {object} menu
 * @param {string} menu.id
 * @param {string} menu.label
 * @param {string} menu.says
 * @param {boolean} menu.off
 * @param {boolean} menu.open
 * @param {(Item | null)[]} menu.items
 * @param {(item: Item) => void} menu.pressed
 * @param {(event: ToggleEvent) => void} menu.toggles
 * @param {(event: ToggleEvent) => void} menu.toggled
 * @param {(event: KeyboardEvent) => void} menu.opens
 */
function template({ id, label, says, off, open, items, pressed, toggles, toggled, opens }) {
  return html`<button class="button quiet menu-button" type="button" popovertarget=${id} aria-haspopup="menu" aria-expanded=${String(open)} aria-label=${says === label ? nothing : `${says}: ${label}`} ?disabled=${off} @keydown=${opens}>
      <span class="menu-label">${label}</span>${icon("down")}
    </button>
    <div class="menu-list" id=${id} role="menu" aria-label=${says} popover @beforetoggle=${toggles} @toggle=${toggled}>
      ${items.map((item) => (item ? entry(item, pressed) : html`<div class="menu-line" role="separator"></div>`))}
    </div>`;
}

/** @param {Item} item @param {(item: Item) => void} pressed */
function entry(item, pressed) {
  const { label, keyName, name, note, checked, choice } = item;
  const role = checked === undefined ? "menuitem" : choice ? "menuitemradio" : "menuitemcheckbox";
  return html`<button class="menu-item" type="button" role=${role} tabindex="-1" data-item=${name ?? label} aria-checked=${checked === undefined ? nothing : String(checked)} @click=${() => pressed(item)}>
    <span class="menu-words"><span>${label}</span>${note ? html`<span class="menu-note">${note}</span>` : nothing}</span>${keyName ? html`<kbd aria-hidden="true">${keyName}</kbd>` : nothing}
  </button>`;
}

/** Keys in an open menu. @param {KeyboardEvent} event @param {HTMLElement[]} all @param {HTMLElement} list */
function walk(event, all, list) {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  if (event.key === "Tab") return list.hidePopover();
  event.stopPropagation();
  const at = all.indexOf(/** @type {HTMLElement} */ (document.activeElement));
  if (event.key === "ArrowDown") all[(at + 1) % all.length]?.focus();
  else if (event.key === "ArrowUp") all.at(at - 1)?.focus();
  else if (event.key === "Home") all[0]?.focus();
  else if (event.key === "End") all.at(-1)?.focus();
  else if (event.key.length === 1 && event.key !== " ") {
    const letter = event.key.toLowerCase();
    [...all.slice(at + 1), ...all].find(({ textContent }) => textContent?.trim().toLowerCase().startsWith(letter))?.focus();
  } else return;
  event.preventDefault();
}

/** Under its button, or over it where there is more room; as far to the right, on a phone at the edge of the window. @param {HTMLElement} list @param {HTMLElement} button */
function place(list, button) {
  const { top, bottom, right } = button.getBoundingClientRect();
  const edge = innerWidth < NARROW_PX ? EDGE_PX : Math.max(EDGE_PX, innerWidth - right);
  const above = top > innerHeight - bottom && innerHeight - bottom < LEAST_ROOM_PX;
  const inset = above ? `auto ${Math.round(edge)}px ${Math.round(innerHeight - top + GAP_PX)}px auto` : `${Math.round(bottom + GAP_PX)}px ${Math.round(edge)}px auto auto`;
  list.style.inset = inset;
  list.style.maxBlockSize = `${Math.round((above ? top : innerHeight - bottom) - GAP_PX - EDGE_PX)}px`;
}
