// @ts-check
/** Opening and finding sessions over HTTP. Everything after that goes over the stream (`socket.js`). */

import { SESSIONS_PATH, sessionPath } from "./protocol.js";

/** @import { Session } from "./protocol.js" */

/** @typedef {"here" | "missing" | "unreachable"} Presence */

/**
 * A new session with everything at its default. Throws an `Error` whose message a person can read.
 * @param {typeof fetch} [http]
 * @returns {Promise<Session>}
 */
export async function createSession(http = fetch) {
  let response;
  try {
    response = await http(SESSIONS_PATH, {
      method: "POST",
      headers: { "content-type": "application/json" },
      body: "{}",
    });
  } catch {
    throw new Error("The service cannot be reached.");
  }
  if (!response.ok) {
    const problem = await response.json().catch(() => null);
    throw new Error(problem?.detail ?? `The service answered ${response.status}.`);
  }
  return response.json();
}

/**
 * Whether a session exists. A service that fails counts as unreachable: only a plain "no" is a no.
 * @param {string} id
 * @param {typeof fetch} [http]
 * @returns {Promise<Presence>}
 */
export async function findSession(id, http = fetch) {
  try {
    const response = await http(sessionPath(id));
    if (response.ok) return "here";
    return response.status === 404 || response.status === 410 || response.status === 422
      ? "missing"
      : "unreachable";
  } catch {
    return "unreachable";
  }
}

/**
 * The session a page's address names: `#/s/<id>`, perhaps with a tick.
 * @param {string} hash
 * @returns {string | null}
 */
export function sessionInHash(hash) {
  const match = /^#\/s\/([^/?#]+)(?:\/\d{1,15})?$/.exec(hash);
  if (match === null) return null;
  try {
    return decodeURIComponent(match[1]);
  } catch {
    return null;
  }
}

/** @param {string} id @returns {string} */
export function hashOfSession(id) {
  return `#/s/${encodeURIComponent(id)}`;
}
