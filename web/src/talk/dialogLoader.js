// @ts-check
/** Help (`?`) and the palette (Ctrl K), fetched when they are first opened or, before that, when the browser has nothing to do. */

import { onDemand, styled, whenIdle } from "../core/lazy.js";
import { t } from "../core/texts.js";

/** @import { Page } from "../core/page.js" */
/** @import { Panel } from "../panels/index.js" */

/** @param {HTMLElement} button @param {HTMLDialogElement} dialog @param {Page} page @returns {Panel} */
export function createHelpLoader(button, dialog, page) {
  const wanted = onDemand(page, async () => {
    const [{ createHelp }] = await Promise.all([import("./help.js"), styled("help")]);
    return createHelp(dialog, page);
  });
  const open = () => wanted((help) => void help.open());
  button.addEventListener("click", open);
  whenIdle(() => void wanted(() => {}));
  return {
    commands: [
      { name: "box", group: t("groups.talk"), keyName: "/", now: () => ({ label: t("talk.to_box"), run: () => document.getElementById("words")?.focus() }) },
      { name: "help", group: t("groups.help"), key: "?", keyName: "?", now: () => ({ label: t("help.title"), run: open }) },
    ],
  };
}

/** @param {HTMLDialogElement} dialog @param {Page} page @returns {Panel} */
export function createPaletteLoader(dialog, page) {
  const wanted = onDemand(page, async () => {
    const [{ createPalette }] = await Promise.all([import("./palette.js"), styled("help")]);
    return createPalette(dialog, page);
  });
  function open() {
    const typed = collectKeys();
    wanted((palette) => {
      const { text, entered } = typed();
      void palette.open(text, entered);
    }).finally(typed);
  }
  dialog.setAttribute("aria-label", t("palette.label"));
  whenIdle(() => void wanted(() => {}));
  addEventListener("keydown", (event) => {
    if (event.key.toLowerCase() !== "k" || !(event.ctrlKey || event.metaKey) || event.altKey || event.shiftKey) return;
    event.preventDefault();
    if (dialog.open) dialog.close();
    else open();
  });
  return { commands: [{ name: "palette", group: t("groups.help"), keyName: "Ctrl K", now: () => ({ label: t("palette.label"), run: open }) }] };
}

/** Collects what is typed, up to Enter, until it is asked for: who types at once loses no key. @returns {() => {text: string, entered: boolean}} */
function collectKeys() {
  let text = "";
  let entered = false;
  const collect = (/** @type {KeyboardEvent} */ event) => {
    if ((event.key.length !== 1 && event.key !== "Enter") || event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === "Enter") entered = true;
    else text += event.key;
    event.preventDefault();
    event.stopPropagation();
  };
  addEventListener("keydown", collect, { capture: true });
  return () => {
    removeEventListener("keydown", collect, { capture: true });
    return { text, entered };
  };
}
