// @ts-check
/** Which parts of the page are seen: their heads' buttons, the menu, the keys 1–6; and that it is remembered. */

import { html, nothing, render } from "../../vendor/lit-html.js";
import { t } from "../core/texts.js";
import { icon } from "../ui/icons.js";
import { createMenu } from "../ui/menu.js";
import { find } from "../ui/slot.js";
import { keepViews, LAYERS, PARTS, PERSPECTIVE, STRIP, viewsLeft } from "../ui/views.js";

/** @import { Command } from "../core/commands.js" */
/** @import { Page } from "../core/page.js" */
/** @import { Action } from "../core/protocol.js" */
/** @import { State } from "../core/state.js" */
/** @import { Panel } from "./index.js" */

/** What the service tells to every page that watches, where it is said. */
const TOLD_TO_ALL = new Set([...PARTS, "path", "potholes"]);
/** What can be enlarged. */
const LARGE = [...PARTS.filter((name) => name !== "schematic"), "talk"];

/** What goes away when the other is shown: the service draws no perspective. @type {Record<string, string>} */
const INSTEAD_OF = { perspective: "service", service: "perspective" };
const PERSPECTIVE_KEY = "d";

/** @param {string} name */
const nameOf = (name) => t(`views.${name}`);

/** @param {string} name */
const theName = (name) => t(`views.the.${name}`);

/** @param {HTMLElement} host  where the menu goes @param {Page} page @returns {Panel} */
export function createViews(host, page) {
  const whole = find(document, ".page");
  find(document, ".views").dataset.none = t("views.none");
  /** @param {string} name */
  const toggle = (name) => page.arrange(shown(name, !page.state().views[name]));
  /** @param {string} name */
  const enlarge = (name) => page.arrange({}, page.state().large === name ? null : name);
  /** What was pressed is gone with its panel: the menu that brings it back has the focus. @param {string} name */
  const hide = (name) => {
    page.arrange({ [name]: false });
    host.querySelector("button")?.focus();
  };

  createMenu(host, t("views.menu"), () => menuItems(page, toggle));
  addEventListener("keydown", (event) => {
    if (event.key !== "Escape" || event.defaultPrevented || page.state().large === null) return;
    if (!document.querySelector(":popover-open, dialog[open]")) page.arrange({}, null);
  });
  queueMicrotask(() => page.arrange(viewsLeft()));
  let begun = false;

  return {
    commands: viewCommands(toggle, enlarge),

    update({ views, large }, before) {
      if (begun && views === before.views && large === before.large) return;
      begun = true;
      for (const name of PARTS) partOf(name).hidden = !views[name];
      for (const name of LARGE) {
        partOf(name).classList.toggle("large", large === name);
        render(headButtons(name, large === name, { enlarge, hide }), find(document, `[data-head=${name}]`));
      }
      whole.dataset.large = large ?? "";
      if (views !== before.views) keepViews(views);
    },
  };
}

/** With one shown or hidden. @param {string} name @param {boolean} on */
function shown(name, on) {
  const other = INSTEAD_OF[name];
  return { [name]: on, ...(on && other ? { [other]: false } : {}) };
}

/** @param {string} name */
function partOf(name) {
  return find(document, `[data-view=${name}]`);
}

/**
 * @param {string} name
 * @param {boolean} large
 * @param {{enlarge: (name: string) => void, hide: (name: string) => void}} hands
 */
function headButtons(name, large, { enlarge, hide }) {
  const grow = large ? t("views.shrink") : t("views.enlarge", { name: theName(name) });
  const hides = t("views.hide", { name: theName(name) });
  return html`<button class="head-button" type="button" data-enlarge=${name} title=${large ? `${grow}  Esc` : grow} aria-label=${grow} aria-pressed=${String(large)} @click=${() => enlarge(name)}>
      ${icon(large ? "shrink" : "grow")}
    </button>
    ${
      name === "road" || name === "talk"
        ? nothing
        : html`<button class="head-button" type="button" data-hide=${name} aria-label=${hides} title=${hides} @click=${() => hide(name)}>${icon("close")}</button>`
    }`;
}

/** @param {Page} page @param {(name: string) => void} toggle */
function menuItems(page, toggle) {
  const { views } = page.state();
  return [
    ...PARTS.map((name, at) => ({ name, label: nameOf(name), keyName: String(at + 1), checked: views[name], run: () => toggle(name) })),
    null,
    ...[...LAYERS, STRIP].map((name) => ({ name, label: nameOf(name), checked: views[name], run: () => toggle(name) })),
    { name: PERSPECTIVE, label: nameOf(PERSPECTIVE), keyName: PERSPECTIVE_KEY.toUpperCase(), checked: views[PERSPECTIVE], run: () => toggle(PERSPECTIVE) },
    null,
    ...[false, true].map((service) => ({
      name: service ? "drawn-there" : "drawn-here",
      label: t(service ? "views.drawn_there" : "views.drawn_here"),
      checked: views.service === service,
      choice: true,
      run: () => page.arrange(shown("service", service)),
    })),
  ];
}

/**
 * @param {(name: string) => void} toggle
 * @param {(name: string) => void} enlarge
 * @returns {Command[]}
 */
function viewCommands(toggle, enlarge) {
  const group = t("groups.views");
  /** @type {(name: string, key?: string) => Command} */
  const toggling = (name, key) => ({
    name: `view-${name}`,
    group,
    key,
    keyName: key?.toUpperCase(),
    now: ({ views }) => ({
      label: t(views[name] ? "views.hide" : "views.show", { name: theName(name) }),
      run: () => toggle(name),
      ...(TOLD_TO_ALL.has(name) ? { said: [/** @type {Action} */ ({ do: views[name] ? "hide" : "show", view: name })] } : {}),
    }),
  });
  return [
    ...PARTS.map((name, at) => toggling(name, String(at + 1))),
    ...[...LAYERS, STRIP].map((name) => toggling(name)),
    toggling(PERSPECTIVE, PERSPECTIVE_KEY),
    ...LARGE.map((name) => ({
      name: `enlarge-${name}`,
      group,
      now: (/** @type {State} */ { views, large }) =>
        views[name] === false ? null : { label: t(large === name ? "views.shrink_named" : "views.enlarge", { name: theName(name) }), run: () => enlarge(name) },
    })),
    {
      name: "drawn-by",
      group,
      now: ({ views }) => ({ label: t(views.service ? "views.draw_here" : "views.draw_there"), run: () => toggle("service") }),
    },
  ];
}
