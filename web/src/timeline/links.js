// @ts-check
/** Addresses that carry a moment, sessions made from them, and which session was forked from which. */

import { askJson } from "../core/http.js";
import { SESSIONS_PATH, sessionPath } from "../core/protocol.js";

/** @import { Session } from "../core/protocol.js" */

/** @typedef {{child: string, parent: string, tick: number}} Fork */

const KEY = "roadtalk.forks";
const KEPT = 200;

/**
 * A session out of a recording. Throws `Refused`.
 * @param {unknown} recording
 * @param {typeof fetch} [http]
 * @returns {Promise<Session>}
 */
export function openRecording(recording, http) {
  return askJson(SESSIONS_PATH, { method: "POST", body: { recording }, http });
}

/**
 * The address of a moment, to be given to others.
 * @param {URL | Location} page
 * @param {string} session
 * @param {number | null} tick
 * @param {typeof fetch} [http]
 * @returns {Promise<{url: string, tick: number, carries: boolean}>}
 */
export async function shareLink(page, session, tick, http) {
  const query = tick === null ? "" : `?tick=${tick}`;
  const { link, carries, tick: at } = await askJson(`${sessionPath(session)}/link${query}`, { http });
  return { url: `${page.origin}${page.pathname}${link}`, tick: at, carries };
}

/**
 * Another session that goes on from a tick.
 * @param {string} session
 * @param {number | null} tick
 * @param {boolean | undefined} paused
 * @param {typeof fetch} [http]
 * @returns {Promise<Session & {tick: number}>}
 */
export function forkAt(session, tick, paused, http) {
  const body = { ...(tick === null ? {} : { at_tick: tick }), ...(paused === undefined ? {} : { paused }) };
  return askJson(`${sessionPath(session)}/forks`, { method: "POST", body, http });
}

/** @typedef {Pick<Storage, "getItem" | "setItem">} KeptStorage */

/** @param {KeptStorage | null} storage @returns {Fork[]} */
export function forks(storage) {
  try {
    const kept = JSON.parse(storage?.getItem(KEY) ?? "[]");
    return Array.isArray(kept) ? kept : [];
  } catch {
    return [];
  }
}

/** @param {KeptStorage | null} storage @param {Fork} fork */
export function noteFork(storage, fork) {
  try {
    storage?.setItem(KEY, JSON.stringify([...forks(storage), fork].slice(-KEPT)));
  } catch {
    // Full or forbidden: the way back is then only the browser's own.
  }
}
