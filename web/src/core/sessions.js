// @ts-check
/** Opening and finding sessions over HTTP. Everything after that goes over the stream (`socket.js`). */

import { ask, askJson, Refused } from "./http.js";
import { SESSIONS_PATH, sessionPath } from "./protocol.js";
import { LANGUAGE } from "./texts.js";

/** @import { Session } from "./protocol.js" */

/** Answers by which the service says that there is no such session. */
const MISSING = new Set([404, 410, 422]);

/** @typedef {"here" | "missing" | "unreachable"} Presence */

/**
 * A new session with everything at its default, told in the page's language where the service speaks it.
 * @param {typeof fetch} [http]
 * @param {string} [language]
 * @returns {Promise<Session>} throws `Refused`
 */
export async function createSession(http, language = LANGUAGE) {
  if (language === "en") return askJson(SESSIONS_PATH, { method: "POST", body: {}, http });
  try {
    return await askJson(SESSIONS_PATH, { method: "POST", body: { language }, http });
  } catch (error) {
    if (error instanceof Refused && error.status === 422) return createSession(http, "en");
    throw error;
  }
}

/**
 * A new session on a certain road. Throws `Refused`.
 * @param {{seed: number, config: Record<string, unknown>}} road
 * @param {typeof fetch} [http]
 * @returns {Promise<Session>}
 */
export function createScenario({ seed, config }, http) {
  return askJson(SESSIONS_PATH, { method: "POST", body: { seed, config, ...(LANGUAGE === "en" ? {} : { language: LANGUAGE }) }, http });
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
