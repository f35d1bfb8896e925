// @ts-check
/** Passing lines over the page: what was done in the background, and what went wrong there. */

import { html, nothing, render } from "../../vendor/lit-html.js";
import { t } from "../core/texts.js";
import { icon } from "./icons.js";

/** @import { Page } from "../core/page.js" */
/** @import { Notice } from "../core/state.js" */
/** @import { Panel } from "../panels/index.js" */

const SHOWN_MS = 6_000;
const BAD_MS = 12_000;

/** @param {HTMLElement} host @param {Page} page @returns {Panel} */
export function createNotice(host, page) {
  /** @type {any} */ let timer = null;

  function hide() {
    const busy = host.firstElementChild?.matches(":hover, :focus-within");
    if (busy) timer = setTimeout(hide, SHOWN_MS);
    else render(nothing, host);
  }

  return {
    update({ notice }, before) {
      if (notice === before.notice || notice?.aloud) return;
      clearTimeout(timer);
      render(notice ? box(notice, page) : nothing, host);
      if (notice) timer = setTimeout(hide, notice.tone === "bad" || notice.offer ? BAD_MS : SHOWN_MS);
    },
  };
}

/** @param {Notice} notice @param {Page} page */
function box({ text, tone, offer }, page) {
  const take = () => {
    page.tell(null);
    offer?.run();
  };
  return html`<div class="notice-box" data-tone=${tone ?? "plain"}>
    <span class="notice-text">${text}</span>
    ${offer ? html`<button class="notice-offer" type="button" @click=${take}>${offer.label}</button>` : nothing}
    <button class="notice-close" type="button" aria-label=${t("page.dismiss")} @click=${() => page.tell(null)}>${icon("close")}</button>
  </div>`;
}
