// @ts-check
/** The six moves of a decision, in an order that stays, each with what was found of it. */

import { capital } from "../core/texts.js";
import { moveName, reasonWords } from "../core/words.js";
import { STEPS } from "./forecast.js";

/** @import { Cell, Decision, Move, Option } from "../core/protocol.js" */
/** @import { Way } from "../road/paint/plan.js" */

/** @typedef {Way & {reason: string, ids: string[]}} MoveOption */

const MOVES = /** @type {Move[]} */ (Object.keys(STEPS));

/**
 * @param {Decision} decision
 * @param {Cell} from  where it was taken
 * @returns {MoveOption[]}
 */
export function moveOptions(decision, from) {
  return MOVES.map((move) => {
    const [across, down] = STEPS[move];
    /** @type {Cell} */
    const cell = [from[0] + across, from[1] + down];
    const option = decision.options?.find((each) => each.move === move);
    const blocked = option ? (option.verdict === "free" ? null : option) : decision.blocked?.find((each) => each.move === move);
    const taken = decision.move === move;
    if (!blocked) return { move, cell, standing: taken ? "taken" : "free", reason: optionText(option ?? { reason: "free" }), ids: [] };
    const standing = taken ? "taken" : blocked.reason === "off_road" ? "off_road" : "blocked";
    return { move, cell, standing, reason: optionText(blocked), ids: blocked.causes ?? [] };
  });
}

/**
 * What spoke for or against a move: the service's words, or where the stream tells only a code, that in a word or two.
 * @param {{text?: string, reason: string, causes?: string[]}} option
 */
export function optionText({ text, reason, causes }) {
  return text ?? reasonWords(reason, causes);
}

/** A move with what spoke for or against it, as a line. @param {Option} option */
export function optionLine(option) {
  return `${capital(moveName(option.move))}: ${optionText(option)}`;
}
