// @ts-check
/** What an answer points at on the road and the plan while it is read: its causes, what blocked, and the chain. */

/** @import { Answer } from "../core/protocol.js" */
/** @import { Highlight } from "../core/state.js" */

/** @param {Answer | null | undefined} answer @returns {Highlight | null} */
export function shownBy(answer) {
  if (!answer) return null;
  const causes = answer.causes ?? [];
  const ids = answer.shown?.ids ?? causes.map(({ id }) => id);
  const cells = answer.shown?.cells ?? causes.flatMap(({ cell }) => (cell ? [cell] : []));
  return ids.length === 0 && cells.length === 0 ? null : { ids, cells };
}
