// @ts-check
/**
 * The wire: the shapes of what the service sends and takes, and nothing else.
 *
 * The one file to change when the service's JSON changes. It decodes and encodes; it opens no
 * connection (`socket.js`, `sessions.js`) and keeps no state (`state.js`). Unknown keys are ignored
 * and unknown message types are handed on as `unknown`, so that an older page survives a newer service.
 */

/** @typedef {[number, number]} Cell  column and row, counted from 0; row 0 is the destination */
/** @typedef {"running" | "success" | "crash" | "stuck"} Status */
/** @typedef {"forward" | "left" | "right" | "forward_left" | "forward_right" | "stay"} Move */
/** @typedef {"left" | "right"} Heading */
/** @typedef {{do: string, [key: string]: unknown}} Action  one action of the language contract */

/**
 * @typedef {object} Metrics
 * @property {number} episodes
 * @property {number} successes
 * @property {number} crashes
 * @property {number} stuck
 * @property {number | null} success_rate  a fraction, null until an episode has ended
 * @property {number} steps
 * @property {Record<string, number>} moves
 * @property {number} distance_m
 * @property {number | null} last_episode_ticks
 */

/**
 * @typedef {object} WireState  the whole world at one tick
 * @property {string} session
 * @property {number} tick
 * @property {number} time_s
 * @property {number} episode
 * @property {number} episode_tick
 * @property {Status} status
 * @property {{kind: string, ids: string[], cell: Cell} | null} cause
 * @property {number} columns
 * @property {number} rows
 * @property {number} visible_rows
 * @property {number} step_seconds
 * @property {boolean} paused
 * @property {number | "max"} [playback_speed]
 * @property {string} mode
 * @property {string} planner
 * @property {{id: string, kind: string, cell: Cell}[]} vehicles  autonomous ones
 * @property {{id: string, kind: string, cell: Cell, heading: Heading, disabled: boolean}[]} movers
 * @property {{id: string, kind: string, cell: Cell}[]} hazards
 * @property {Metrics} metrics
 * @property {string} digest
 * @property {number} sequence
 * @property {number} undo  how many changes can be taken back
 * @property {number} redo
 */

/** @typedef {{move: Move, cell?: Cell | null, verdict: string, cost: number | null, reason: string, causes?: string[]}} Option */

/**
 * @typedef {object} Decision  taken in the world of `tick`; it leads to the world of `tick + 1`
 * @property {number} tick
 * @property {Move} move
 * @property {string} [planner]  "manual" when a person chose
 * @property {number} [weight]  how much there is to tell, from 0 to 2
 * @property {string} [reason]  only in tick messages
 * @property {string[]} [causes]  only in tick messages
 * @property {Option[]} [options]  only in `hello`
 * @property {{move: Move, reason: string, causes: string[]}[]} [blocked]  only in tick messages: what was not free
 * @property {string | null} [narration]
 */

/** @typedef {{number: number, tick: number, type: string, text: string, ids: string[], cell: Cell | null}} LogEvent */
/** @typedef {{id: string, name: string | null, paused: boolean, config?: Record<string, unknown>, rules_note?: string | null}} Session */
/** @typedef {{path: string, before: unknown, after: unknown}} Change */
/** @typedef {{text: string, actions: Action[]}} Choice */

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
 * @property {{at_tick: number, actions: Action[], change?: undefined}} [play]  what to do to a fork to see a what-if
 */

/**
 * @typedef {object} CommandResult
 * @property {string | null} text
 * @property {Action[]} actions
 * @property {Change[]} changes
 * @property {string} reply
 * @property {Answer | null} answer
 * @property {number} sequence
 * @property {{from: string, to: string}[]} [corrections]
 */

/**
 * @typedef {object} Problem  RFC 9457, with what the language adds
 * @property {string} type
 * @property {string} title
 * @property {number} status
 * @property {string} detail
 * @property {{field: string, message: string}[]} [errors]
 * @property {string[]} [unparsed]
 * @property {string[]} [understood]
 * @property {string[]} [suggestions]
 * @property {Choice[]} [choices]
 */

/** @typedef {{type: "hello", protocol: number, session: Session, state: WireState, log: LogEvent[], decision: Decision | null, sequence: number}} HelloMessage */
/**
 * @typedef {object} TickMessage  what one tick changed; a new episode brings `state` instead of the moves
 * @property {"tick"} type
 * @property {number} tick
 * @property {number} sequence
 * @property {number} episode
 * @property {Status} status
 * @property {Record<string, Cell>} [vehicles]
 * @property {Record<string, Cell>} [moved]
 * @property {Record<string, Heading>} [turned]
 * @property {Decision | null} decision
 * @property {string | null} narration
 * @property {LogEvent[]} events
 * @property {Metrics} metrics
 * @property {string} digest
 * @property {WireState} [state]
 */
/** @typedef {{type: "changed", sequence: number, text: string | null, reply: string, changes: Change[], events: LogEvent[], state: WireState, views?: Record<string, boolean>}} ChangedMessage */
/** @typedef {{type: "state", missed: [number, number] | null, state: WireState}} StateMessage */
/** @typedef {{type: "result", id: string, result: CommandResult}} ResultMessage */
/** @typedef {{type: "problem", id: string, problem: Problem}} ProblemMessage */
/** @typedef {{type: "error", problem: Problem} | {type: "gone"} | {type: "pong"} | {type: "unknown"}} OtherMessage */
/** @typedef {HelloMessage | TickMessage | ChangedMessage | StateMessage | ResultMessage | ProblemMessage | OtherMessage} ServerMessage */

/** @typedef {{type: "command", id: string, text: string, language?: string} | {type: "actions", id: string, actions: Action[]} | {type: "ping"} | Subscription | {type: "unsubscribe"}} ClientMessage */
/** @typedef {{type: "subscribe", frames: "webp" | "jpeg", view: "road" | "schematic", fps: number, side: number}} Subscription */

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
    throw new ProtocolError("the service sent something that is not JSON");
  }
  if (typeof message !== "object" || message === null || typeof message.type !== "string") {
    throw new ProtocolError("the service sent a message without a type");
  }
  const needed = Object.hasOwn(NEEDED, message.type) ? NEEDED[message.type] : null;
  if (needed === null) return { type: "unknown" };
  const lacking = needed.filter((key) => !(key in message));
  if (lacking.length > 0) {
    throw new ProtocolError(`the service sent "${message.type}" without ${lacking.join(", ")}`);
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
