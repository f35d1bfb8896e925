// @ts-check
/**
 * The wire: the shapes of what the service sends and takes, and nothing else.
 *
 * Types come from `wire.d.ts` (`make types-page`); decoding and encoding are here. It opens no
 * connection (`socket.js`, `sessions.js`) and keeps no state (`state.js`). Unknown keys are ignored
 * and unknown message types are handed on as `unknown`, so that an older page survives a newer service.
 */

/** @import * as wire from "./wire.js" */

/** @typedef {[number, number]} Cell  column and row, counted from 0; row 0 is the destination */
/** @typedef {wire.Outcome} Status */
/** @typedef {wire.Move} Move */
/** @typedef {wire.Mover["heading"]} Heading */
/** @typedef {wire.Action} Action  one action of the language contract */
/** @typedef {wire.Metrics} Metrics */
/** @typedef {wire.State} WireState  the whole world at one tick */
/** @typedef {wire.Option} Option */
/** @typedef {wire.LogEvent} LogEvent */
/** @typedef {wire.Change} Change */
/** @typedef {wire.ChoiceModel} Choice */
/** @typedef {wire.ProblemDocument} Problem */
/** @typedef {wire.Session} Session */

/**
 * A decision, taken in the world of `tick`; it leads to the world of `tick + 1`. The stream tells it in few words,
 * `hello` and the service's answers with all that was considered.
 * @typedef {Pick<wire.Decision, "tick" | "move"> & Partial<wire.Decision> & Partial<wire.BriefDecision>} Decision
 */

/**
 * @typedef {object} Answer
 * @property {string} question
 * @property {string} about
 * @property {number | null} tick
 * @property {string} text
 * @property {Move} [move]  the one decided, when the answer is about a decision
 * @property {{id: string, kind: string, cell: Cell, role: string, moves?: Move[]}[]} causes
 * @property {Option[]} alternatives  every move of that decision
 * @property {{necessary: boolean | null, sufficient: boolean | null, minimal: boolean | null} | null} verified
 * @property {{change: Action[], decision: Move, at_tick?: number, actions?: undefined} | null} counterfactual  the first change that flips it
 * @property {{at_tick: number, actions?: Action[], move?: Move, change?: undefined}} [play]  what to do to a fork to see a what-if, or the move to make in it
 * @property {{ids: string[], cells: Cell[]}} [shown]  what to point at while it is read
 * @property {object} [quiz]  of "quiz me": the situations to predict
 */

/** @typedef {Omit<wire.CommandResult, "answer"> & {answer: Answer | null}} CommandResult */

/** @typedef {wire.HelloMessage} HelloMessage */
/** @typedef {wire.TickMessage} TickMessage */
/** @typedef {wire.ChangedMessage} ChangedMessage */
/** @typedef {wire.StateMessage} StateMessage */
/** @typedef {Omit<wire.ResultMessage, "result"> & {result: CommandResult}} ResultMessage */
/** @typedef {{type: "unknown"}} UnknownMessage  of a service that is newer than this page */
/** @typedef {Exclude<wire.StreamMessage, wire.ResultMessage> | ResultMessage | UnknownMessage} ServerMessage */
/** @typedef {wire.StreamRequest} ClientMessage */

const API = "/api/v1";

/** The keys without which a message of each type cannot be used. */
const NEEDED = /** @type {Record<string, string[]>} */ ({
  hello: ["session", "state", "sequence"],
  tick: ["tick", "sequence", "episode", "status", "metrics"],
  changed: ["state", "sequence"],
  state: ["state"],
  result: ["id", "result"],
  problem: ["problem"],
  error: ["problem"],
  gone: [],
  pong: [],
});

/** What arrived is not a message of this protocol. */
export class ProtocolError extends Error {}

/**
 * One message from its text. Throws `ProtocolError` when it is not JSON or lacks what its type needs.
 * @param {string} text
 * @returns {ServerMessage}
 */
export function decode(text) {
  let message;
  try {
    message = JSON.parse(text);
  } catch {
    throw new ProtocolError("not JSON");
  }
  if (typeof message !== "object" || message === null || typeof message.type !== "string") {
    throw new ProtocolError("no type");
  }
  const needed = Object.hasOwn(NEEDED, message.type) ? NEEDED[message.type] : null;
  if (needed === null) return { type: "unknown" };
  const lacking = needed.filter((key) => !(key in message));
  if (lacking.length > 0) {
    throw new ProtocolError(`${message.type}: no ${lacking.join(", ")}`);
  }
  return message;
}

/** @param {ClientMessage} message @returns {string} */
export function encode(message) {
  return JSON.stringify(message);
}

/** What can be said, as a path. */
export const GUIDE_PATH = `${API}/language`;

/** The sessions of the service, as a path. */
export const SESSIONS_PATH = `${API}/sessions`;

/**
 * One session, as a path.
 * @param {string} id
 */
export function sessionPath(id) {
  return `${SESSIONS_PATH}/${encodeURIComponent(id)}`;
}

/**
 * The address of a session's stream.
 * @param {URL | Location} page  the page's own address; the stream is on the same host
 * @param {string} id
 * @param {number | null} after  the last sequence number seen, to resume from
 */
export function streamUrl(page, id, after) {
  const scheme = page.protocol === "https:" ? "wss:" : "ws:";
  const resume = after === null ? "" : `?after=${after}`;
  return `${scheme}//${page.host}${sessionPath(id)}/stream${resume}`;
}
