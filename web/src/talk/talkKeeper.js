// @ts-check
/**
 * Keeps the conversation of each session in the browser: after a reload, in another tab, and in a fork it goes on where
 * it was. Only what is shown is kept, of the latest sessions, and never more than the browser gives.
 */

import { shown } from "./exchanges.js";

/** @import { Event, State } from "../core/state.js" */
/** @import { Store } from "../core/store.js" */
/** @import { Exchange } from "./exchanges.js" */

/** @typedef {Pick<Storage, "getItem" | "setItem" | "removeItem">} TalkStorage */

const PREFIX = "roadtalk.talk.";
const SESSIONS = "roadtalk.talks";
const MOST_EXCHANGES = 40;
const MOST_SESSIONS = 20;
const MOST_CHARS = 150_000;
const PAUSE_MS = 250;

/**
 * @typedef {object} Around
 * @property {TalkStorage | null} storage
 * @property {(work: () => void, delayMs: number) => any} [later]
 * @property {Pick<Window, "addEventListener">} [window]
 */

/** @param {Store<State, Event>} store @param {Around} around */
export function keepTalk(store, { storage, later = (work, ms) => setTimeout(work, ms), window: own = globalThis.window }) {
  if (storage === null) return;
  let waiting = false;
  /** What was last written or read: not written again. */ let kept = "";

  /** @param {string} session @param {Exchange[]} talk */
  function bring(session, talk) {
    kept = written(talk);
    store.dispatch({ type: "talk", session, talk });
  }

  function write() {
    waiting = false;
    const { session, talk } = store.state();
    const text = session ? written(talk) : "";
    if (!session || text === kept || text === "[]") return;
    kept = text;
    try {
      if (storage === null) return;
      storage.setItem(PREFIX + session, text);
      note(storage, session);
    } catch {
      // Full or forbidden: the conversation holds for this visit.
    }
  }

  store.subscribe((state, before) => {
    if (state.session !== before.session) {
      kept = "";
      if (state.session) bring(state.session, read(storage, state.session));
    }
    // A fork goes on with what was said before it was made.
    if (state.parent && state.parent !== before.parent && state.session && state.talk.length === 0) bring(state.session, read(storage, state.parent));
    if (state.talk === before.talk || waiting) return;
    waiting = true;
    later(write, PAUSE_MS);
  });
  own?.addEventListener("pagehide", write);
  own?.addEventListener("storage", ({ key }) => {
    const { session, talk } = store.state();
    if (session && key === PREFIX + session) bring(session, joined(read(storage, session), talk));
  });
}

/** What is kept of a conversation. @param {Exchange[]} talk */
function written(talk) {
  const settled = shown(talk).filter(({ standing }) => standing !== "pending");
  let rest = settled.slice(-MOST_EXCHANGES).map(light);
  let text = JSON.stringify(rest);
  while (text.length > MOST_CHARS && rest.length > 1) {
    rest = rest.slice(Math.ceil(rest.length / 4));
    text = JSON.stringify(rest);
  }
  return text;
}

/** Without what is only needed once. @param {Exchange} exchange @returns {Exchange} */
function light(exchange) {
  const answer = exchange.result?.answer;
  if (!exchange.result || !answer?.quiz) return exchange;
  return { ...exchange, result: { ...exchange.result, answer: { ...answer, quiz: undefined } } };
}

/** @param {TalkStorage | null} storage @param {string} session @returns {Exchange[]} */
function read(storage, session) {
  try {
    const kept = JSON.parse(storage?.getItem(PREFIX + session) ?? "[]");
    return Array.isArray(kept) ? kept.filter((each) => each && typeof each.id === "string" && typeof each.said === "string") : [];
  } catch {
    return [];
  }
}

/** What another tab has written, and what only this one has. @param {Exchange[]} theirs @param {Exchange[]} own */
function joined(theirs, own) {
  const known = new Set(theirs.map(({ id }) => id));
  return [...theirs, ...own.filter(({ id }) => !known.has(id))];
}

/** Remember that a session has a conversation, and forget the oldest. @param {TalkStorage} storage @param {string} session */
function note(storage, session) {
  /** @type {string[]} */
  const known = JSON.parse(storage.getItem(SESSIONS) ?? "[]").filter((/** @type {string} */ each) => each !== session);
  const all = [...known, session];
  for (const old of all.slice(0, -MOST_SESSIONS)) storage.removeItem(PREFIX + old);
  storage.setItem(SESSIONS, JSON.stringify(all.slice(-MOST_SESSIONS)));
}
