// @ts-check
/** Passing lines over the page: what was done in the background, and what went wrong there. */

import { make } from "./dom.js";
import { icon } from "./icons.js";

/** @import { Page } from "../main.js" */
/** @import { Panel } from "../panels/index.js" */

const SHOWN_MS = 6_000;
const BAD_MS = 12_000;

/** @param {HTMLElement} host @param {Page} page @returns {Panel} */
export function createNotice(host, page) {
  const box = make("div", { class: "notice-box", hidden: true });
  host.append(box);
  /** @type {any} */ let timer = null;

  function hide() {
    if (box.contains(document.activeElement) || box.matches(":hover")) timer = setTimeout(hide, SHOWN_MS);
    else box.hidden = true;
  }

  return {
    update({ notice }, before) {
      if (notice === before.notice || notice?.aloud) return;
      clearTimeout(timer);
      box.hidden = notice === null;
      if (notice === null) return;
      const { text, tone, offer } = notice;
      box.dataset.tone = tone ?? "plain";
      box.replaceChildren(
        make("span", { class: "notice-text" }, text),
        offer
          ? make("button", { class: "notice-offer", type: "button", onclick() {
              page.tell(null);
              offer.run();
            } }, offer.label)
          : "",
        make("button", { class: "notice-close", type: "button", "aria-label": "Dismiss", onclick: () => page.tell(null) }, icon("close")),
      );
      timer = setTimeout(hide, tone === "bad" || offer ? BAD_MS : SHOWN_MS);
    },
  };
}
