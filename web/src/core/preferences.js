// @ts-check
/** What the reader has chosen, kept in the browser where that is allowed, and for this visit where it is not. */

const PREFIX = "roadtalk.";
/** @type {Map<string, string>} */
const here = new Map();

/** @param {string} name @param {string} [otherwise] @returns {string} */
export function preference(name, otherwise = "") {
  try {
    return here.get(name) ?? browserStorage()?.getItem(PREFIX + name) ?? otherwise;
  } catch {
    return otherwise;
  }
}

/** @param {string} name @param {string} value */
export function prefer(name, value) {
  here.set(name, value);
  try {
    browserStorage()?.setItem(PREFIX + name, value);
  } catch {
    // Full or forbidden: it holds for this visit.
  }
}

/**
 * The browser's storage, or null where reading it is forbidden.
 * @returns {Storage | null}
 */
export function browserStorage() {
  try {
    return window.localStorage;
  } catch {
    return null;
  }
}
