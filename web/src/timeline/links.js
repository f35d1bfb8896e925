// @ts-check
/** Addresses that carry a moment, sessions made from them, and which session was forked from which. */

import { askJson } from "../core/http.js";
import { SESSIONS_PATH, sessionPath } from "../core/protocol.js";

/** @import { Session } from "../core/protocol.js" */

/** @typedef {{child: string, parent: string, tick: number}} Fork */

const KEY = "roadtalk.forks";
const KEPT = 200;

/**
 * What a page's address asks for: a session, perhaps at a tick, or one that is carried whole.
 * @param {string} hash
 * @returns {{session: string, tick: number | null} | {carried: string} | null}
 */
export function placeInHash(hash) {
  if (/^#\/r\/[\w-]+$/.test(hash)) return { carried: hash };
  const match = /^#\/s\/([^/?#]+)(?:\/(\d{1,15}))?$/.exec(hash);
  if (match === null) return null;
  try {
    return { session: decodeURIComponent(match[1]), tick: match[2] === undefined ? null : Number(match[2]) };
  } catch {
    return null;
  }
}

/**
 * @param {string} session
 * @param {number | null} [tick]  null: the present
 */
export function hashOf(session, tick = null) {
  return `#/s/${encodeURIComponent(session)}${tick === null ? "" : `/${tick}`}`;
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

/** @typedef {Pick<Storage, "getItem" | "setItem">} Store */

/** @param {Store | null} storage @returns {Fork[]} */
export function forks(storage) {
  try {
    const kept = JSON.parse(storage?.getItem(KEY) ?? "[]");
    return Array.isArray(kept) ? kept : [];
  } catch {
    return [];
  }
}

/** @param {Store | null} storage @param {Fork} fork */
export function noteFork(storage, fork) {
  try {
    storage?.setItem(KEY, JSON.stringify([...forks(storage), fork].slice(-KEPT)));
  } catch {
    // Full or forbidden: the way back is then only the browser's own.
  }
}
