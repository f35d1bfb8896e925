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
  return { link: createLinkDialog(), moments: createMomentsDialog(page), sessions: createSessionsDialog(page) };
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
