// @ts-check
/** The words of `index.html` in the reader's language: `data-text`, `data-label` and `data-title` name them. */

import { t } from "../core/texts.js";

/** @param {ParentNode} root */
export function fillTexts(root) {
  for (const element of /** @type {NodeListOf<HTMLElement>} */ (root.querySelectorAll("[data-text], [data-label], [data-title]"))) {
    const { text, label, title } = element.dataset;
    if (text) element.textContent = t(text);
    if (label) element.setAttribute("aria-label", t(label));
    if (title) element.title = `${t(title)}${element.dataset.key ? `  ${element.dataset.key}` : ""}`;
  }
}
