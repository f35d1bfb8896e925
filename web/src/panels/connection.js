// @ts-check
/** How the connection stands: live, or since when what is seen is stale. */

import { make, setText } from "../ui/dom.js";

/** @import { Page } from "../main.js" */
/** @import { Panel } from "./index.js" */

/** @param {HTMLElement} host @param {Page} page @returns {Panel} */
export function createConnectionBadge(host, page) {
  const lamp = make("span", { class: "lamp", "aria-hidden": "true" });
  const text = make("span", { class: "connection-text" });
  const retry = make(
    "button",
    { class: "button quiet small", type: "button", hidden: true, onclick: () => page.reconnect() },
    "Try now",
  );
  host.append(lamp, text, retry);

  return {
    update({ connection, world, session }) {
      const { phase } = connection;
      host.dataset.phase = phase;
      host.dataset.session = session ?? "";
      retry.hidden = phase !== "lost";
      document.body.classList.toggle("stale", phase === "lost" && world !== null);
      if (phase === "lost") {
        const again = `trying again in ${Math.max(1, Math.round(connection.retryMs / 1000))} s`;
        setText(text, world === null ? `No connection · ${again}` : `Stale since tick ${world.tick} · ${again}`);
      } else {
        setText(text, { opening: "Connecting", live: "Live", missing: "No session", gone: "Ended" }[phase]);
      }
    },
  };
}
