// @ts-check
/** Opening and finding sessions over HTTP. Everything after that goes over the stream (`socket.js`). */

import { ask, askJson, Refused } from "./http.js";
import { SESSIONS_PATH, sessionPath } from "./protocol.js";

/** @import { Session } from "./protocol.js" */

/** Answers by which the service says that there is no such session. */
const MISSING = new Set([404, 410, 422]);

/** @typedef {"here" | "missing" | "unreachable"} Presence */

/**
 * A new session with everything at its default.
 * @param {typeof fetch} [http]
 * @returns {Promise<Session>} throws `Refused`
 */
export function createSession(http) {
  return askJson(SESSIONS_PATH, { method: "POST", body: {}, http });
}

/**
 * Whether a session exists. A service that fails counts as unreachable: only a plain "no" is a no.
 * @param {string} id
 * @param {typeof fetch} [http]
 * @returns {Promise<Presence>}
 */
export async function findSession(id, http) {
  try {
    await ask(sessionPath(id), { http });
    return "here";
  } catch (error) {
    return error instanceof Refused && MISSING.has(error.status) ? "missing" : "unreachable";
  }
}

/**
 * A session out of a link that carries it. Throws `Refused`.
 * @param {string} carried
 * @param {typeof fetch} [http]
 * @returns {Promise<Session>}
 */
export function openLink(carried, http) {
  return askJson(SESSIONS_PATH, { method: "POST", body: { link: carried }, http });
}
