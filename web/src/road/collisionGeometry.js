// @ts-check
/**
 * How large things are on the road, and when two of them first touch within a tick.
 *
 * The numbers are those of the rules (`sim/rules/collision_geometry.py`), of which a test holds these to be a copy; so is every
 * contact. A leaf: painters and motion read it.
 */

/** @typedef {{across: number, along: number}} Size  in cells */
/** @typedef {{kind: string, from: [number, number], to: [number, number]}} Path  through one tick, in cells */
/** @typedef {[left: number, top: number, right: number, bottom: number]} Box  whole numbers are centres of cells */

/** @type {Readonly<Record<string, Size>>} */
export const SIZES = {
  av: { across: 0.32, along: 0.66 },
  vehicle: { across: 0.66, along: 0.32 },
  pedestrian: { across: 0.3, along: 0.32 },
  barrier: { across: 0.66, along: 0.3 },
  pothole: { across: 0.5, along: 0.5 },
};
/** Of a kind this page does not know yet. */
const UNKNOWN = { across: 0.6, along: 0.6 };

/** @param {string} kind */
export function sizeOf(kind) {
  return SIZES[kind] ?? UNKNOWN;
}

/**
 * What of the road a body covers.
 * @param {string} kind
 * @param {[number, number]} centre
 * @returns {Box}
 */
export function boxOf(kind, [column, row]) {
  const { across, along } = sizeOf(kind);
  return [column - across / 2, row - along / 2, column + across / 2, row + along / 2];
}

/**
 * The share of the tick's way, 0–1, at which two bodies first touch; null if they never overlap. Both go in straight
 * lines by the same share at the same time, so one box sweeps past the other along each axis.
 * @param {Path} one
 * @param {Path} other
 * @returns {number | null}
 */
export function firstContact(one, other) {
  const [a, b] = [sizeOf(one.kind), sizeOf(other.kind)];
  const reaches = [(a.across + b.across) / 2, (a.along + b.along) / 2];
  let [enter, leave] = [0, 1];
  for (const [axis, reach] of reaches.entries()) {
    const apart = other.from[axis] - one.from[axis];
    const speed = other.to[axis] - other.from[axis] - (one.to[axis] - one.from[axis]);
    if (speed === 0) {
      if (Math.abs(apart) >= reach) return null;
      continue;
    }
    const times = [(-reach - apart) / speed, (reach - apart) / speed];
    enter = Math.max(enter, Math.min(...times));
    leave = Math.min(leave, Math.max(...times));
  }
  return enter < leave ? enter : null;
}

/**
 * The middle of what two boxes that touch have in common.
 * @param {Box} one
 * @param {Box} other
 * @returns {[number, number]}
 */
export function meeting(one, other) {
  const middle = (/** @type {0 | 1} */ axis) =>
    (Math.max(one[axis], other[axis]) + Math.min(one[axis + 2], other[axis + 2])) / 2;
  return [middle(0), middle(1)];
}
