// @ts-check
/** What lies over the road: how an episode ended, that the clock stands, that there is no session. */

import { make } from "../ui/dom.js";

/** @import { Page } from "../main.js" */
/** @import { State } from "../core/state.js" */
/** @import { Panel } from "./index.js" */

const ENDS = /** @type {Record<string, {title: string, tone: string}>} */ ({
  crash: { title: "Crash", tone: "bad" },
  success: { title: "Success", tone: "good" },
  stuck: { title: "Stuck", tone: "bad" },
});

/** Events that tell of a road and not of an end. */
const OF_ROADS = new Set(["episode_started", "road_kept", "no_way", "way_open"]);

/** @param {HTMLElement} host @param {Page} page @returns {Panel} */
export function createVerdict(host, page) {
  const over = make("div", { class: "verdict", hidden: true });
  const paused = make("p", { class: "paused", hidden: true }, "Paused");
  host.append(over, paused);

  return {
    update(state, before) {
      paused.hidden = !(state.world?.paused && state.world.status === "running");
      const key = keyOf(state);
      if (key === keyOf(before)) return;
      over.hidden = key === "";
      over.replaceChildren();
      if (key === "") return;
      const { title, tone, text, offer } = contentOf(state);
      over.dataset.tone = tone;
      over.append(make("p", { class: "verdict-title" }, title));
      if (text) over.append(make("p", { class: "verdict-text" }, text));
      if (offer) {
        over.append(
          make("button", { class: "button strong", type: "button", onclick: () => page.startSession() }, offer),
        );
      }
    },
  };
}

/** Changes exactly when what is shown must. @param {State} state */
function keyOf(state) {
  if (state.trouble) return `trouble ${state.trouble}`;
  const { phase } = state.connection;
  if (phase === "missing" || phase === "gone") return phase;
  const { world } = state;
  if (world === null) return phase === "lost" ? "waiting" : "";
  return world.status === "running" ? "" : `${world.status} ${world.episode}`;
}

/** @param {State} state @returns {{title: string, tone: string, text?: string, offer?: string}} */
function contentOf(state) {
  if (state.trouble) return { title: "No session", tone: "bad", text: state.trouble, offer: "Try again" };
  const { phase } = state.connection;
  if (phase === "missing") {
    const text = "There is no session at this address. It may have been deleted, or the link is not complete.";
    return { title: "Not found", tone: "plain", text, offer: "Start a new session" };
  }
  if (phase === "gone") {
    return { title: "Ended", tone: "plain", text: "This session was deleted.", offer: "Start a new session" };
  }
  const { world } = state;
  if (world === null) return { title: "Waiting", tone: "plain", text: "The service cannot be reached yet." };
  const last = state.log.findLast(({ tone, type }) => tone === "event" && !OF_ROADS.has(type));
  return { ...ENDS[world.status], text: last?.text };
}
