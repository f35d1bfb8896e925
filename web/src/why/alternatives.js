// @ts-check
/** What may be imagined otherwise, with a title; and past decisions with all that spoke for and against them. */

import { askJson } from "../core/http.js";
import { sessionPath } from "../core/protocol.js";
import { listText, nameText, t } from "../core/texts.js";

/** @import { Action, Decision, Move } from "../core/protocol.js" */

/**
 * @typedef {{kind: "move", tick: number, move: Move}
 *   | {kind: "change", tick: number | null, actions: Action[], label: string}
 *   | {kind: "planners", tick: number | null, planners: [string, string]}} Hypothesis  another move at a tick, other actions from a tick on, or two planners
 */

/**
 * A decision with its whole trace.
 * @param {string} session
 * @param {number} tick
 * @param {AbortSignal} [signal]
 * @param {typeof fetch} [http]
 * @returns {Promise<Decision>}
 */
export function fetchDecision(session, tick, signal, http) {
  return askJson(`${sessionPath(session)}/decisions/${tick}`, { signal, http });
}

/**
 * A change as a title: "Without the pothole"; of several of a kind by their ids.
 * @param {Action[]} actions
 */
export function labelOf(actions) {
  const ids = actions.map((action) => (action.do === "remove" ? /** @type {{id?: string}} */ (action.where)?.id : undefined));
  if (ids.every((id) => id !== undefined)) {
    const names = new Set(ids.map((id) => nameText("the", id.split("-")[0])));
    return t("counterfactual.without", { things: listText(names.size < ids.length ? ids : names) });
  }
  const [action] = actions;
  if (actions.length > 1 || action.do !== "remove" || action.count !== "all") return t("counterfactual.with_change");
  const { kind } = action;
  return kind === "everything" ? t("counterfactual.empty_road") : t("counterfactual.without", { things: nameText("plurals", kind) });
}
