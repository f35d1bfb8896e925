// @ts-check
/** How the connection stands: live, in the past that is looked at, or since when what is seen is stale. */

import { html, render } from "../../vendor/lit-html.js";
import { t } from "../core/texts.js";

/** @import { Page } from "../core/page.js" */
/** @import { State } from "../core/state.js" */
/** @import { Panel } from "./index.js" */

/** @param {HTMLElement} host @param {Page} page @returns {Panel} */
export function createConnectionBadge(host, page) {
  return {
    update(state) {
      const { phase } = state.connection;
      host.dataset.phase = phase;
      host.toggleAttribute("data-past", state.past !== null);
      host.dataset.session = state.session ?? "";
      document.body.classList.toggle("stale", phase === "lost" && state.world !== null);
      render(
        html`<span class="lamp" aria-hidden="true"></span><span class="connection-text">${textOf(state)}</span>
          <button class="button quiet small" type="button" ?hidden=${phase !== "lost"} @click=${page.reconnect}>${t("connection.retry")}</button>`,
        host,
      );
    },
  };
}

/** @param {State} state */
function textOf({ connection, past, world }) {
  if (connection.phase === "live" && past !== null)
    return html`${t("connection.past")}<span class="connection-tick">${t("connection.past_tick", past.world)}</span>`;
  if (connection.phase !== "lost") return t(`connection.${connection.phase}`);
  const seconds = Math.max(1, Math.round(connection.retryMs / 1000));
  return world === null ? t("connection.lost", { seconds }) : t("connection.stale", { tick: world.tick, seconds });
}
