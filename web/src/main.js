// @ts-check
/**
 * Where the page is put together: the session in the address, the connection, the state, the panels.
 *
 * Nothing else knows more than one of them. Messages and what the person does become events, events
 * become the next state, and the loop shows it with the next frame.
 */

import { ACTS } from "./core/commands.js";
import { byId } from "./ui/dom.js";
import { watchKeys } from "./core/keyboard.js";
import { spoken } from "./talk/language.js";
import { words } from "./core/http.js";
import { turns } from "./core/latest.js";
import { openLink, placeInHash } from "./timeline/links.js";
import { createLoop } from "./core/renderLoop.js";
import { createPanels } from "./panels/index.js";
import { createSession, findSession, hashOfSession, sessionInHash } from "./core/sessions.js";
import { Connection } from "./core/socket.js";
import { INITIAL, reduce, sceneOf } from "./core/state.js";
import { watchPreferences } from "./core/theme.js";

/** @import { Act } from "./core/commands.js" */
/** @import { Foresight } from "./why/forecast.js" */
/** @import { Otherwise } from "./why/alternatives.js" */
/** @import { Looking } from "./timeline/past.js" */
/** @import { Action, ClientMessage } from "./core/protocol.js" */
/** @import { State, Highlight, Event, Notice, Past } from "./core/state.js" */
/** @import { Views } from "./ui/views.js" */

/**
 * @typedef {object} Page  what panels may ask for
 * @property {(text: string) => void} say  send a sentence
 * @property {(text: string) => void} put  let a sentence stand in the box, to be read over and sent
 * @property {(actions: Action[], label: string, quiet?: boolean) => string} act  send typed actions; quiet ones are
 *   listed as talk only when they changed something or were refused. Answers the exchange's id
 * @property {(highlight: Highlight | null) => void} highlight
 * @property {() => void} startSession
 * @property {() => void} reconnect  now rather than after the pause
 * @property {() => Act[]} acts  all that can be done by a key or from the palette
 * @property {(message: ClientMessage) => void} send  what is neither said nor done
 * @property {(data: ArrayBuffer) => void} [picture]  a picture has come from the service
 * @property {() => State} state  the present, whatever tick is looked at
 * @property {(other: Otherwise) => void} [pick]  play what would have been beside what was
 * @property {(foresight: Foresight) => void} foresee  what is about to happen has become known
 * @property {(views: Views, large?: string | null) => void} arrange  show (true), hide (false), enlarge
 * @property {(notice: Notice | null) => void} tell  a passing line over the page, read aloud as well
 * @property {() => void} wake  something is to be drawn anew
 * @property {Looking} [looking]  which tick is looked at, and the way to others
 * @property {(past: Past | null) => void} look  show an earlier tick instead of the present, or (null) the present again
 */

let state = INITIAL;
let shown = INITIAL;
let exchanges = 0;
/** @type {Connection | null} */
let connection = null;
/** Where to go next: a session that was made for an earlier wish, and comes late, is not gone to. */
const going = turns();

/** @param {Event} event */
function dispatch(event) {
  const next = reduce(state, event);
  if (next === state) return;
  state = next;
  loop.wake(true);
}

/**
 * @param {string} label
 * @param {boolean} quiet
 * @param {(id: string) => ClientMessage} message
 */
function send(label, quiet, message) {
  exchanges += 1;
  const id = `c${exchanges}`;
  dispatch({ type: "said", id, text: label, quiet });
  if (!connection?.send(message(id))) dispatch({ type: "unsent", id });
  return id;
}

/** @type {Page} */
const page = {
  say: (text) => send(text, false, (id) => ({ type: "command", id, text, language: spoken() })),
  put(text) {
    const words = /** @type {HTMLInputElement} */ (byId("words"));
    words.value = text;
    words.focus();
    words.dispatchEvent(new Event("input"));
  },
  act: (actions, label, quiet = false) => send(label, quiet, (id) => ({ type: "actions", id, actions })),
  highlight: (highlight) => dispatch({ type: "highlight", highlight }),
  wake: () => loop.wake(),
  foresee: (foresight) => dispatch({ type: "foresight", foresight }),
  arrange: (views, large) => dispatch({ type: "views", views, large }),
  tell: (notice) => dispatch({ type: "notice", notice }),
  look: (past) => dispatch({ type: "past", past }),
  startSession: () => void startSession(),
  reconnect: () => void connection?.open(),
  acts: () => acts,
  send: (message) => void connection?.send(message),
  state: () => state,
};

const panels = createPanels(page);
const acts = [...ACTS, ...panels.flatMap((panel) => panel.acts ?? [])];
const loop = createLoop({
  update() {
    const before = shown;
    shown = sceneOf(state);
    for (const panel of panels) panel.update?.(shown, before);
  },
  draw(now) {
    let moving = false;
    for (const panel of panels) moving = (panel.draw?.(now) ?? false) || moving;
    return moving;
  },
});

/** Follow the session that the address names, or start one when it names none. */
function followAddress() {
  const place = placeInHash(location.hash);
  if (place && "carried" in place) return void openCarried(place.carried);
  const id = sessionInHash(location.hash);
  if (id === null) return startSession();
  if (id === connection?.session) return;
  going();
  connection?.close();
  dispatch({ type: "session", id });
  connection = new Connection(id, {
    page: location,
    find: findSession,
    onMessage: dispatch,
    onPicture: (data) => page.picture?.(data),
    onPhase: (phase) => dispatch({ type: "phase", phase }),
  });
  void connection.open();
}

async function startSession() {
  const newest = going();
  try {
    const session = await createSession();
    if (newest()) location.hash = hashOfSession(session.id);
  } catch (error) {
    if (newest()) dispatch({ type: "trouble", text: error instanceof Error ? error.message : String(error) });
  }
}

/** A session out of the address itself; it takes the link's place, so that going back does not make another. @param {string} link */
async function openCarried(link) {
  const newest = going();
  connection?.close();
  connection = null;
  dispatch({ type: "session", id: "" });
  try {
    const { id } = await openLink(link);
    if (newest()) location.replace(hashOfSession(id));
  } catch (error) {
    if (newest()) dispatch({ type: "trouble", text: `This link does not open. ${words(error)}` });
  }
}

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
addEventListener("hashchange", followAddress);
addEventListener("online", page.reconnect);
followAddress();
