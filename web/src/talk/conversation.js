// @ts-check
/** The conversation: what was said and what came back; at first, things to try. */

import { html, render, repeat } from "../../vendor/lit-html.js";
import { t } from "../core/texts.js";
import { standingOf } from "../core/undoStack.js";
import { LAYOUTS, layoutName } from "../core/words.js";
import { exchangeTemplate } from "./exchange.js";
import { shown } from "./exchanges.js";

/** @import { Command } from "../core/commands.js" */
/** @import { Scenario } from "../core/wire.js" */
/** @import { Page } from "../core/page.js" */
/** @import { State } from "../core/state.js" */
/** @import { Panel } from "../panels/index.js" */

const EXAMPLES = ["change", "why", "road"];

/** @param {HTMLElement} host @param {Page} page @returns {Panel} */
export function createTalk(host, page) {
  render(template(page.state(), page), host);

  return {
    commands: roadCommands(),

    update(state, before) {
      if (state.talk === before.talk && state.steps === before.steps) return;
      render(template(state, page), host);
      const known = new Set(before.talk);
      const newest = shown(state.talk).findLast((exchange) => !known.has(exchange));
      if (newest) host.querySelector(`[data-id="${newest.id}"]`)?.scrollIntoView({ block: "nearest" });
    },
  };
}

/** @param {State} state @param {Page} page */
function template({ talk, steps }, page) {
  const exchanges = shown(talk);
  return html`<div class="exchanges" tabindex="0" role="log" aria-label=${t("talk.label")} aria-live="off">
    ${
      exchanges.length === 0
        ? welcome(page)
        : repeat(
            exchanges,
            ({ id }) => id,
            (exchange) => {
              const sequence = exchange.result?.changes.length ? exchange.result.sequence : undefined;
              return exchangeTemplate(exchange, page, standingOf(steps, sequence));
            },
          )
    }
  </div>`;
}

/** @param {Page} page */
function welcome(page) {
  return html`<div class="welcome">
    <p class="welcome-title">${t("talk.welcome")}</p>
    <p class="welcome-text">${t("talk.welcome_text")}</p>
    <div class="examples">${EXAMPLES.map((name) => example(t(`talk.examples.${name}`), t(`talk.examples.${name}_for`), page))}</div>
    <p class="families">
      ${t("talk.families")}
      ${LAYOUTS.map(layoutName).map((words) => html`<button class="family" type="button" @click=${() => page.say(words)}>${words}</button>`)}
    </p>
  </div>`;
}

/** @param {string} text @param {string} what @param {Page} page */
function example(text, what, page) {
  return html`<button class="example" type="button" @click=${() => page.say(text)}>
    <span class="example-text">${text}</span><span class="example-what">${what}</span>
  </button>`;
}

/** New roads to choose from the palette, one of each family. @returns {Command[]} */
function roadCommands() {
  return LAYOUTS.map((layout) => ({
    name: `road-${layout}`,
    group: t("groups.new_road"),
    now({ past, world }) {
      if (world === null || past) return null;
      const label = t("talk.new_road", { name: layoutName(layout) });
      return { label, turns: [[{ do: "scenario", layout: /** @type {Scenario["layout"]} */ (layout) }]] };
    },
  }));
}
