// @ts-check
/** The conversation: what was said and what came back; at first, things to try. */

import { make } from "../ui/dom.js";
import { standingOf } from "../core/undoStack.js";
import { shown } from "./exchanges.js";
import { LAYOUTS } from "../core/words.js";
import { exchangeElement } from "./exchange.js";

/** @import { Page } from "../main.js" */
/** @import { Exchange } from "./exchanges.js" */
/** @import { Panel } from "../panels/index.js" */

const EXAMPLES = [
  { text: "add five potholes", what: "change the road" },
  { text: "why did you do that?", what: "ask for a reason" },
  { text: "simulate a highway with 10 potholes and 2 obstacles", what: "start a new road" },
];

/** @param {HTMLElement} host @param {Page} page @returns {Panel} */
export function createTalk(host, page) {
  const list = make("div", { class: "exchanges", tabIndex: 0, role: "log", "aria-label": "Conversation", "aria-live": "off" });
  host.append(list);
  const greeting = welcome(page);
  list.append(greeting);
  /** @type {Map<string, {exchange: Exchange, standing: string, element: HTMLElement}>} */
  const elements = new Map();

  return {
    update({ talk, steps }, before) {
      if (talk === before.talk && steps === before.steps) return;
      const exchanges = shown(talk);
      const kept = new Set(exchanges.map(({ id }) => id));
      if (exchanges.length > 0) greeting.remove();
      else list.append(greeting);
      /** @type {HTMLElement | null} */
      let newest = null;
      for (const [id, { element }] of elements) {
        if (kept.has(id)) continue;
        element.remove();
        elements.delete(id);
      }
      for (const exchange of exchanges) {
        const known = elements.get(exchange.id);
        const { undos, taken } = standingOf(steps, exchange.result?.changes.length ? exchange.result.sequence : undefined);
        const standing = `${undos} ${taken}`;
        if (known?.exchange === exchange && known.standing === standing) continue;
        const element = exchangeElement(exchange, page, undos, taken);
        if (known) known.element.replaceWith(element);
        else list.append(element);
        if (known?.exchange !== exchange) newest = element;
        elements.set(exchange.id, { exchange, standing, element });
      }
      newest?.scrollIntoView({ block: "nearest" });
    },
  };
}

/** @param {Page} page */
function welcome(page) {
  return make(
    "div",
    { class: "welcome" },
    make("p", { class: "welcome-title" }, "Talk to the road"),
    make("p", { class: "welcome-text" }, "The blue vehicle drives by itself. Change its world in plain words, and ask it why."),
    make(
      "div",
      { class: "examples" },
      ...EXAMPLES.map(({ text, what }) =>
        make(
          "button",
          { class: "example", type: "button", onclick: () => page.say(text) },
          make("span", { class: "example-text" }, text),
          make("span", { class: "example-what" }, what),
        ),
      ),
    ),
    make(
      "p",
      { class: "families" },
      "or a road with",
      ...Object.values(LAYOUTS).map((words) => make("button", { class: "family", type: "button", onclick: () => page.say(words) }, words)),
    ),
  );
}
