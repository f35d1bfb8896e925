// @ts-check
/** What was said in this page and what came back, as a list of exchanges. */

/** @import { CommandResult, Problem } from "../core/protocol.js" */
/** @import { PendingQuestion } from "../core/wire.js" */

/**
 * @typedef {object} Exchange
 * @property {string} id
 * @property {string} said
 * @property {boolean} quiet  a button or a key rather than words: shown only when there is something to tell
 * @property {"pending" | "done" | "refused" | "unknown"} standing  "unknown": the connection was lost before the answer
 * @property {CommandResult | null} result
 * @property {Problem | null} problem
 * @property {boolean} [asks]  it only asks
 * @property {boolean} [closed]  its question waits for no answer any more
 */

export const TALK_EXCHANGES = 100;

/** @param {Exchange[]} talk @param {{id: string, text: string, quiet: boolean, asks?: boolean}} said @returns {Exchange[]} */
export function beginExchange(talk, { id, text, quiet, asks = false }) {
  /** @type {Exchange} */
  const exchange = { id, said: text, quiet, asks, standing: "pending", result: null, problem: null };
  return [...talk, exchange].slice(-TALK_EXCHANGES);
}

/** @param {Exchange[]} talk @param {string} id @param {CommandResult} result @returns {Exchange[]} */
export function answerExchange(talk, id, result) {
  return replaced(talk, id, { standing: "done", result });
}

/** What the page did by itself. @param {Exchange[]} talk @param {{id: string, text: string, reply: string}} done @returns {Exchange[]} */
export function answerHere(talk, { id, text, reply }) {
  const result = /** @type {CommandResult} */ (/** @type {unknown} */ ({ text, reply, actions: [], changes: [], corrections: [], answer: null }));
  return answerExchange(talk, id, result);
}

/** @param {Exchange[]} talk @param {string} id @param {Problem} problem @returns {Exchange[]} */
export function refuseExchange(talk, id, problem) {
  return replaced(talk, id, { standing: "refused", problem });
}

/**
 * The id of the exchange whose question waits for an answer; null where none does.
 * What was said since drops it, unless it was refused or asked for the question; of buttons only a choice or the ✕.
 * @param {Exchange[]} talk
 * @returns {string | null}
 */
export function openQuestion(talk) {
  /** @type {Exchange | null} */ let open = null;
  for (const exchange of talk) {
    if (exchange.problem?.pending && !exchange.closed) open = exchange;
    else if (open !== null && exchange.standing === "done" && endsQuestion(exchange, open)) open = null;
  }
  return open?.id ?? null;
}

/** @param {Exchange} exchange @param {Exchange} open */
function endsQuestion({ result, quiet }, open) {
  const actions = result?.actions ?? [];
  if (actions.some(({ do: verb }) => verb === "drop")) return true;
  const done = JSON.stringify(actions);
  if ((open.problem?.choices ?? []).some((choice) => JSON.stringify(choice.actions) === done)) return true;
  return !quiet && result?.text !== null && result?.answer?.about !== "pending";
}

/**
 * A question that waited when the page was opened, as if it had been asked here.
 * @param {Exchange[]} talk
 * @param {PendingQuestion | null | undefined} pending
 * @returns {Exchange[]}
 */
export function withQuestion(talk, pending) {
  const open = openQuestion(talk);
  if (!pending) return open === null ? talk : replaced(talk, open, { closed: true }); // a restart has dropped it
  if (open !== null) return talk;
  const { text, question, choices } = pending;
  /** @type {Problem} */
  const problem = { type: "/problems/ambiguous", title: "", status: 409, detail: question, errors: [], choices, pending };
  /** @type {Exchange} */
  const exchange = { id: "pending", said: text, quiet: false, standing: "refused", result: null, problem };
  return [...talk.filter(({ id }) => id !== exchange.id), exchange];
}

/**
 * The connection is gone: what was pending will not be answered any more.
 * @param {Exchange[]} talk
 * @returns {Exchange[]}
 */
export function endUnanswered(talk) {
  if (!talk.some((exchange) => exchange.standing === "pending")) return talk;
  return talk.map((exchange) =>
    exchange.standing === "pending" ? { ...exchange, standing: "unknown" } : exchange,
  );
}

/**
 * Those exchanges that are worth showing: all that was said, and of buttons and keys what changed
 * something or was refused (pausing, and moves that were asked for, show on the road itself).
 * @param {Exchange[]} talk
 * @returns {Exchange[]}
 */
export function shown(talk) {
  return talk.filter(
    ({ quiet, standing, result }) =>
      !quiet || standing === "refused" || standing === "unknown" || changesOf(result).some(({ path }) => path !== "queue") || result?.answer,
  );
}

/**
 * What a result changed on the road; whether the clock runs shows on the road and is not repeated.
 * @param {CommandResult | null} result
 */
export function changesOf(result) {
  return (result?.changes ?? []).filter(({ path }) => path !== "paused" && path !== "tick");
}

/** @param {Exchange[]} talk @param {string} id @param {Partial<Exchange>} part @returns {Exchange[]} */
function replaced(talk, id, part) {
  return talk.map((exchange) => (exchange.id === id ? { ...exchange, ...part } : exchange));
}
