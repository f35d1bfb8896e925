// @ts-check
/** What a person answered in a quiz: scores before and after, scales, and the file of it, as `service/quiz/result.py` writes it. */

/** @typedef {{id: string, text: string}} Choice */
/** @typedef {"before" | "explained" | "after"} Phase */
/** @typedef {{phase: Phase, picture: string[], reasons: Choice[], right: {move: string, reason: string}, explanation: string}} Situation */
/**
 * @typedef {object} Quiz  what the service answers to "quiz me"
 * @property {number} version
 * @property {string} planner
 * @property {number} seed
 * @property {string} signs
 * @property {Record<Phase, string>} phases
 * @property {Choice[]} moves
 * @property {Situation[]} situations
 * @property {Record<"satisfaction" | "trust", (Choice & {reversed: boolean})[]>} scales
 * @property {{least: number, most: number}} scale
 */
/** @typedef {{situation: Situation, move: string, reason: string}} Given */
/** @typedef {Record<string, Record<string, number>>} Rated  by scale and item */

/** Shares of a phase that were right. @param {Given[]} given @param {Phase} phase */
export function scoreOf(given, phase) {
  const own = given.filter(({ situation }) => situation.phase === phase);
  const moves = own.filter(isMoveRight).length;
  const reasons = own.filter(isReasonRight).length;
  const both = own.filter((each) => isMoveRight(each) && isReasonRight(each)).length;
  const count = Math.max(1, own.length);
  return { count: own.length, moves: moves / count, reasons: reasons / count, both: both / count };
}

/** Mean of a scale, reversed items turned round; null where nothing was answered. @param {Quiz} quiz @param {"satisfaction" | "trust"} scale @param {Rated} rated */
export function scaleMean({ scales, scale: { least, most } }, scale, rated) {
  const said = scales[scale].filter(({ id }) => rated[scale]?.[id] !== undefined);
  if (said.length === 0) return null;
  const sum = said.reduce((all, { id, reversed }) => all + (reversed ? least + most - rated[scale][id] : rated[scale][id]), 0);
  return sum / said.length;
}

/** The result as a file's text. @param {Quiz} quiz @param {Given[]} given @param {Rated} rated @param {string} language */
export function resultText(quiz, given, rated, language) {
  const [before, after] = [scoreOf(given, "before"), scoreOf(given, "after")];
  const gain = { moves: after.moves - before.moves, reasons: after.reasons - before.reasons };
  const scales = Object.fromEntries(
    (/** @type {const} */ (["satisfaction", "trust"])).map((name) => [name, { mean: scaleMean(quiz, name, rated), items: rated[name] ?? {} }]),
  );
  const answers = given.map((each, at) => ({
    phase: each.situation.phase,
    number: at + 1,
    move: each.situation.right.move,
    said_move: each.move,
    move_right: isMoveRight(each),
    reason: each.situation.right.reason,
    said_reason: each.reason,
    reason_right: isReasonRight(each),
  }));
  const { version, planner, seed } = quiz;
  return `${JSON.stringify({ version, planner, seed, language, scores: { before, after, gain }, scales, answers }, null, 2)}\n`;
}

/** @param {Given} given */
function isMoveRight({ situation, move }) {
  return move === situation.right.move;
}

/** @param {Given} given */
function isReasonRight({ situation, reason }) {
  return reason === situation.right.reason;
}
