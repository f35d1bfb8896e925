// @ts-check
/**
 * What is where: cells and things on the views that show them.
 *
 * A view says where its cells are (`offerPlaces`); who points at it asks here. The only state is the table of views.
 */

/** @import { Pose } from "./motion.js" */
/** @import { Cell } from "../core/protocol.js" */
/** @import { World, Thing } from "./world.js" */

/** @typedef {{left: number, top: number, width: number, height: number}} Place  in the window's pixels */

/**
 * @typedef {object} Places  where a view shows what
 * @property {(x: number, y: number) => Cell | null} cellAt  also beyond the road's edges, where a view goes on there
 * @property {(cell: Cell) => Place | null} placeOf
 * @property {(x: number, y: number) => [number, number] | null} [spotAt]  where between the cells, whole numbers being their
 *   centres; null where cells stand as a plain grid, so that `placeOf` tells
 * @property {() => number} [cellPx]  the side of a cell, where that is not the same everywhere: beside the vehicle
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
  const [column, row] = places.spotAt?.(x, y) ?? [(x - origin.left) / origin.width - 0.5, (y - origin.top) / origin.height - 0.5];
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

/** The side of a cell of a view, in CSS pixels; 0 where nothing is seen yet. @param {Places} places */
export function cellPx(places) {
  return places.cellPx?.() ?? places.placeOf([0, 0])?.width ?? 0;
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
