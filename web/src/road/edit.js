// @ts-check
/** Placing, moving and taking away by hand: as typed actions, and what can be told before asking. */

import { hasText, t } from "../core/texts.js";
import { onRoad, same } from "./hitTest.js";

/** @import { Kind } from "../core/wire.js" */
/** @import { Action, Cell } from "../core/protocol.js" */
/** @import { World, Thing } from "./world.js" */

/** What can be put on the road, with its key. */
export const TOOLS = /** @type {{kind: Kind, key: string}[]} */ ([
  { kind: "pothole", key: "p" },
  { kind: "barrier", key: "b" },
  { kind: "vehicle", key: "v" },
  { kind: "pedestrian", key: "w" },
]);

/** @param {Kind} kind @param {Cell} cell @returns {Action[]} */
export function placing(kind, cell) {
  return [{ do: "add", kind, count: 1, where: { cell } }];
}

/** @param {{kind: Kind, id: string}} thing @returns {Action[]} */
export function removing({ kind, id }) {
  return [{ do: "remove", kind, count: 1, where: { id } }];
}

/** One utterance, so that one undo takes it back. @param {Thing} thing @param {Cell} cell @returns {Action[]} */
export function moving(thing, cell) {
  return [...removing(thing), ...placing(thing.kind, cell)];
}

/**
 * Why something of a kind cannot be put into a cell, or null; the service has the last word.
 * @param {World} world
 * @param {Kind} kind
 * @param {Cell} cell
 * @param {string} [moved]  the id of what is being moved, which is in nobody's way
 */
export function hindrance(world, kind, cell, moved) {
  if (!onRoad(world, cell)) return t("edit.off_road");
  for (const thing of world.things.values()) {
    if (thing.id === moved || !same(thing.cell, cell)) continue;
    // A pothole may open under one that moves, and holds it.
    if (kind === "pothole" && thing.heading !== null && !thing.disabled) continue;
    return t(hasText(`edit.taken.${thing.kind}`) ? `edit.taken.${thing.kind}` : "edit.taken.any");
  }
  return null;
}

/** Whether a thing can be taken hold of. @param {Thing | null} thing @returns {thing is Thing} */
export function isLoose(thing) {
  return thing !== null && thing.kind !== "av";
}
