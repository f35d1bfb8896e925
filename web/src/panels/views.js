// @ts-check
/** Which parts of the page are seen: their heads' buttons, the menu, the keys 1–6; and that it is remembered. */

import { byId, make } from "../ui/dom.js";
import { icon } from "../ui/icons.js";
import { createMenu } from "../ui/menu.js";
import { keepViews, LAYERS, PARTS, viewsLeft } from "../ui/views.js";

/** @import { Act } from "../core/commands.js" */
/** @import { Page } from "../main.js" */
/** @import { Panel } from "./index.js" */

/** What can be enlarged. @type {[name: string, label: string][]} */
const LARGE = [...PARTS.filter(([name]) => name !== "schematic"), ["talk", "Talk"]];

/** @param {HTMLElement} host  where the menu goes @param {Page} page @returns {Panel} */
export function createViews(host, page) {
  const whole = /** @type {HTMLElement} */ (document.querySelector(".page"));
  const shown = () => page.state().views;
  /** @param {string} name */
  const toggle = (name) => page.arrange({ [name]: !shown()[name] });
  /** @param {string} name */
  const enlarge = (name) => page.arrange({}, page.state().large === name ? null : name);

  createMenu(host, "Views", () => [
    ...PARTS.map(([name, label], at) => ({ name, label, keyName: String(at + 1), checked: shown()[name], run: () => toggle(name) })),
    null,
    ...LAYERS.map(([name, label]) => ({ name, label, checked: shown()[name], run: () => toggle(name) })),
    null,
    ...[false, true].map((service) => ({
      name: service ? "drawn-there" : "drawn-here",
      label: service ? "Drawn by the service" : "Drawn here",
      checked: shown().service === service,
      choice: true,
      run: () => page.arrange({ service }),
    })),
  ]);

  /** @type {Map<string, HTMLButtonElement>} */
  const growers = new Map();
  for (const [name, label] of LARGE) {
    const part = partOf(name);
    const the = `the ${label.toLowerCase()}`;
    const grow = make("button", { class: "head-button", type: "button", "data-enlarge": name, onclick: () => enlarge(name) });
    growers.set(name, grow);
    if (name === "road") {
      grow.classList.add("road-grow");
      byId("status").after(grow);
      continue;
    }
    const hide = make(
      "button",
      { class: "head-button", type: "button", "data-hide": name, "aria-label": `Hide ${the}`, title: `Hide ${the}`, onclick: () => hideAndGoOn(name) },
      icon("close"),
    );
    part.querySelector(".panel-head")?.append(make("span", { class: "head-buttons" }, grow, name !== "talk" && hide));
  }

  /** What was pressed is gone with its panel: the menu that brings it back has the focus. @param {string} name */
  function hideAndGoOn(name) {
    page.arrange({ [name]: false });
    host.querySelector("button")?.focus();
  }

  addEventListener("keydown", (event) => {
    if (event.key === "Escape" && !event.defaultPrevented && page.state().large !== null) page.arrange({}, null);
  });
  queueMicrotask(() => page.arrange(viewsLeft()));
  let begun = false;

  return {
    acts: viewActs(toggle, enlarge),

    update({ views, large }, before) {
      if (begun && views === before.views && large === before.large) return;
      begun = true;
      for (const [name] of PARTS) partOf(name).hidden = !views[name];
      for (const [name, label] of LARGE) {
        partOf(name).classList.toggle("large", large === name);
        const grow = /** @type {HTMLButtonElement} */ (growers.get(name));
        const told = large === name ? "Back to its place" : `Enlarge the ${label.toLowerCase()}`;
        grow.replaceChildren(icon(large === name ? "shrink" : "grow"));
        grow.title = large === name ? `${told}  Esc` : told;
        grow.setAttribute("aria-label", told);
        grow.setAttribute("aria-pressed", String(large === name));
      }
      whole.dataset.large = large ?? "";
      if (views !== before.views) keepViews(views);
    },
  };
}

/** @param {string} name */
function partOf(name) {
  return /** @type {HTMLElement} */ (document.querySelector(`[data-view="${name}"]`));
}

/**
 * @param {(name: string) => void} toggle
 * @param {(name: string) => void} enlarge
 * @returns {Act[]}
 */
function viewActs(toggle, enlarge) {
  const group = "Views";
  /** @type {(entry: [string, string], key?: string) => Act} */
  const toggling = ([name, label], key) => ({
    name: `view-${name}`,
    group,
    key,
    keyName: key,
    now: ({ views }) => ({ label: `${views[name] ? "Hide" : "Show"} the ${label.toLowerCase()}`, run: () => toggle(name) }),
  });
  return [
    ...PARTS.map((part, at) => toggling(part, String(at + 1))),
    ...LAYERS.map((layer) => toggling(layer)),
    ...LARGE.map(([name, label]) => ({
      name: `enlarge-${name}`,
      group,
      now: (/** @type {import("../core/state.js").State} */ { views, large }) =>
        views[name] === false ? null : { label: large === name ? `Put the ${label.toLowerCase()} back` : `Enlarge the ${label.toLowerCase()}`, run: () => enlarge(name) },
    })),
    {
      name: "drawn-by",
      group,
      now: ({ views }) => ({ label: views.service ? "Draw the road here" : "Have the service draw the road", run: () => toggle("service") }),
    },
  ];
}
