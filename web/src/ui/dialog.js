// @ts-check
/** A dialog over the page: a title and a way to close it; the rest is the platform's. Its style is `dialog.css`. */

import { html, render } from "../../vendor/lit-html.js";
import { t } from "../core/texts.js";
import { icon } from "./icons.js";
import { createSlot } from "./slot.js";

let made = 0;

/**
 * @param {string} title
 * @param {...unknown} content  elements or templates
 * @returns {HTMLDialogElement}
 */
export function makeDialog(title, ...content) {
  const id = `dialog-${++made}`;
  const host = document.createElement("div");
  render(
    html`<dialog class="dialog" closedby="any" aria-labelledby=${id} @keydown=${(/** @type {Event} */ event) => event.stopPropagation()}>
      <header class="dialog-head">
        <h2 class="dialog-title" id=${id}>${title}</h2>
        <button class="button quiet icon" type="button" aria-label=${t("page.close")} @click=${() => dialog.close()}>${icon("close")}</button>
      </header>
      <div class="dialog-body">${content}</div>
    </dialog>`,
    host,
  );
  const dialog = /** @type {HTMLDialogElement} */ (host.firstElementChild);
  document.body.append(dialog);
  return dialog;
}

/**
 * The slot of a dialog's body, for content that is rendered again.
 * @param {HTMLDialogElement} dialog
 */
export function dialogSlot(dialog) {
  return createSlot(/** @type {HTMLElement} */ (dialog.querySelector(".dialog-body")));
}
