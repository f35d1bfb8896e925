// @ts-check
/** The rules that stand, above the driving log; each can be switched off. Shows nothing while there are none. */

import { html, nothing, render } from "../../vendor/lit-html.js";
import { t } from "../core/texts.js";
import { icon } from "../ui/icons.js";

/** @import { Page } from "../core/page.js" */
/** @import { Rule } from "../core/wire.js" */
/** @import { Panel } from "./index.js" */

/** @param {HTMLElement} host @param {Page} page @returns {Panel} */
export function createRules(host, page) {
  /** @param {readonly Rule[]} rules */
  function show(rules) {
    render(
      rules.length === 0
        ? nothing
        : html`<ul class="rules" aria-label=${t("rules.label")}>
            ${rules.map((rule) => row(rule, page))}
          </ul>`,
      host,
    );
  }

  return {
    update({ world, past }, before) {
      const rules = rulesShown(world, past);
      if (rules !== rulesShown(before.world, before.past)) show(rules);
    },
  };
}

/** @type {readonly Rule[]} */
const NONE = [];

/** @param {{rules: readonly Rule[]} | null} world @param {unknown} past @returns {readonly Rule[]} none of a past tick */
export function rulesShown(world, past) {
  return world === null || past !== null ? NONE : world.rules;
}

/** @param {Rule} rule @param {Page} page */
function row({ number, text, fired }, page) {
  const label = t("rules.cancel", { number });
  const act = () => page.act([{ do: "cancel", which: number }], label, true);
  return html`<li class="rule">
    <span class="rule-text">${t("rules.rule", { number, text, fired })}</span>
    <button class="button small" type="button" aria-label=${label} title=${label} @click=${act}>${icon("close")}</button>
  </li>`;
}
