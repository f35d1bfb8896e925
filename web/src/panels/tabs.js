// @ts-check
/** On a screen too small for all panels one is seen at a time, chosen by a row of tabs; the road stays beside them. */

import { html, render } from "../../vendor/lit-html.js";
import { prefer, preference } from "../core/preferences.js";
import { t } from "../core/texts.js";
import { find } from "../ui/slot.js";

/** @import { Page } from "../core/page.js" */
/** @import { State } from "../core/state.js" */
/** @import { Panel } from "./index.js" */

const TABS = ["talk", "log", "plan", "occupancy", "metrics"];

/** @param {HTMLElement} host @param {Page} page @returns {Panel} */
export function createTabs(host, page) {
  const whole = find(document, ".page");
  let chosen = preference("tab", "talk");

  /** @param {State} state */
  function show({ views }) {
    const there = TABS.filter((name) => views[name] !== false);
    const open = there.includes(chosen) ? chosen : "talk";
    whole.dataset.tab = open;
    render(
      there.map(
        (name) =>
          html`<button class="tab" type="button" data-tab=${name} aria-pressed=${String(name === open)} @click=${() => choose(name)}>${t(name === "log" ? "views.log_short" : `views.${name}`)}</button>`,
      ),
      host,
    );
  }

  /** @param {string} name */
  function choose(name) {
    chosen = name;
    prefer("tab", name);
    show(page.state());
    page.wake();
    host.scrollIntoView({ block: "start" });
  }

  show(page.state());
  return {
    update(state, before) {
      // What is asked to be shown is seen; and so is an answer.
      const shown = TABS.find((name) => state.views[name] && before.views[name] === false);
      if (shown) chosen = shown;
      if (state.talk.length > before.talk.length && state.session === before.session && state.talk.at(-1)?.quiet === false) chosen = "talk";
      show(state);
    },
  };
}
