// @ts-check
/** What panels may ask for: to read the state, to dispatch events, to say and do things. */

import { spokenAct } from "./spoken.js";
import { LANGUAGE } from "./texts.js";

/** @import { Command } from "./commands.js" */
/** @import { Connector } from "./connector.js" */
/** @import { Action, ClientMessage } from "./protocol.js" */
/** @import { Event, Highlight, Notice, State } from "./state.js" */
/** @import { Store } from "./store.js" */
/** @import { TimeTravel } from "../timeline/timeTravel.js" */
/** @import { Views } from "../ui/views.js" */
/** @import { Foresight } from "../why/forecast.js" */
/** @import { Hypothesis } from "../why/alternatives.js" */

/**
 * @typedef {object} Page
 * @property {() => State} state  the present, whatever tick is looked at
 * @property {(event: Event) => void} dispatch
 * @property {Store<State, Event>["subscribe"]} subscribe
 * @property {(text: string) => void} say  send a sentence
 * @property {(text: string) => void} put  let a sentence stand in the box, to be read over and sent
 * @property {(actions: Action[], label: string, quiet?: boolean) => string} act  send typed actions; quiet ones are
 *   listed as talk only when they changed something or were refused. Answers the exchange's id
 * @property {(message: ClientMessage) => void} send  send any other message
 * @property {(highlight: Highlight | null) => void} highlight
 * @property {(foresight: Foresight) => void} foresee  what is about to happen has become known
 * @property {(views: Views, large?: string | null) => void} arrange  show (true), hide (false), enlarge
 * @property {(notice: Notice | null) => void} tell  a passing line over the page, read aloud as well
 * @property {(other: Hypothesis) => void} pick  show a counterfactual beside the real run
 * @property {TimeTravel} timeTravel  which tick is looked at, and the way to others
 * @property {() => void} startSession
 * @property {() => void} reconnect  now rather than after the pause
 * @property {() => Command[]} commands  all that can be done by a key or from the palette
 * @property {() => void} wake  something is to be drawn anew
 * @property {(call: (data: ArrayBuffer) => void) => void} onPicture  be called with each picture that the service sends
 */

/** Whether it surely is a question, as far as that can be told before it is answered. @param {Said} sent */
function asks(sent) {
  return sent.type === "command" ? sent.text.trimEnd().endsWith("?") : sent.actions.every((action) => action.do === "ask");
}

/** @typedef {Extract<ClientMessage, {type: "command" | "actions"}>} Said */

/**
 * @param {Store<State, Event>} store
 * @param {Connector} connector
 * @param {{timeTravel: TimeTravel, commands: () => Command[], wake: () => void}} parts
 * @returns {Page}
 */
export function createPage({ state, dispatch, subscribe }, connector, parts) {
  let exchanges = 0;
  /** Exchanges are kept from visit to visit, and those of another tab come in between. */
  const visit = Math.random().toString(36).slice(2, 8);

  /**
   * @param {string} label
   * @param {boolean} quiet
   * @param {(id: string) => Said} message
   */
  function exchange(label, quiet, message) {
    exchanges += 1;
    const id = `${visit}-${exchanges}`;
    const { tick } = state().look;
    const sent = message(id);
    dispatch({ type: "said", id, text: label, quiet, asks: asks(sent) });
    // What is asked is asked of the tick that is looked at.
    if (!connector.send(tick === null ? sent : { ...sent, at_tick: tick })) dispatch({ type: "unsent", id });
    return id;
  }

  /** Do what a sentence names among all that keys, menus and buttons do; or let the service hear it. @param {string} text */
  function say(text) {
    const spoken = spokenAct(text, parts.commands(), state());
    if (spoken === null) return void exchange(text, false, (id) => ({ type: "command", id, text, language: LANGUAGE }));
    const { said } = spoken.doing;
    if (said) return void exchange(text, false, (id) => ({ type: "actions", id, actions: said }));
    for (const actions of spoken.doing.turns ?? []) exchange(text, false, (id) => ({ type: "actions", id, actions }));
    if (spoken.doing.run) answerHere(text, spoken.doing.label);
    spoken.doing.run?.(page);
  }

  /** An exchange that the service has no part in. @param {string} text @param {string} reply */
  function answerHere(text, reply) {
    exchanges += 1;
    const id = `${visit}-${exchanges}`;
    dispatch({ type: "said", id, text, quiet: false });
    dispatch({ type: "done-here", id, text, reply });
  }

  /** @type {Page} */
  const page = {
    state,
    dispatch,
    subscribe,
    say,
    put: (text) => dispatch({ type: "draft", text }),
    act: (actions, label, quiet = false) => exchange(label, quiet, (id) => ({ type: "actions", id, actions })),
    send: (message) => void connector.send(message),
    onPicture: (call) => void connector.pictures.add(call),
    highlight: (highlight) => dispatch({ type: "highlight", highlight }),
    foresee: (foresight) => dispatch({ type: "foresight", foresight }),
    arrange: (views, large) => dispatch({ type: "views", views, large }),
    tell: (notice) => dispatch({ type: "notice", notice }),
    pick: (other) => dispatch({ type: "comparison", other }),
    startSession: () => void connector.startSession(),
    reconnect: () => connector.reconnect(),
    ...parts,
  };
  return page;
}
