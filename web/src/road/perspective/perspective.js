// @ts-check
/**
 * The road in perspective, from behind and above the vehicle: the same poses, marks and weather as in the view from
 * above, on the same canvas. Fetched when it is first wanted (`perspectiveLoader.js`).
 */

import { sizeOf } from "../collisionGeometry.js";
import { ease } from "../motion.js";
import { drawImpact } from "../paint/annotations.js";
import { blinks, isFixed } from "../paint/things.js";
import { drawWeather } from "../paint/weather.js";
import { Backdrop } from "./backdrop.js";
import { drawBeam, drawBody, drawBox } from "./bodies.js";
import { AHEAD_ROWS, Eye, lensOf } from "./eye.js";
import { drawPothole } from "./figures.js";
import { drawGround, drawPosts } from "./ground.js";
import { drawCell, drawNext, drawRibbon, drawRing, drawSensed, drawTouch, drawTrail } from "./marks.js";

/** @import { Cell } from "../../core/protocol.js" */
/** @import { Place } from "../hitTest.js" */
/** @import { Pose } from "../motion.js" */
/** @import { Marks } from "../sensed.js" */
/** @import { Moment } from "../road.js" */

/** From here on things fade into the haze, and are gone a few rows later; fog is nearer. In cells from the vehicle. */
const HAZE = { clear: { from: 26, to: AHEAD_ROWS - 2 }, fog: { from: 7, to: 24 } };
/** Bodies are pointed at where they stand, which is nearer than what is behind them: by so much of a row. */
const POINTED_ABOVE = 0.12;

/**
 * @typedef {object} Given  what is drawn beside the moment
 * @property {Pose | null} ego
 * @property {[number, number][]} trail  cells the vehicle came through
 * @property {[number, number][]} path  cells it is about to go through, from where it is; none where none is shown
 * @property {Record<string, Cell>[]} ahead  cells of the movers in the ticks to come
 * @property {[number, number] | null} hit  where there was a crash
 * @property {Marks | null} sensed
 * @property {number} elapsedS  since the last frame; Infinity cuts
 */

export class Perspective {
  /** @type {Eye | null} */ #eye = null;
  /** Where the eye was before the canvas changed. @type {{row: number | null, x: number}} */ #left = { row: null, x: 0 };
  #episode = -1;

  /** @param {Backdrop} [backdrop] */
  constructor(backdrop = new Backdrop()) {
    this.backdrop = backdrop;
  }

  /** The canvas has another size. */
  repaint() {
    const { row, x } = this.#eye ?? this.#left;
    this.#left = { row, x };
    this.#eye = null;
  }

  /**
   * @param {Moment} moment
   * @param {{width: number, height: number, ratio: number}} canvas
   * @param {Given} given
   * @returns {boolean} whether the eye is still on its way
   */
  draw(moment, canvas, given) {
    const { pen, world, palette, progress } = moment;
    const eye = (this.#eye ??= Object.assign(new Eye(lensOf(canvas, world)), this.#left));
    const jumped = world.episode !== this.#episode;
    this.#episode = world.episode;
    const ego = given.ego ?? { column: (world.columns - 1) / 2, row: world.rows - 1 };
    const moving = eye.follow(ego, world, jumped ? Infinity : given.elapsedS);
    pen.setTransform(canvas.ratio, 0, 0, canvas.ratio, 0, 0);
    this.backdrop.lay(pen, eye, world.columns, palette);
    drawGround(pen, eye, world, palette);
    const inView = moment.seen.filter(({ row }) => row < eye.nearest - 0.3 && eye.distance(row) < AHEAD_ROWS + eye.lens.back);
    const seen = inView.sort((a, b) => a.row - b.row || Math.abs(b.column - eye.x) - Math.abs(a.column - eye.x));
    drawLying(eye, { ...moment, seen }, given);
    drawStanding(eye, { ...moment, seen });
    drawWeather(pen, { width: canvas.width, height: canvas.height, cell: eye.lens.cell }, world, world.tick + progress, palette);
    return moving;
  }

  /** Where on the road a point of the canvas is, whole numbers being centres of cells. @param {number} x @param {number} y @returns {[number, number] | null} */
  spotAt(x, y) {
    const spot = this.#eye?.ground(x, y);
    return spot ? [spot[0], spot[1] + POINTED_ABOVE] : null;
  }

  /** What a cell covers of the canvas, roughly; null where it is behind the eye. @param {[number, number]} cell @returns {Place | null} */
  placeOf([column, row]) {
    const eye = this.#eye;
    if (eye === null || row > eye.nearest) return null;
    const [left] = eye.spot(column - 0.5, row);
    const [, top] = eye.spot(column, row - 0.5);
    const [, bottom] = eye.spot(column, Math.min(row + 0.5, eye.nearest));
    return { left, top, width: eye.scale(row), height: bottom - top };
  }

  /** The side of a cell beside the vehicle, in CSS pixels. */
  get cell() {
    return this.#eye?.lens.cell ?? 0;
  }

  /** The rows that are seen, from and to. @returns {[number, number] | null} */
  get window() {
    const eye = this.#eye;
    return eye && [(eye.row ?? 0) - AHEAD_ROWS / 2, eye.nearest];
  }
}

/** How much of a row is seen through the haze, 0–1. @param {Eye} eye @param {string} weather @param {number} row */
function clearness(eye, weather, row) {
  const { from, to } = weather === "fog" ? HAZE.fog : HAZE.clear;
  return Math.max(0, Math.min(1, (to - ((eye.row ?? 0) - row)) / (to - from)));
}

/** What lies on the road. @param {Eye} eye @param {Moment} moment @param {Given} given */
function drawLying(eye, moment, { trail, path, ahead, hit, sensed }) {
  const { pen, palette, progress, state, world, seen } = moment;
  const { views } = state;
  for (const pose of seen) {
    if (pose.thing.kind !== "pothole") continue;
    pen.globalAlpha = pose.alpha * clearness(eye, world.weather, pose.row);
    drawPothole(pen, eye, pose, palette);
  }
  pen.globalAlpha = 1;
  for (const { thing, column, row, alpha } of seen) {
    if (!views.potholes || !isFixed(thing)) continue;
    pen.globalAlpha = alpha;
    drawCell(pen, eye, [column, row], palette.roadKinds[thing.kind] ?? palette.danger, true);
  }
  pen.globalAlpha = 1;
  if (views.path) drawTrail(pen, eye, trail, palette);
  if (views.path || views.forecast) drawNext(pen, eye, seen, views.forecast ? ahead : ahead.slice(0, 1), palette);
  if (path.length > 1) drawRibbon(pen, eye, path, palette);
  drawHints(eye, moment);
  if (sensed) drawSensed(pen, eye, seen, sensed, palette);
  if (hit) drawTouch(pen, eye, hit, (brush) => drawImpact(brush, ease(progress), palette));
  if (palette.lamps === 0) return;
  for (const pose of seen) {
    const { kind, disabled } = pose.thing;
    if (disabled || (kind !== "av" && kind !== "vehicle")) continue;
    pen.globalAlpha = pose.alpha * clearness(eye, world.weather, pose.row);
    drawBeam(pen, eye, pose, palette.lamps);
  }
  pen.globalAlpha = 1;
}

/** Rings around what the decision hung on, and what the reader points at. @param {Eye} eye @param {Moment} moment */
function drawHints(eye, { pen, palette, progress, state, seen }) {
  const causes = new Set(state.decision?.causes ?? []);
  for (const { thing, column, row } of seen) {
    if (causes.has(thing.id)) drawRing(pen, eye, [column, row], palette.cause, 1 - 0.55 * ease(progress));
  }
  const { highlight } = state;
  if (highlight === null) return;
  const named = seen.filter(({ thing }) => highlight.ids.includes(thing.id));
  for (const { column, row } of named) drawRing(pen, eye, [column, row], palette.accent, 1, 0.54);
  for (const [column, row] of highlight.cells) {
    const there = named.some(({ thing: { cell } }) => cell[0] === column && cell[1] === row);
    if (!there && row < eye.nearest - 0.5) drawCell(pen, eye, [column, row], palette.accent, false);
  }
}

/** What stands on the road and beside it, the far before the near. @param {Eye} eye @param {Moment} moment */
function drawStanding(eye, { pen, palette, progress, state, world, seen }) {
  const clear = (/** @type {number} */ row) => clearness(eye, world.weather, row);
  drawPosts(pen, eye, world, palette, clear);
  const signal = { move: state.decision?.move ?? null, blink: blinks(progress) };
  for (const pose of seen) {
    const { thing, row, alpha, scale } = pose;
    if (thing.kind === "pothole") continue;
    pen.globalAlpha = alpha * scale * clear(row);
    drawBody(pen, eye, pose, palette, signal);
  }
  pen.globalAlpha = 1;
  if (!state.views.boxes) return;
  for (const pose of seen) {
    const { kind } = pose.thing;
    if (clear(pose.row) < 0.2) continue;
    drawBox(pen, eye, pose, sizeOf(kind), palette.roadKinds[kind] ?? palette.danger);
  }
}
