// @ts-check
/** What the page's address says: `#/s/<session>`, perhaps `/<tick>`, or `#/r/…`, a session that the link carries whole, or `#/g/<name>`, a road of the gallery. */

/**
 * What an address asks for.
 * @param {string} hash
 * @returns {{session: string, tick: number | null} | {carried: string} | {scenario: string} | null}
 */
export function placeInHash(hash) {
  if (/^#\/r\/[\w-]+$/.test(hash)) return { carried: hash };
  const scenario = /^#\/g\/(\w{1,40})$/.exec(hash);
  if (scenario !== null) return { scenario: scenario[1] };
  const match = /^#\/s\/([^/?#]+)(?:\/(\d{1,15}))?$/.exec(hash);
  if (match === null) return null;
  try {
    return { session: decodeURIComponent(match[1]), tick: match[2] === undefined ? null : Number(match[2]) };
  } catch {
    return null;
  }
}

/**
 * The session and tick that an address names, if it names them.
 * @param {string} hash
 */
export function momentInHash(hash) {
  const place = placeInHash(hash);
  return place !== null && "session" in place ? place : null;
}

/**
 * @param {string} session
 * @param {number | null} [tick]  null: the present
 */
export function hashOf(session, tick = null) {
  return `#/s/${encodeURIComponent(session)}${tick === null ? "" : `/${tick}`}`;
}
