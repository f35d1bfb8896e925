// @ts-check
/** Parts of the page that are fetched when they are first wanted, so that the page itself stays light. */

import { errorText } from "./http.js";
import { t } from "./texts.js";

/** @import { Page } from "./page.js" */
/** @import { State } from "./state.js" */
/** @import { Panel } from "../panels/index.js" */

/**
 * Returns a function that loads a part on first use and passes it to the callback. A failed load is shown to the user
 * and retried on the next use.
 * @template Part
 * @param {Page} page
 * @param {() => Promise<Part>} make
 * @returns {(use: (part: Part) => unknown) => Promise<unknown>}  resolved when the load has succeeded or failed
 */
export function onDemand(page, make) {
  /** @type {Promise<Part> | null} */ let part = null;
  return (use) => {
    part ??= make();
    return part.then(use, (error) => {
      part = null;
      page.tell({ text: t("page.part_not_fetched", { reason: errorText(error) }), tone: "bad" });
    });
  };
}

/**
 * A panel that is fetched when the state first asks for it.
 * @param {Page} page
 * @param {(state: State) => boolean} isWanted
 * @param {() => Promise<Panel>} make
 * @returns {Panel}
 */
export function lazyPanel(page, isWanted, make) {
  /** @type {Panel | null} */ let panel = null;
  const wanted = onDemand(page, async () => (panel = await make()));
  return {
    update(state, before) {
      if (panel) panel.update?.(state, before);
      else if (isWanted(state)) wanted((made) => made.update?.(page.state(), before));
    },
    draw: (now) => panel?.draw?.(now) ?? false,
    repaint: () => panel?.repaint?.(),
  };
}

/**
 * A part's own style, fetched with it.
 * @param {string} name  of the file in `style/`
 * @returns {Promise<void>}
 */
export function styled(name) {
  return new Promise((resolve, reject) => {
    const link = document.createElement("link");
    link.rel = "stylesheet";
    link.href = `style/${name}.css`;
    link.onload = () => resolve();
    link.onerror = () => {
      link.remove();
      reject(new Error(t("page.style_missing")));
    };
    document.head.append(link);
  });
}

/**
 * Runs a task once the browser has nothing else to do: what is fetched then is there when it is wanted, also without a network.
 * @param {() => void} task
 */
export function whenIdle(task) {
  if ("requestIdleCallback" in globalThis) requestIdleCallback(task, { timeout: 10_000 });
  else setTimeout(task, 2000); // Safari
}
