// @ts-check
/** The moves that wait to be made where a person drives, as changes and ticks tell of them. */

/**
 * @param {string[]} queue
 * @param {{path: string, after: unknown}[]} changes
 * @returns {string[]}
 */
export function queueAfter(queue, changes) {
  const told = changes.find(({ path }) => path === "queue")?.after;
  if (Array.isArray(told)) return told.map(String);
  return changes.some(({ path }) => path === "tick") ? [] : queue;
}
