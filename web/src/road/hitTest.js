// @ts-check
/**
 * What is where: cells and things on the views that show them, and what a driver would call them.
 *
 * A view says where its cells are (`offerPlaces`); who points at it asks here. Pure but for that table.
 */

import { counted, MOVES, reasonWords } from "../core/words.js";
import { egoOf } from "./world.js";

/** @import { Pose } from "./motion.js" */
/** @import { Cell, Decision, Option } from "../core/protocol.js" */
/** @import { World, Thing } from "./world.js" */

/** @typedef {{left: number, top: number, width: number, height: number}} Place  in the window's pixels */

/**
 * @typedef {object} Places  where a view shows what
 * @property {(x: number, y: number) => Cell | null} cellAt  also beyond the road's edges, where a view goes on there
 * @property {(cell: Cell) => Place | null} placeOf
 * @property {(id: string) => Pose | null} [poseOf]  where a thing is seen on its way between two cells
 * @property {() => Pose[]} [poses]
 * @property {() => [number, number] | null} [window]  the rows that are seen, from and to
 */

/** @type {Map<Element, Places>} */
const VIEWS = new Map();

/** @param {Element} element @param {Places} places */
export function offerPlaces(element, places) {
  VIEWS.set(element, places);
}

/**
 * The view an event happened in.
 * @param {EventTarget | null} target
 * @returns {{element: Element, places: Places} | null}
 */
export function viewUnder(target) {
  for (let at = target instanceof Element ? target : null; at !== null; at = at.parentElement) {
    const places = VIEWS.get(at);
    if (places) return { element: at, places };
  }
  return null;
}

/**
 * The thing that is seen nearest to a point, when it is on it.
 * @param {Places} places
 * @param {World} world
 * @param {number} x
 * @param {number} y
 * @returns {Thing | null}
 */
export function thingAt(places, world, x, y) {
  const cell = places.cellAt(x, y);
  if (cell === null) return null;
  const origin = places.placeOf([0, 0]);
  if (!places.poses || !origin) return thingIn(world, cell);
  const column = (x - origin.left) / origin.width - 0.5;
  const row = (y - origin.top) / origin.height - 0.5;
  let best = null;
  let least = 0.55;
  for (const pose of places.poses()) {
    const away = Math.max(Math.abs(pose.column - column), Math.abs(pose.row - row)) + rank(pose.thing) / 1000;
    if (away >= least || !world.things.has(pose.thing.id)) continue;
    least = away;
    best = pose.thing;
  }
  return best && (world.things.get(best.id) ?? null);
}

/** What lies under the others comes last. @param {{kind: string}} thing */
function rank({ kind }) {
  return kind === "pothole" ? 2 : 1;
}

/**
 * What is in a cell; of two things the one on top.
 * @param {World} world
 * @param {Cell} cell
 * @returns {Thing | null}
 */
export function thingIn(world, cell) {
  let found = null;
  for (const thing of world.things.values()) {
    if (!same(thing.cell, cell)) continue;
    if (found === null || rank(thing) < rank(found)) found = thing;
  }
  return found;
}

/** @param {Cell} a @param {Cell | null | undefined} b */
export function same(a, b) {
  return !!b && a[0] === b[0] && a[1] === b[1];
}

/** @param {World} world @param {Cell} cell */
export function onRoad({ columns, rows }, [column, row]) {
  return column >= 0 && row >= 0 && column < columns && row < rows;
}

const NAMES = /** @type {Record<string, string>} */ ({
  av: "the vehicle",
  vehicle: "a car",
  pedestrian: "a walker",
  pothole: "a pothole",
  barrier: "a barrier",
});

/** @param {{kind: string}} thing */
export function nameOf({ kind }) {
  return NAMES[kind] ?? `a ${kind}`;
}

/** @param {string} text */
export function capital(text) {
  return text.charAt(0).toUpperCase() + text.slice(1);
}

/**
 * Where a cell is, as one says it in the car.
 * @param {World} world
 * @param {Cell} cell
 */
export function placeWords(world, cell) {
  const lane = `lane ${cell[0] + 1}`;
  const ego = egoOf(world);
  if (!ego) return `${lane}, row ${cell[1]}`;
  const across = cell[0] - ego.cell[0];
  const ahead = ego.cell[1] - cell[1];
  if (across === 0 && ahead === 0) return `${lane}, ${counted(ego.cell[1], "row")} to go`;
  if (ahead !== 0) return `${across === 0 ? `${lane}, its own` : lane}, ${counted(Math.abs(ahead), "row")} ${ahead > 0 ? "ahead" : "behind"}`;
  return `${lane}, beside it on the ${across < 0 ? "left" : "right"}`;
}

/**
 * Which way a thing goes.
 * @param {Thing} thing
 */
export function headingWords({ kind, heading, disabled }) {
  if (disabled) return "held by a pothole";
  if (heading === null || kind === "av") return "";
  return `${kind === "pedestrian" ? "walking" : "heading"} ${heading}`;
}

/**
 * What a cell holds and where it is, to be read aloud.
 * @param {World} world
 * @param {Cell} cell
 */
export function cellWords(world, cell) {
  const thing = thingIn(world, cell);
  const heading = thing ? headingWords(thing) : "";
  const what = thing ? [nameOf(thing).replace(/^an? /, ""), heading].filter(Boolean).join(", ") : "free";
  return `${placeWords(world, cell)}: ${what}`;
}

/** @param {Option["move"]} move */
export function moveName(move) {
  return MOVES[move]?.name ?? move;
}

/** @param {string[]} names */
function listed(names) {
  return names.length < 2 ? names.join("") : `${names.slice(0, -1).join(", ")} and ${names.at(-1)}`;
}

/**
 * What the latest decision made of a thing; null where it played no part.
 * @param {Decision | null} decision
 * @param {string} id
 */
export function decidedAbout(decision, id) {
  if (decision === null) return null;
  const ruled = (decision.options ?? []).filter(({ causes }) => causes?.includes(id));
  if (ruled.length > 0) {
    const reasons = [...new Set(ruled.map(({ reason }) => reasonWords(reason)))];
    return `It ruled out ${listed(ruled.map(({ move }) => moveName(move)))}: ${listed(reasons)}. So the move was ${moveName(decision.move)}.`;
  }
  if (!decision.options && decision.causes?.includes(id)) {
    return `Because of it the move was ${moveName(decision.move)}${decision.reason ? `: ${reasonWords(decision.reason)}` : ""}.`;
  }
  return null;
}

/**
 * What the latest decision made of going to a cell; null where no move led there.
 * @param {Decision | null} decision
 * @param {Cell} cell
 * @returns {{text: string, option: Option, taken: boolean} | null}
 */
export function decidedOn(decision, cell) {
  const option = decision?.options?.find((each) => same(cell, each.cell));
  if (!decision || !option) return null;
  const name = moveName(option.move);
  const taken = option.move === decision.move;
  if (taken) return { text: `It went here: ${name}.`, option, taken };
  const text =
    option.verdict === "free"
      ? `Going here (${name}) was possible; ${moveName(decision.move)} was preferred.`
      : `Going here (${name}) was ruled out: ${reasonWords(option.reason)}.`;
  return { text, option, taken };
}
