// @ts-check
/** A dialog over the page: a title, a way to close it, and the focus given back to where it was. Its style is `dialog.css`. */

import { make } from "./dom.js";
import { icon } from "./icons.js";

/**
 * @param {string} title
 * @param {...(Node | string)} content
 */
export function makeDialog(title, ...content) {
  const heading = make("h2", { class: "dialog-title", id: `dialog-${title.toLowerCase().replaceAll(" ", "-")}` }, title);
  const dialog = make(
    "dialog",
    { class: "dialog", "aria-labelledby": heading.id },
    make(
      "header",
      { class: "dialog-head" },
      heading,
      make("button", { class: "button quiet icon", type: "button", "aria-label": "Close", onclick: () => dialog.close() }, icon("close")),
    ),
    make("div", { class: "dialog-body" }, ...content),
  );
  // A press beside it closes it; keys belong to it alone while it is open.
  dialog.addEventListener("click", (event) => event.target === dialog && dialog.close());
  dialog.addEventListener("keydown", (event) => event.stopPropagation());
  document.body.append(dialog);
  return dialog;
}
