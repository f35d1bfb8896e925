// @ts-check
/** Which changes can be undone, so that undo can name the exact change. */

/**
 * @typedef {object} Steps
 * @property {(number | null)[]} done  the sequence of each change that undo would reach, the latest last; null for
 *   those from before this page came
 * @property {number[]} gone  sequences of changes that were there once and were taken back, the latest last
 */

const REMEMBERED = 300;

/** @type {Steps} */
export const NO_STEPS = { done: [], gone: [] };

/**
 * The steps after the session has told how many there are.
 * @param {Steps} steps
 * @param {number} undo  how many can be taken back now
 * @param {number | null} sequence  of the change that led here; null where it is not known
 * @returns {Steps}
 */
export function stepsAfter(steps, undo, sequence) {
  const { done, gone } = steps;
  if (undo === done.length) return steps;
  if (undo > done.length) return { done: [...done, ...Array(undo - done.length).fill(sequence)], gone };
  const taken = done.slice(undo).filter((each) => each !== null);
  return { done: done.slice(0, undo), gone: [...gone, ...taken].slice(-REMEMBERED) };
}

/**
 * How a change said here stands.
 * @param {Steps} steps
 * @param {number | undefined} sequence
 * @returns {{undos: number, taken: boolean}} how many undos take it back, 0 where none does; whether it was taken back
 */
export function standingOf({ done, gone }, sequence) {
  const at = sequence === undefined ? -1 : done.lastIndexOf(sequence);
  return { undos: at === -1 ? 0 : done.length - at, taken: at === -1 && gone.includes(sequence ?? -1) };
}
