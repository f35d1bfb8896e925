// @ts-check
/** The keyboard: what each key does when nobody is typing. */

import { runCommand } from "./commands.js";

/** @import { Page } from "./page.js" */

/** Elements that need the keys themselves. */
const TYPING = "input, textarea, select, [contenteditable]";
const PRESSABLE = "button, a[href], summary";

/** @param {Page} page @param {HTMLElement} words  the command box */
export function watchKeys(page, words) {
  addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.isComposing) return;
    const target = event.target instanceof Element ? event.target : null;
    if (target?.closest(TYPING)) return;
    if (target?.closest(PRESSABLE) && (event.key === " " || event.key === "Enter")) return;
    if (event.key === "/") words.focus();
    else {
      const act = page.commands().find(({ key }) => key === event.key);
      if (!act || (event.repeat && !act.repeats)) return;
      runCommand(act, page);
    }
    event.preventDefault();
  });
}
