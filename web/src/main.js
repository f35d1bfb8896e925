// @ts-check
/**
 * Where the page is put together: the store, the connection, what keeps the state filled, the panels.
 *
 * Messages and what the person does become events, events become the next state, and the loop shows it with the next
 * frame.
 */

import { COMMANDS, watchKeys } from "./core/commands.js";
import { Connector } from "./core/connector.js";
import { createPage } from "./core/page.js";
import { createLoop } from "./core/renderLoop.js";
import { INITIAL, reduce, sceneOf } from "./core/state.js";
import { browserStorage } from "./core/preferences.js";
import { createStore } from "./core/store.js";
import { watchPreferences } from "./core/theme.js";
import { createPanels } from "./panels/index.js";
import { loadPastLines } from "./talk/pastLoader.js";
import { keepTalk } from "./talk/talkKeeper.js";
import { keepAddress } from "./timeline/momentAddress.js";
import { TimelineLoader } from "./timeline/timelineLoader.js";
import { TimeTravel } from "./timeline/timeTravel.js";
import { byId, fillTexts } from "./ui/dom.js";
import { knowLatestDecision } from "./why/latestDecision.js";
import { RegretLoader } from "./why/regretLoader.js";

fillTexts(document);
const store = createStore(reduce, INITIAL);
const connector = new Connector(store);
new RegretLoader(store);
keepTalk(store, { storage: browserStorage() });
loadPastLines(store);
knowLatestDecision(store);
new TimelineLoader(store, { storage: browserStorage() });
const timeTravel = new TimeTravel(store);
keepAddress(store, timeTravel);
export const page = createPage(store, connector, {
  timeTravel,
  commands: () => commands,
  wake: () => loop.wake(),
});

const { panels, later } = createPanels(page);
const commandsOf = () => [...COMMANDS, ...panels.flatMap((panel) => panel.commands ?? [])];
let commands = commandsOf();
let shown = INITIAL;
/** Whether the panels that the first frame does without are asked for. */
let complete = false;

/** Fetches the rest of the panels; tried again with the next frame where the service was out of reach. */
async function addPanels() {
  try {
    const added = await later();
    panels.push(...added);
    commands = commandsOf();
    for (const panel of added) panel.update?.(shown, INITIAL);
    loop.wake(true);
  } catch {
    complete = false;
  }
}

const loop = createLoop({
  update() {
    const before = shown;
    shown = sceneOf(store.state());
    for (const panel of panels) panel.update?.(shown, before);
  },
  draw(now) {
    let moving = false;
    for (const panel of panels) moving = (panel.draw?.(now) ?? false) || moving;
    if (!complete && shown.world !== null) {
      complete = true;
      setTimeout(addPanels);
    }
    return moving;
  },
});
store.subscribe(() => loop.wake(true));

watchKeys(page, byId("words"));
// The address names the session: the link there by keyboard must not lead away from it.
document.querySelector(".skip")?.addEventListener("click", (event) => {
  event.preventDefault();
  byId("words").focus();
});
watchPreferences(() => {
  for (const panel of panels) panel.repaint?.();
  loop.wake(true);
});
new ResizeObserver(() => {
  for (const panel of panels) panel.repaint?.();
  loop.wake();
}).observe(byId("road"));
addEventListener("hashchange", () => connector.follow());
addEventListener("online", page.reconnect);
connector.follow();
