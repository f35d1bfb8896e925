// @ts-check
/**
 * The connection to one session: keeps a WebSocket open, says how it stands, and resumes.
 *
 * A lost connection is tried again with growing, jittered pauses. Before each try the session is
 * looked up over HTTP, since a browser does not tell a page why a WebSocket was refused. Silence is
 * tested with a ping, because a paused session rightly sends nothing.
 */

import { decode, encode, ProtocolError, streamUrl } from "./protocol.js";

/** @import { ServerMessage, ClientMessage } from "./protocol.js" */

/** @typedef {{phase: "opening" | "live" | "missing" | "gone"} | {phase: "lost", retryMs: number}} Phase */

/**
 * @typedef {object} Wiring  what a connection is made of; tests bring their own
 * @property {URL | Location} page
 * @property {(id: string) => Promise<"here" | "missing" | "unreachable">} find
 * @property {(message: ServerMessage) => void} onMessage
 * @property {(phase: Phase) => void} onPhase
 * @property {(data: ArrayBuffer) => void} [onPicture]
 * @property {(url: string) => WebSocket} [open]
 * @property {(work: () => void, delayMs: number) => unknown} [later]
 * @property {(timer: any) => void} [cancel]
 * @property {() => number} [random]
 */

const FIRST_PAUSE_MS = 400;
const LONGEST_PAUSE_MS = 10_000;
const PING_AFTER_MS = 8_000;
/** A busy service, or machine, may take its time; one that is gone closes the socket at once. */
const PATIENCE_MS = 15_000;
/** A service answers in turn, a ping as well: while it works at something it is silent, though it is there. */
const ANSWER_PATIENCE_MS = 90_000;

/**
 * How long to wait before a try: doubling from 0.4 s to 10 s, less up to a fifth so that many pages
 * do not return at once.
 * @param {number} attempt  0 for the first try after a loss
 * @param {number} random  in [0, 1)
 * @returns {number} milliseconds
 */
export function pauseBefore(attempt, random) {
  return Math.min(LONGEST_PAUSE_MS, FIRST_PAUSE_MS * 2 ** attempt) * (1 - random / 5);
}

/** One session's stream, reopened as often as needed until `close`. */
export class Connection {
  /** @type {WebSocket | null} */ #socket = null;
  /** @type {any} */ #timer = null;
  /** @type {number | null} the last sequence number seen */ #sequence = null;
  /** The ids of what was sent over this socket and is not answered yet. @type {Set<string>} */ #unanswered = new Set();
  #attempt = 0;
  #closed = false;

  /** @param {string} session @param {Wiring} wiring */
  constructor(session, wiring) {
    this.session = session;
    this.wiring = {
      open: (/** @type {string} */ url) => new WebSocket(url),
      later: (/** @type {() => void} */ work, /** @type {number} */ delayMs) => setTimeout(work, delayMs),
      cancel: (/** @type {number} */ timer) => clearTimeout(timer),
      random: Math.random,
      ...wiring,
    };
  }

  /** Connect now; also cuts a pause between tries short. */
  async open() {
    if (this.#closed || this.#socket !== null) return;
    this.wiring.cancel(this.#timer);
    if (this.#attempt === 0) this.wiring.onPhase({ phase: "opening" });
    const presence = await this.wiring.find(this.session);
    if (this.#closed || this.#socket !== null) return;
    if (presence === "missing") return this.#end("missing");
    if (presence === "unreachable") return this.#retry();
    const socket = this.wiring.open(streamUrl(this.wiring.page, this.session, this.#sequence));
    this.#socket = socket;
    socket.binaryType = "arraybuffer";
    socket.onmessage = (event) => this.#receive(event.data);
    socket.onclose = () => this.#lose(socket);
    this.#listen(PATIENCE_MS);
  }

  /**
   * Send if connected.
   * @param {ClientMessage} message
   * @returns {boolean} whether it was sent
   */
  send(message) {
    if (this.#socket === null || this.#socket.readyState !== 1) return false;
    this.#socket.send(encode(message));
    if ("id" in message) this.#unanswered.add(message.id);
    return true;
  }

  /** End for good; nothing is reported afterwards. */
  close() {
    this.#closed = true;
    this.wiring.cancel(this.#timer);
    this.#drop();
  }

  /** @param {unknown} data */
  #receive(data) {
    if (data instanceof ArrayBuffer) {
      this.#listen(PING_AFTER_MS);
      return this.wiring.onPicture?.(data);
    }
    let message;
    try {
      message = decode(String(data));
    } catch (error) {
      if (!(error instanceof ProtocolError)) throw error;
      console.warn(error.message);
      return;
    }
    if (message.type === "result" || message.type === "problem") this.#unanswered.delete(String(message.id));
    this.#listen(PING_AFTER_MS);
    if (message.type === "hello") {
      this.#attempt = 0;
      this.wiring.onPhase({ phase: "live" });
    }
    if ("sequence" in message) this.#sequence = message.sequence;
    if (message.type === "gone") return this.#end("gone");
    this.wiring.onMessage(message);
  }

  /**
   * Expect to hear something; when nothing comes, ask once, then give the connection up.
   * @param {number} delayMs
   */
  #listen(delayMs) {
    this.wiring.cancel(this.#timer);
    const socket = this.#socket;
    this.#timer = this.wiring.later(() => {
      if (!this.send({ type: "ping" })) return this.#lose(socket);
      const patienceMs = this.#unanswered.size > 0 ? ANSWER_PATIENCE_MS : PATIENCE_MS;
      this.#timer = this.wiring.later(() => this.#lose(socket), patienceMs);
    }, delayMs);
  }

  /** @param {WebSocket | null} socket  the one that was lost; an older one's late news is ignored */
  #lose(socket) {
    if (this.#closed || socket === null || socket !== this.#socket) return;
    this.#drop();
    this.#retry();
  }

  #retry() {
    const retryMs = pauseBefore(this.#attempt, this.wiring.random());
    this.#attempt += 1;
    this.wiring.onPhase({ phase: "lost", retryMs });
    this.wiring.cancel(this.#timer);
    this.#timer = this.wiring.later(() => void this.open(), retryMs);
  }

  /** @param {"missing" | "gone"} phase */
  #end(phase) {
    this.close();
    this.wiring.onPhase({ phase });
  }

  #drop() {
    const socket = this.#socket;
    this.#socket = null;
    this.#unanswered.clear();
    if (socket === null) return;
    socket.onmessage = null;
    socket.onclose = null;
    socket.close();
  }
}
