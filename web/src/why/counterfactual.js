// @ts-check
/** What would have been, from the service: two runs from one tick on, as worlds to be shown in step. */

import { moveName } from "../road/hitTest.js";
import { askJson } from "../core/http.js";
import { sessionPath } from "../core/protocol.js";
import { counted } from "../core/words.js";
import { worldAfter, worldOf } from "../road/world.js";

/** @import { Otherwise } from "./alternatives.js" */
/** @import { Decision, Move, WireState, TickMessage } from "../core/protocol.js" */
/** @import { World } from "../road/world.js" */

/** @typedef {{world: World, decision: Decision | null}} Frame  a world, and the decision that led to it */
/** @typedef {{outcome: string, tick: number, driven: number, by_hand: boolean, cause: {kind: string, ids: string[]} | null}} End */
/** @typedef {{frames: Frame[], end: End}} Side */

/**
 * @typedef {object} Beside
 * @property {number} tick
 * @property {Move | null} insteadOf  the move that was made, where another is asked about
 * @property {number} saidSince
 * @property {Side} real
 * @property {Side} changed
 */

/**
 * Both runs. Throws an `Error` whose message a person can read.
 * @param {string} session
 * @param {Otherwise} other
 * @param {typeof fetch} [http]
 * @returns {Promise<Beside>}
 */
export async function fetchBeside(session, other, http) {
  const what = other.kind === "move" ? { move: other.move } : { actions: other.actions };
  const body = other.tick === null ? what : { ...what, at_tick: other.tick };
  const told = await askJson(`${sessionPath(session)}/counterfactual`, { method: "POST", body, http });
  return {
    tick: told.at_tick,
    insteadOf: told.instead_of,
    saidSince: told.said_since,
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
 * How a run ends, in a few words.
 * @param {End} end
 */
export function endWords({ outcome, driven, tick, cause, by_hand }) {
  const ticks = counted(driven, "tick");
  if (outcome === "success") return `arrives after ${ticks}`;
  if (outcome === "crash") return `crashes ${cause ? `into a ${cause.kind} ` : ""}at tick ${tick}`;
  if (by_hand) return "waits for you to drive";
  return outcome === "stuck" ? `is stuck after ${ticks}` : "goes on too long to tell";
}

/**
 * What is otherwise, as the beginning of a sentence.
 * @param {Otherwise} other
 * @param {Beside} found
 */
export function titleOf(other, found) {
  if (other.kind === "change") return other.label;
  const went = other.move === "stay" ? "waited" : `gone ${moveName(other.move)}`;
  return `If it had ${went} at tick ${found.tick}`;
}

/**
 * What the difference comes to, in a sentence or two; `ends` stand over the two roads as well.
 * @param {Beside} found
 * @returns {{text: string, ends: string}}
 */
export function sumOf(found) {
  const { real, changed, saidSince } = found;
  const part = partOf(found);
  const told = [];
  if (part === null) told.push("It is driven the same way.");
  else told.push(`At tick ${part.tick} it ${does(part.changed)} instead of ${doing(part.real)}.`);
  if (real.end.outcome === "success" && changed.end.outcome === "success") {
    const later = changed.end.driven - real.end.driven;
    const ticks = counted(Math.abs(later), "tick");
    told.push(later === 0 ? "It arrives at the same tick." : `It arrives ${ticks} ${later > 0 ? "later" : "earlier"}.`);
  }
  if (saidSince > 0) told.push("What was said after that tick is left out of both.");
  return { text: told.join(" "), ends: `It ${endWords(changed.end)}; in the real run it ${endWords(real.end)}.` };
}

/** @param {Move} move */
const does = (move) => (move === "stay" ? "waits" : `goes ${moveName(move)}`);

/** @param {Move} move */
const doing = (move) => (move === "stay" ? "waiting" : `going ${moveName(move)}`);

/** The short name of the other run. @param {Otherwise} other */
export function nameOfOther(other) {
  return other.kind === "change" ? "Otherwise" : `If ${other.move === "stay" ? "it waits" : moveName(other.move)}`;
}

/**
 * The first tick at which the two are driven differently; null where they never are.
 * @param {Beside} found
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
