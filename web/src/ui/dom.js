// @ts-check
/** Places of the page, and the words of `index.html` in the reader's language. */

import { t } from "../core/texts.js";

/**
 * The element with an id, which the page is known to have.
 * @param {string} id
 */
export function byId(id) {
  const element = document.getElementById(id);
  if (element === null) throw new Error(`no #${id}`);
  return element;
}

/**
 * Fills in the words that `data-text`, `data-label` and `data-title` name.
 * @param {ParentNode} root
 */
export function fillTexts(root) {
  for (const element of /** @type {NodeListOf<HTMLElement>} */ (root.querySelectorAll("[data-text], [data-label], [data-title]"))) {
    const { text, label, title } = element.dataset;
    if (text) element.textContent = t(text);
    if (label) element.setAttribute("aria-label", t(label));
    if (title) element.title = `${t(title)}${element.dataset.key ? `  ${element.dataset.key}` : ""}`;
  }
}
