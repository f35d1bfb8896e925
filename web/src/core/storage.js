// @ts-check
/** Where the page keeps things between visits, if it may: what was said, what was chosen, what was forked. */

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
