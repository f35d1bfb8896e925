// @ts-check
/** The bar over the road while the past is looked at: where one is, and what can be done from there. */

import { html, nothing, render } from "../../vendor/lit-html.js";
import { runCommand } from "../core/commands.js";
import { t } from "../core/texts.js";
import { icon } from "../ui/icons.js";

/** @import { Command } from "../core/commands.js" */
/** @import { Page } from "../core/page.js" */
/** @import { State } from "../core/state.js" */
/** @import { TimeTravel } from "./timeTravel.js" */
/** @import { Panel } from "../panels/index.js" */

/**
 * @param {HTMLElement} host
 * @param {Page} page
 * @returns {Panel}
 */
export function createPast(host, page) {
  host.setAttribute("aria-label", t("past.label"));

  function show() {
    const state = page.state();
    const open = state.look.tick !== null;
    const left = !open && host.contains(document.activeElement);
    host.hidden = !open;
    document.body.classList.toggle("past-seen", open);
    render(open ? bar(state, page) : nothing, host);
    if (left) /** @type {HTMLElement | null} */ (document.querySelector(".line"))?.focus({ preventScroll: true });
  }

  // The tick wished for is told at once; how many there are by now, with the next frame.
  page.subscribe(({ look }, before) => look !== before.look && show());
  return {
    commands: pastCommands(page.timeTravel),
    update: ({ look }) => look.tick !== null && show(),
  };
}

/** @param {State} state @param {Page} page */
function bar({ look, world }, page) {
  const run = (/** @type {string} */ name) => () => {
    const act = page.commands().find((each) => each.name === name);
    if (act) runCommand(act, page);
  };
  const live = `${t("past.live_title")}  N`;
  return html`<span class="past-where"><span class="past-tick">${t("past.tick", { tick: look.tick })}</span><span class="past-now">${t("past.of", { now: world?.tick ?? look.tick })}</span></span>
    ${button("fork", t("past.fork"), t("past.fork_here"), run("fork"))}
    ${button("rewind", t("past.rewind"), t("past.rewind_here"), run("rewind"))}
    ${button("share", t("past.share"), t("past.share"), run("share"))}
    <button class="past-live" type="button" data-past="live" aria-label=${t("past.live_label")} title=${live} @click=${() => page.timeTravel.live()}>
      <span class="past-now">${t("past.live_before")}</span><span>${t("past.live")}</span>
    </button>`;
}

/** @param {string} name @param {string} text @param {string} label @param {() => void} press */
function button(name, text, label, press) {
  return html`<button class="past-do" type="button" data-past=${name} aria-label=${label} title=${label} @click=${press}>
    ${icon(name)}<span class="past-label">${text}</span>
  </button>`;
}

/** @param {TimeTravel} timeTravel @returns {Command[]} */
function pastCommands(timeTravel) {
  const group = t("groups.time");
  return [
    { name: "to-start", group, now: ({ world }) => (world && world.tick > 0 ? { label: t("timeline.start"), run: () => void timeTravel.at(0) } : null) },
    { name: "to-live", group, key: "n", keyName: "N", now: ({ past }) => past && { label: t("timeline.present"), run: () => timeTravel.live() } },
  ];
}
