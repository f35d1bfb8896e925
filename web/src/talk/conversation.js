// @ts-check
/** The conversation: what was said and what came back; at first, things to try. */

import { html, render, repeat } from "../../vendor/lit-html.js";
import { onDemand } from "../core/lazy.js";
import { t } from "../core/texts.js";
import { standingOf } from "../core/undoStack.js";
import { LAYOUTS, layoutName } from "../core/words.js";
import { openGallery } from "../timeline/sessionMenu.js";
import { beginTour } from "../panels/tourLoader.js";
import { openQuestion, shown } from "./exchanges.js";

/** @import { Command } from "../core/commands.js" */
/** @import { Scenario } from "../core/wire.js" */
/** @import { Page } from "../core/page.js" */
/** @import { State } from "../core/state.js" */
/** @import { Panel } from "../panels/index.js" */
/** @import { Exchange } from "./exchanges.js" */

const EXAMPLES = ["change", "why", "road"];

/** @typedef {typeof import("./exchange.js").exchangeTemplate} ExchangeTemplate */

/** @param {HTMLElement} host @param {Page} page @returns {Panel} */
export function createTalk(host, page) {
  // How exchanges look is fetched with the first of them.
  const wanted = onDemand(page, async () => {
    const [{ exchangeTemplate }, { followEvaluations }] = await Promise.all([import("./exchange.js"), import("./evaluations.js")]);
    followEvaluations(page);
    return exchangeTemplate;
  });
  /** @type {ExchangeTemplate | null} */ let looks = null;

  /** @param {State} state @param {State | null} before */
  function show(state, before) {
    if (looks === null && shown(state.talk).length > 0) {
      return wanted((fetched) => {
        looks = fetched;
        show(page.state(), null);
      });
    }
    render(template(state, page, looks), host);
    const known = new Set(before?.talk.map(settledAs));
    const newest = shown(state.talk).findLast((exchange) => !known.has(settledAs(exchange)));
    if (newest) host.querySelector(`[data-id="${newest.id}"]`)?.scrollIntoView({ block: "nearest" });
  }

  show(page.state(), null);
  // Who begins to use the page will soon want it.
  addEventListener("focusin", () => wanted((fetched) => (looks ??= fetched)), { once: true });
  return {
    commands: roadCommands(),

    update(state, before) {
      if (state.talk !== before.talk || state.steps !== before.steps) show(state, before);
    },
  };
}

/** What of an exchange is worth scrolling to: that it is there, answered, and with what came of an evaluation. @param {Exchange} exchange */
function settledAs({ id, standing, result }) {
  return [id, standing, ...(result?.evaluations ?? []).map((each) => "text" in each && each.text)].join();
}

/** @param {State} state @param {Page} page @param {ExchangeTemplate | null} exchangeTemplate */
function template({ talk, steps }, page, exchangeTemplate) {
  const exchanges = shown(talk);
  const open = openQuestion(talk);
  return html`<div class="exchanges" tabindex="0" role="log" aria-label=${t("talk.label")} aria-live="off">
    ${
      exchanges.length === 0 || exchangeTemplate === null
        ? welcome(page)
        : repeat(
            exchanges,
            ({ id }) => id,
            (exchange) => {
              const sequence = exchange.result?.changes.length ? exchange.result.sequence : undefined;
              return exchangeTemplate(exchange, page, { ...standingOf(steps, sequence), open: exchange.id === open });
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
    <p class="families"><button class="button small" type="button" @click=${() => openGallery(page)}>${t("gallery.open")}</button>
      <button class="button small" type="button" @click=${() => beginTour(page)}>${t("tour.begin")}</button></p>
  </div>`;
}

/** @param {string} text @param {string} what @param {Page} page */
function example(text, what, page) {
  return html`<button class="example" type="button" @click=${() => page.say(text)}>
    <span class="example-text">${text}</span><span class="example-what">${what}</span>
  </button>`;
}

/** New roads to choose from the palette, one of each family. @returns {Command[]} */
export function roadCommands() {
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
