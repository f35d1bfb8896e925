// @ts-check
/** Chance that is the same every time: a thing's look is drawn from its id, not from the clock. */

/**
 * A 32-bit hash of a name (FNV-1a).
 * @param {string} name
 */
export function hash(name) {
  let value = 0x811c9dc5;
  for (let at = 0; at < name.length; at++) {
    value = Math.imul(value ^ name.charCodeAt(at), 0x01000193);
  }
  return value >>> 0;
}

/**
 * A stream of numbers in [0, 1) that depends on the name alone (mulberry32).
 * @param {string} name
 * @returns {() => number}
 */
export function seeded(name) {
  let state = hash(name);
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 4294967296;
  };
}
