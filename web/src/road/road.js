// @ts-check
/** The road as the vehicle's follower sees it: canvas, scrolling, everything gliding between ticks. */

import { html } from "../../vendor/lit-html.js";
import { t } from "../core/texts.js";
import { createSlot, find } from "../ui/slot.js";
import { Camera, viewOf } from "./camera.js";
import { aheadOf, foreseen, pathOf, STEPS } from "../why/forecast.js";
import { ease, Stage } from "./motion.js";
import { drawCell, drawImpact, drawMove, drawRing, drawTrail, drawWait } from "./paint/annotations.js";
import { drawBoxes, drawForecast, drawHazards } from "./paint/overlays.js";
import { Sprites } from "./paint/sprites.js";
import { drawLines, laySurface, surfaceTile } from "./paint/surface.js";
import { drawLight, drawThing, isFixed } from "./paint/things.js";
import { drawMarks, drawWeather } from "./paint/weather.js";
import { Sensed } from "./sensed.js";
import { readPalette, wantsStillness } from "../core/theme.js";
import { describe, egoOf } from "./world.js";

/** @import { Cell } from "../core/protocol.js" */
/** @import { View } from "./camera.js" */
/** @import { Places } from "./hitTest.js" */
/** @import { Pose } from "./motion.js" */
/** @import { State } from "../core/state.js" */
/** @import { Marks } from "./sensed.js" */
/** @import { Perspective } from "./perspective/perspective.js" */
/** @import { World } from "./world.js" */
/** @import { Panel } from "../panels/index.js" */

/** More pixels than this a cell cannot be told apart, and cost frames. */
const LARGEST_RATIO = 2;
const LONGEST_FRAME_S = 0.1;
/** How strongly vehicles light the road by night, where colours do not say so. */
const NIGHT_LAMPS = 0.6;

/** @typedef {import("./paint/things.js").Scene & {state: State, world: World, seen: Pose[]}} Moment  what is drawn: `seen`, as far as it is in view */

/** @param {HTMLElement} host @returns {Panel & {places: Places, deepen: (view: Perspective) => void}} */
export function createRoad(host) {
  const road = new RoadView(host);
  return {
    places: placesOf(road),
    update: (state) => road.update(state),
    repaint: () => road.repaint(),
    draw: (now) => road.draw(now),
    deepen: (view) => void (road.perspective = view),
  };
}

class RoadView {
  stage = new Stage();
  camera = new Camera();
  sprites = new Sprites();
  sensed = new Sensed();
  palette = readPalette(document.documentElement);
  /** @type {State | null} */ state = null;
  /** @type {View | null} */ view = null;
  /** Draws the road in perspective, once that is fetched. @type {Perspective | null} */ perspective = null;
  /** The road's surface, drawn once. @type {HTMLCanvasElement | null} */ tile = null;
  #drawnAt = 0;

  /** @param {HTMLElement} host */
  constructor(host) {
    this.host = host;
    this.slot = createSlot(host, host.firstChild);
    this.#show(t("road.label"));
    this.canvas = /** @type {HTMLCanvasElement} */ (find(host, ".road-canvas"));
    this.pen = /** @type {CanvasRenderingContext2D} */ (this.canvas.getContext("2d", { alpha: false }));
  }

  /** @param {string} label */
  #show(label) {
    this.slot(html`<canvas class="road-canvas" role="img" aria-label=${label}></canvas>`);
  }

  /** @param {State} next */
  update(next) {
    const { world } = next;
    const before = this.state?.world;
    this.state = next;
    this.sensed.update(next);
    if (world === null || world === before) return;
    if (before && (before.columns !== world.columns || before.visibleRows !== world.visibleRows)) this.view = null;
    if (before && before.episode !== world.episode) this.camera.top = null;
    this.stage.receive(world, performance.now(), wantsStillness());
    this.#show(describe(world));
  }

  repaint() {
    this.palette = readPalette(document.documentElement);
    this.sprites.clear();
    this.perspective?.repaint();
    this.view = this.tile = null;
  }

  /** Fit canvas, view and surface to the room there is. @param {World} world */
  #fit(world) {
    const ratio = Math.min(LARGEST_RATIO, devicePixelRatio || 1);
    const { clientWidth: width, clientHeight: height } = this.host;
    this.canvas.width = Math.max(1, Math.round(width * ratio));
    this.canvas.height = Math.max(1, Math.round(height * ratio));
    const view = (this.view = viewOf({ width, height, ratio }, world));
    const tile = (this.tile = surfaceTile(view, world.columns, this.palette));
    this.sprites.fit(view.cell * ratio);
    return { view, tile };
  }

  /** The view in perspective, where that is what is seen. */
  get deep() {
    return this.state?.views.perspective ? this.perspective : null;
  }

  /** @param {number} now @returns {boolean} whether there is more to come */
  draw(now) {
    const { state, stage, sprites, pen } = this;
    const world = state?.world;
    if (!world || this.host.clientWidth === 0) return false;
    const { view, tile } = this.view && this.tile ? { view: this.view, tile: this.tile } : this.#fit(world);
    const ego = egoOf(world);
    const egoPose = ego && stage.pose(ego.id, now);
    const still = wantsStillness();
    const elapsedS = still ? Infinity : Math.min(LONGEST_FRAME_S, (now - this.#drawnAt) / 1000);
    this.#drawnAt = now;
    const progress = still ? 1 : stage.progress(now);
    const palette = world.light === "day" || this.palette.lamps > 0 ? this.palette : { ...this.palette, lamps: NIGHT_LAMPS };
    const moment = { pen, sprites, palette, progress, now: still ? 0 : now, state, world, seen: stage.poses(now) };
    const hit = world.status === "crash" ? stage.touch(now) : null;
    const given = { ego: egoPose, trail: stage.trail.slice(0, -1), hit, sensed: this.sensed.of(world), elapsedS };
    const { deep } = this;
    const scrolling = deep
      ? deep.draw(moment, view, { ...given, path: pathOf(state, egoPose), ahead: aheadOf(state) })
      : this.#drawFromAbove(moment, view, tile, given);
    return scrolling || stage.moving(now) || this.sensed.waiting;
  }

  /**
   * @param {Moment} all
   * @param {View} view
   * @param {HTMLCanvasElement} tile
   * @param {{ego: Pose | null, trail: [number, number][], hit: [number, number] | null, sensed: Marks | null, elapsedS: number}} given
   * @returns {boolean} whether the road is still scrolling
   */
  #drawFromAbove(all, view, tile, { ego, trail, hit, sensed, elapsedS }) {
    const { pen, palette, world, progress } = all;
    const { camera } = this;
    const scrolling = camera.follow(ego?.row ?? world.rows - 1, world, view, elapsedS);
    const top = camera.top ?? 0;
    const { cell, left, ratio, visibleRows } = view;

    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    laySurface(pen, tile, view, top);
    drawLines(pen, view, top, world, palette);

    // From here on one unit is a cell, and whole numbers are the centres of cells.
    pen.setTransform(ratio * cell, 0, 0, ratio * cell, ratio * (left + cell / 2), ratio * cell * (0.5 - top));
    const seen = all.seen.filter(({ row }) => row > top - 2 && row < top + visibleRows + 1);
    drawMoment({ ...all, seen }, ego, trail, hit);
    if (sensed) drawMarks(pen, seen, sensed, palette);
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    drawWeather(pen, view, world, world.tick + progress, palette);
    return scrolling;
  }
}

/** Where cells and things are on the screen. @param {RoadView} road @returns {Places} */
function placesOf(road) {
  const { canvas, stage, camera } = road;
  /** A point of the window on the canvas. @param {number} x @param {number} y */
  const onCanvas = (x, y) => {
    const { left, top } = canvas.getBoundingClientRect();
    return /** @type {[number, number]} */ ([x - left, y - top]);
  };
  return {
    cellAt(x, y) {
      const { view, deep } = road;
      const [left, top] = onCanvas(x, y);
      if (deep) return wholeCell(deep.spotAt(left, top));
      if (view === null || camera.top === null) return null;
      return [Math.floor((left - view.left) / view.cell), Math.floor(top / view.cell + camera.top)];
    },
    placeOf([column, row]) {
      const { view, deep } = road;
      const { left, top } = canvas.getBoundingClientRect();
      if (deep) {
        const place = deep.placeOf([column, row]);
        return place && { ...place, left: left + place.left, top: top + place.top };
      }
      if (view === null || camera.top === null) return null;
      const size = view.cell;
      return { left: left + view.left + column * size, top: top + (row - camera.top) * size, width: size, height: size };
    },
    spotAt: (x, y) => road.deep?.spotAt(...onCanvas(x, y)) ?? null,
    cellPx: () => (road.deep ? road.deep.cell : (road.view?.cell ?? 0)),
    poseOf: (id) => stage.pose(id, performance.now()),
    poses: () => stage.poses(performance.now()),
    window() {
      if (road.deep) return road.deep.window;
      return road.view === null || camera.top === null || road.host.clientWidth === 0 ? null : [camera.top, camera.top + road.view.visibleRows];
    },
  };
}

/** @param {[number, number] | null} spot  whole numbers are centres of cells @returns {Cell | null} */
function wholeCell(spot) {
  return spot && [Math.round(spot[0]), Math.round(spot[1])];
}

/**
 * All that is on the road, from the ground up.
 * @param {Moment} moment
 * @param {Pose | null} ego
 * @param {Parameters<typeof drawTrail>[1]} trail  cells the vehicle came through
 * @param {[number, number] | null} hit  where there was a crash
 */
function drawMoment(moment, ego, trail, hit) {
  const { pen, palette, progress, state, world, seen } = moment;
  const { views } = state;
  if (hit) at(pen, ...hit, () => drawImpact(pen, ease(progress), palette));
  for (const pose of seen) if (isFixed(pose.thing)) drawThing(moment, pose, null);
  if (views.potholes) drawHazards(pen, seen, palette);
  if (views.path) drawTrail(pen, trail, palette);
  drawCauses(moment);
  if (views.path && ego && world.status === "running") drawIntent(moment, ego);
  if (views.forecast) drawForecast(pen, seen, aheadOf(state), palette);
  const signal = state.decision?.move ?? null;
  for (const pose of seen) drawLight(moment, pose);
  for (const pose of seen) if (!isFixed(pose.thing)) drawThing(moment, pose, signal);
  if (views.boxes) drawBoxes(pen, seen, palette);
  drawHighlight(moment);
}

/** Rings around what the decision hung on. @param {Moment} moment */
function drawCauses({ pen, palette, progress, state, seen }) {
  const causes = new Set(state.decision?.causes ?? []);
  const alpha = 1 - 0.55 * ease(progress);
  for (const { thing, column, row } of seen) {
    if (causes.has(thing.id)) at(pen, column, row, () => drawRing(pen, palette.cause, alpha));
  }
}

/** Where the vehicle is about to be. @param {Moment} moment @param {Pose} ego */
function drawIntent({ pen, palette, progress, state, world }, { thing, column, row }) {
  // What comes next is shown once the move before it is made.
  const { past } = state;
  const coming = past ? state.decision : world.paused && world.mode !== "manual" ? foreseen(state)?.decision : null;
  const next = progress === 1 ? coming : null;
  if (next) {
    const [across, down] = STEPS[next.move];
    if (next.move === "stay") drawWait(pen, [column, row], 0, palette);
    else drawMove(pen, [column, row], [thing.cell[0] + across, thing.cell[1] + down], 0, { ...palette, accent: palette.next });
  } else if (!state.decision || past) return;
  else if (state.decision.move === "stay") drawWait(pen, [column, row], progress, palette);
  else drawMove(pen, [column, row], thing.cell, progress, palette);
}

/** What the reader points at. @param {Moment} moment */
function drawHighlight({ pen, palette, state, seen }) {
  if (!state.highlight) return;
  const { ids, cells } = state.highlight;
  const named = seen.filter(({ thing }) => ids.includes(thing.id));
  for (const { column, row } of named) at(pen, column, row, () => drawRing(pen, palette.accent, 1, 0.54));
  for (const [column, row] of cells) {
    // Where it was when it mattered, unless it is there still.
    const there = named.some(({ thing: { cell } }) => cell[0] === column && cell[1] === row);
    if (!there) at(pen, column, row, () => drawCell(pen, palette.accent));
  }
}

/** @param {CanvasRenderingContext2D} pen @param {number} column @param {number} row @param {() => void} draw */
function at(pen, column, row, draw) {
  pen.save();
  pen.translate(column, row);
  draw();
  pen.restore();
}
