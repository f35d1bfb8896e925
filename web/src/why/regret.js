// @ts-check
/**
 * For each decision: how many moves were blocked (from the stream), and how many ticks it lost against the best (from
 * the service, which has to search for it: `regretLoader.js`). Part of the state.
 */

/** @import { ServerMessage } from "../core/protocol.js" */
/** @import { Judged as JudgedPage } from "../core/wire.js" */
/** @import { State } from "../core/state.js" */

/**
 * @typedef {object} Judged
 * @property {number} blocked  of the six moves
 * @property {number | null} [ticks]  lost; null where the goal is out of reach; not there while it is not known
 * @property {boolean} [lost]  whether this move has put the goal out of reach
 */

/**
 * @typedef {object} Regret
 * @property {ReadonlyMap<number, Judged | null>} items  by tick; null where no decision was taken
 * @property {number} age  raised when the run becomes another
 * @property {string | null} trouble  why the latest question was not answered
 */

/**
 * What comes of a question, asked at an age from a tick on.
 * @typedef {{type: "regret", age: number, from: number, items: JudgedPage["items"], now: number}
 *   | {type: "regret-trouble", text: string}} RegretEvent
 */

/** How many ticks are looked back over, and asked for at once. */
export const WINDOW = 60;
const KEPT = 1_000;

/** @type {Regret} */
export const NO_REGRET = { items: new Map(), age: 0, trouble: null };

/**
 * The regret after an event that has carried the state on.
 * @param {Regret} regret
 * @param {ServerMessage | RegretEvent} event
 * @param {State} state
 * @param {State} before
 * @returns {Regret}
 */
export function regretAfter(regret, event, state, before) {
  if (event.type === "regret") return event.age === regret.age ? afterAnswer(regret, event) : regret;
  if (event.type === "regret-trouble") return { ...regret, trouble: event.text };
  if (rewritten(state, before)) return { ...NO_REGRET, age: regret.age + 1 };
  if (event.type !== "tick" || before.world === null || event.decision?.tick !== event.tick - 1) return regret;
  return note(regret, event.decision.tick, event.decision.blocked?.length);
}

/** Whether the run has become another. @param {State} state @param {State} before */
function rewritten({ world, prior, steps }, { world: old, steps: earlier }) {
  return world !== null && old !== null && world !== old && prior === null && (world.tick < old.tick || steps !== earlier);
}

/** What a tick's message tells. @param {Regret} regret @param {number} tick @param {number | undefined} blocked @returns {Regret} */
function note(regret, tick, blocked) {
  if (regret.items.has(tick)) return regret;
  const items = new Map(regret.items).set(tick, blocked === undefined ? null : { blocked });
  if (items.size > KEPT) items.delete(/** @type {number} */ (items.keys().next().value));
  return { ...regret, items };
}

/** @param {Regret} regret @param {RegretEvent & {type: "regret"}} answer @returns {Regret} */
function afterAnswer(regret, { from, items: judged, now }) {
  const told = new Map(judged.map((item) => [item.tick, item]));
  const items = new Map(regret.items);
  for (let tick = from; tick < Math.min(from + WINDOW, now); tick++) items.set(tick, told.get(tick) ?? null);
  return { ...regret, items, trouble: null };
}

/** How many of the worst moments are told. */
const WORST = 5;

/**
 * The moments of the run, as far as it is known, in which most was lost, the worst first; of equal ones the tightest.
 * @param {Regret} regret
 * @returns {{tick: number, item: Judged}[]}
 */
export function worstMoments({ items }) {
  const weight = (/** @type {Judged} */ { lost, ticks, blocked }) => (lost ? 1_000 : 0) + 10 * (ticks ?? 0) + blocked;
  const all = [...items].flatMap(([tick, item]) => (item && (item.lost || (item.ticks ?? 0) > 0) ? [{ tick, item }] : []));
  return all.sort((a, b) => weight(b.item) - weight(a.item) || a.tick - b.tick).slice(0, WORST);
}

/** The first tick before `tick` whose loss is not known; null where all are. @param {Regret} regret @param {number} tick */
export function missingFrom({ items }, tick) {
  for (let each = Math.max(0, tick - WINDOW); each < tick; each++) {
    const item = items.get(each);
    if (item === undefined || (item !== null && item.ticks === undefined)) return each;
  }
  return null;
}

/**
 * What was lost in the ticks before `tick`, as far as it is known.
 * @param {Regret} regret
 * @param {number} tick
 */
export function sumOf({ items }, tick) {
  let [ticks, known, lost] = [0, 0, false];
  for (let each = Math.max(0, tick - WINDOW); each < tick; each++) {
    const item = items.get(each);
    if (!item || item.ticks === undefined) continue;
    known += 1;
    ticks += item.ticks ?? 0;
    lost ||= item.lost === true;
  }
  return { ticks, known, lost };
}
