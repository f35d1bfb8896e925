// @ts-check
/** What a driver would call things and cells: "a car", "lane 3, 2 rows ahead". */

import { nameText, t } from "../core/texts.js";
import { thingIn } from "./hitTest.js";
import { egoOf } from "./world.js";

/** @import { Cell } from "../core/protocol.js" */
/** @import { World, Thing } from "./world.js" */

/** A thing with its article: "a car". @param {{kind: string}} thing */
export function nameOf({ kind }) {
  return nameText("kinds", kind);
}

/** A kind of things, as a heading or on a button: "Car". @param {{kind: string}} thing */
export function nounOf({ kind }) {
  return nameText("nouns", kind);
}

/** A thing as the one that is meant: "the barrier", among others of its kind with its place. @param {World} world @param {Thing} thing */
export function calledOf(world, { kind, cell }) {
  const name = nameText("the", kind);
  const others = [...world.things.values()].filter((each) => each.kind === kind).length > 1;
  return others ? t("place.called", { name, place: placeWords(world, cell) }) : name;
}

/**
 * Where a cell is, as one says it in the car.
 * @param {World} world
 * @param {Cell} cell
 */
export function placeWords(world, cell) {
  const lane = cell[0] + 1;
  const ego = egoOf(world);
  if (!ego) return t("place.row", { lane, row: cell[1] });
  const across = cell[0] - ego.cell[0];
  const ahead = ego.cell[1] - cell[1];
  if (across === 0 && ahead === 0) return t("place.here", { lane, count: ego.cell[1] });
  if (ahead === 0) return t(across < 0 ? "place.left" : "place.right", { lane });
  return t(`place.${across === 0 ? "own_" : ""}${ahead > 0 ? "ahead" : "behind"}`, { lane, count: Math.abs(ahead) });
}

/**
 * Which way a thing goes.
 * @param {Thing} thing
 */
export function headingWords({ kind, heading, disabled }) {
  if (disabled) return t("heading.held");
  if (heading === null || kind === "av") return "";
  return t(`heading.${kind === "pedestrian" ? "walking_" : ""}${heading}`);
}

/**
 * What a cell holds and where it is, to be read aloud.
 * @param {World} world
 * @param {Cell} cell
 */
export function cellWords(world, cell) {
  const thing = thingIn(world, cell);
  const what = thing ? [nameOf(thing), headingWords(thing)].filter(Boolean).join(", ") : t("cell.free");
  return t("cell.text", { place: placeWords(world, cell), what });
}
