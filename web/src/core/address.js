// @ts-check
/**
 * What the page's address says: `#/s/<session>`, perhaps `/<tick>`, or `#/r/…`, a session that the link carries whole, or `#/g/<name>`, a road of the gallery, or
 * `#/c/<session>/<planner>/<planner>`, perhaps `/<tick>`, two planners on a session's road.
 */

/**
 * What an address asks for.
 * @param {string} hash
 * @returns {{session: string, tick: number | null, race?: {planners: [string, string], tick: number | null}} | {carried: string} | {scenario: string} | null}
 */
export function placeInHash(hash) {
  if (/^#\/r\/[\w-]+$/.test(hash)) return { carried: hash };
  const scenario = /^#\/g\/(\w{1,40})$/.exec(hash);
  if (scenario !== null) return { scenario: scenario[1] };
  const race = /^#\/c\/([\w-]{1,64})\/([\w.:-]{1,64})\/([\w.:-]{1,64})(?:\/(\d{1,15}))?$/.exec(hash);
  if (race !== null) {
    const [, session, left, right, tick] = race;
    return { session, tick: null, race: { planners: [left, right], tick: tick === undefined ? null : Number(tick) } };
  }
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

/**
 * The address of two planners on a session's road.
 * @param {string} session
 * @param {[string, string]} planners
 * @param {number | null} tick  null: from where its episode began
 */
export function raceHash(session, [left, right], tick) {
  return `#/c/${session}/${left}/${right}${tick === null ? "" : `/${tick}`}`;
}
