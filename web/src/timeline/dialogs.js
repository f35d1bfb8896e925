// @ts-check
/** The dialogs of the session's menu, fetched when one is first opened. */

import { html } from "../../vendor/lit-html.js";
import { t } from "../core/texts.js";
import { dialogSlot, makeDialog } from "../ui/dialog.js";
import { createMomentsDialog } from "./momentsDialog.js";
import { createSessionsDialog } from "./sessionsDialog.js";

/** @import { Page } from "../core/page.js" */
/** @import { Dialogs } from "./sessionMenu.js" */

/** @param {Page} page @returns {Dialogs} */
export function createDialogs(page) {
  return { link: createLinkDialog(), embed: createEmbedDialog(), moments: createMomentsDialog(page), sessions: createSessionsDialog(page) };
}

/** A link that cannot be copied by the page, to be copied by hand. */
function createLinkDialog() {
  const dialog = makeDialog(t("link.title"));
  const body = dialogSlot(dialog);
  const select = (/** @type {Event} */ { target }) => /** @type {HTMLInputElement} */ (target).select();

  return (/** @type {string} */ url, /** @type {string} */ what) => {
    body(html`<input class="field" readonly autofocus aria-label=${t("link.label")} .value=${url} @focus=${select}>
      <p class="dialog-note">${t("link.by_hand", { what })}</p>`);
    dialog.showModal();
  };
}

/** A snippet for another page, to be copied. */
function createEmbedDialog() {
  const dialog = makeDialog(t("embed.title"));
  const body = dialogSlot(dialog);
  const select = (/** @type {Event} */ { target }) => /** @type {HTMLTextAreaElement} */ (target).select();

  return (/** @type {string} */ snippet, /** @type {string} */ what) => {
    const copy = async () => {
      const field = /** @type {HTMLTextAreaElement} */ (dialog.querySelector("textarea"));
      const done = await navigator.clipboard?.writeText(snippet).then(() => true, () => false);
      if (done) dialog.close();
      else field.focus();
    };
    body(html`<textarea class="field" readonly autofocus rows="5" aria-label=${t("embed.snippet")} .value=${snippet} @focus=${select}></textarea>
      <p class="dialog-note">${t("embed.note", { what })}</p>
      <div class="form-end"><button class="button strong" type="button" @click=${copy}>${t("embed.copy")}</button></div>`);
    dialog.showModal();
  };
}
