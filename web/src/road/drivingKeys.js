// @ts-check
/** Driving by hand: which keys are which move. Two arrows held together are a diagonal. */

/** @import { Move } from "../core/protocol.js" */

/** How long a second arrow is waited for, so that ↑ and ← are one move. */
export const TOGETHER_MS = 70;

const ALONE = /** @type {Record<string, Move>} */ ({
  7: "forward_left",
  Home: "forward_left",
  8: "forward",
  9: "forward_right",
  PageUp: "forward_right",
  4: "left",
  6: "right",
  5: "stay",
  Clear: "stay",
  s: "stay",
  ".": "stay",
});

const ARROWS = /** @type {Record<string, Move>} */ ({
  ArrowUp: "forward",
  ArrowLeft: "left",
  ArrowRight: "right",
  ArrowDown: "stay",
});

/** Whether a key drives. @param {string} key */
export function isDriving(key) {
  return Object.hasOwn(ALONE, key) || isArrow(key);
}

/** @param {string} key */
export function isArrow(key) {
  return Object.hasOwn(ARROWS, key);
}

/**
 * The move that keys held together ask for; null for none, or for left and right at once.
 * @param {Iterable<string>} keys
 * @returns {Move | null}
 */
export function moveOf(keys) {
  const held = new Set(keys);
  for (const key of held) if (Object.hasOwn(ALONE, key)) return ALONE[key];
  const sideways = held.has("ArrowLeft") !== held.has("ArrowRight") && (held.has("ArrowLeft") ? "left" : "right");
  if (held.has("ArrowLeft") && held.has("ArrowRight")) return null;
  if (sideways) return held.has("ArrowUp") ? `forward_${sideways}` : sideways;
  if (held.has("ArrowUp")) return "forward";
  return held.has("ArrowDown") ? "stay" : null;
}
