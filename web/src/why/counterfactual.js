// @ts-check
/** What would have been, from the service: two runs from one tick on, as worlds to be shown in step. */

import { askJson } from "../core/http.js";
import { sessionPath } from "../core/protocol.js";
import { t } from "../core/texts.js";
import { moveName, plannerName } from "../core/words.js";
import { worldAfter, worldOf } from "../road/world.js";

/** @import { Hypothesis } from "./alternatives.js" */
/** @import { Decision, Move, WireState, TickMessage } from "../core/protocol.js" */
/** @import { Parting } from "../core/wire.js" */
/** @import { World } from "../road/world.js" */

/** @typedef {{world: World, decision: Decision | null}} Frame  a world, and the decision that led to it */
/** @typedef {{outcome: string, tick: number, driven: number, by_hand: boolean, cause: {kind: string, ids: string[]} | null, text: string}} End  `text`: in a few words */
/** @typedef {{frames: Frame[], end: End}} Side */

/**
 * @typedef {object} Comparison
 * @property {number} tick
 * @property {Move | null} insteadOf  the move that was made, where another is asked about
 * @property {string} text  what differs, in a sentence or two
 * @property {number} saidSince
 * @property {Parting | null} parting  where they first decide differently, and why
 * @property {Side} real
 * @property {Side} changed
 */

/**
 * Both runs. Throws an `Error` whose message a person can read.
 * @param {string} session
 * @param {Hypothesis} other
 * @param {typeof fetch} [http]
 * @returns {Promise<Comparison>}
 */
export async function fetchComparison(session, other, http) {
  const what = other.kind === "move" ? { move: other.move } : other.kind === "change" ? { actions: other.actions } : { planners: other.planners };
  const body = other.tick === null ? what : { ...what, at_tick: other.tick };
  const told = await askJson(`${sessionPath(session)}/counterfactual`, { method: "POST", body, http });
  return {
    tick: told.at_tick,
    insteadOf: told.instead_of,
    text: told.text,
    saidSince: told.said_since,
    parting: told.parting ?? null,
    real: { frames: framesOf(told.real), end: told.real.end },
    changed: { frames: framesOf(told.changed), end: told.changed.end },
  };
}

/** @param {{state: WireState, ticks: any[]}} side @returns {Frame[]} */
function framesOf({ state, ticks }) {
  let world = { ...worldOf(state), paused: false };
  /** @type {Frame[]} */
  const frames = [{ world, decision: null }];
  for (const tick of ticks) {
    const { cause, decision } = tick;
    const events = cause ? [{ type: "crashed", ids: cause.ids, cell: cause.cell }] : [];
    const message = /** @type {TickMessage} */ ({ ...tick, metrics: world.metrics, events });
    world = { ...worldAfter(world, message), paused: false };
    frames.push({ world, decision });
  }
  return frames;
}

/**
 * What is otherwise, as a title.
 * @param {Hypothesis} other
 * @param {number | null} [tick]  from which on, where that is known
 */
export function titleOf(other, tick = null) {
  if (other.kind === "change") return other.label;
  if (other.kind === "planners") return tick === null ? t("planner_race.title") : t("planner_race.title_at", { tick });
  const move = moveName(other.move);
  return tick === null ? t("counterfactual.instead", { move }) : t("counterfactual.instead_at", { move, tick });
}

/** The short name of the other run. @param {Hypothesis} other */
export function nameOfOther(other) {
  if (other.kind === "planners") return plannerName(other.planners[1]);
  return other.kind === "change" ? t("counterfactual.changed") : t("counterfactual.move", { move: moveName(other.move) });
}

/** The short name of the first run. @param {Hypothesis | null} other */
export function nameOfReal(other) {
  return other?.kind === "planners" ? plannerName(other.planners[0]) : t("counterfactual.real");
}

/**
 * The first tick at which the two are driven differently; null where they never are.
 * @param {Comparison} found
 * @returns {{at: number, tick: number, real: Move, changed: Move} | null}
 */
export function partOf({ real, changed }) {
  const most = Math.min(real.frames.length, changed.frames.length);
  for (let at = 1; at < most; at++) {
    const [one, other] = [real.frames[at].decision, changed.frames[at].decision];
    if (one && other && one.move !== other.move) return { at, tick: one.tick, real: one.move, changed: other.move };
  }
  return null;
}
