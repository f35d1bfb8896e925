// @ts-check
/** The road as the vehicle's follower sees it: canvas, scrolling, everything gliding between ticks. */

import { Camera, viewOf } from "./camera.js";
import { make } from "../ui/dom.js";
import { foreseen, STEPS } from "../why/forecast.js";
import { ease, Stage } from "./motion.js";
import { drawCell, drawImpact, drawMove, drawRing, drawTrail, drawWait } from "./paint/annotations.js";
import { drawBoxes, drawForecast, drawHazards } from "./paint/overlays.js";
import { Sprites } from "./paint/sprites.js";
import { drawLines, laySurface, surfaceTile } from "./paint/surface.js";
import { drawLight, drawThing, isFixed } from "./paint/things.js";
import { readPalette, wantsStillness } from "../core/theme.js";
import { describe, egoOf } from "./world.js";

/** @import { View } from "./camera.js" */
/** @import { Places } from "./hitTest.js" */
/** @import { Pose } from "./motion.js" */
/** @import { State } from "../core/state.js" */
/** @import { World } from "./world.js" */
/** @import { Panel } from "../panels/index.js" */

/** More pixels than this a cell cannot be told apart, and cost frames. */
const LARGEST_RATIO = 2;
const LONGEST_FRAME_S = 0.1;

/** @param {HTMLElement} host @returns {Panel & {places: Places}} */
export function createRoad(host) {
  const canvas = make("canvas", { class: "road-canvas", role: "img", "aria-label": "The road" });
  host.append(canvas);
  const pen = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d", { alpha: false }));
  const stage = new Stage();
  const camera = new Camera();
  const sprites = new Sprites();
  let palette = readPalette(document.documentElement);
  /** @type {State | null} */ let state = null;
  /** @type {View | null} */ let view = null;
  /** @type {HTMLCanvasElement | null} */ let tile = null;
  let drawnAt = 0;

  /** Fit canvas, view and surface to the room there is. @param {World} world */
  function fit(world) {
    const ratio = Math.min(LARGEST_RATIO, devicePixelRatio || 1);
    const { clientWidth: width, clientHeight: height } = host;
    canvas.width = Math.max(1, Math.round(width * ratio));
    canvas.height = Math.max(1, Math.round(height * ratio));
    view = viewOf({ width, height, ratio }, world);
    tile = surfaceTile(view, world.columns, palette);
    sprites.fit(view.cell * ratio);
    return { view, tile };
  }

  /** Where cells and things are on the screen. @type {Places} */
  const places = {
    cellAt(x, y) {
      if (view === null || camera.top === null) return null;
      const { left, top } = canvas.getBoundingClientRect();
      return [Math.floor((x - left - view.left) / view.cell), Math.floor((y - top) / view.cell + camera.top)];
    },
    placeOf: ([column, row]) => {
      if (view === null || camera.top === null) return null;
      const { left, top } = canvas.getBoundingClientRect();
      const size = view.cell;
      return { left: left + view.left + column * size, top: top + (row - camera.top) * size, width: size, height: size };
    },
    poseOf: (id) => stage.pose(id, performance.now()),
    poses: () => stage.poses(performance.now()),
    window: () => (view === null || camera.top === null || host.clientWidth === 0 ? null : [camera.top, camera.top + view.visibleRows]),
  };

  return {
    places,

    update(next) {
      const { world } = next;
      const before = state?.world;
      state = next;
      if (world === null || world === before) return;
      if (before && (before.columns !== world.columns || before.visibleRows !== world.visibleRows)) view = null;
      if (before && before.episode !== world.episode) camera.top = null;
      stage.receive(world, performance.now(), wantsStillness());
      canvas.setAttribute("aria-label", describe(world));
    },

    repaint() {
      palette = readPalette(document.documentElement);
      sprites.clear();
      view = tile = null;
    },

    draw(now) {
      const world = state?.world;
      if (!state || !world || host.clientWidth === 0) return false;
      const fitted = view && tile ? { view, tile } : fit(world);
      const ego = egoOf(world);
      const egoPose = ego && stage.pose(ego.id, now);
      const still = wantsStillness();
      const elapsedS = still ? Infinity : Math.min(LONGEST_FRAME_S, (now - drawnAt) / 1000);
      drawnAt = now;
      const scrolling = camera.follow(egoPose?.row ?? world.rows - 1, world, fitted.view, elapsedS);
      const top = camera.top ?? 0;
      const { cell, left, ratio, visibleRows } = fitted.view;

      pen.setTransform(ratio, 0, 0, ratio, 0, 0);
      laySurface(pen, fitted.tile, fitted.view, top);
      drawLines(pen, fitted.view, top, world, palette);

      // From here on one unit is a cell, and whole numbers are the centres of cells.
      pen.setTransform(ratio * cell, 0, 0, ratio * cell, ratio * (left + cell / 2), ratio * cell * (0.5 - top));
      const seen = stage.poses(now).filter(({ row }) => row > top - 2 && row < top + visibleRows + 1);
      const progress = still ? 1 : stage.progress(now);
      const scene = { pen, sprites, palette, progress, now: still ? 0 : now };
      const hit = world.status === "crash" ? stage.touch(now) : null;
      if (hit) at(...hit, () => drawImpact(pen, ease(progress), palette));
      for (const pose of seen) if (isFixed(pose.thing)) drawThing(scene, pose, null);
      const { views } = state;
      if (views.potholes) drawHazards(pen, seen, palette);
      if (views.path) drawTrail(pen, stage.trail.slice(0, -1), palette);
      drawCauses(seen, progress);
      if (views.path && egoPose && world.status === "running") drawIntent(egoPose, progress);
      if (views.forecast) drawForecast(pen, seen, aheadOf(state), palette);
      const signal = state.decision?.move ?? null;
      for (const pose of seen) drawLight(scene, pose);
      for (const pose of seen) if (!isFixed(pose.thing)) drawThing(scene, pose, signal);
      if (views.boxes) drawBoxes(pen, seen, palette);
      drawHighlight(seen);
      return scrolling || stage.moving(now);
    },
  };

  /** @param {Pose[]} seen @param {number} progress */
  function drawCauses(seen, progress) {
    const causes = new Set(state?.decision?.causes ?? []);
    const alpha = 1 - 0.55 * ease(progress);
    for (const { thing, column, row } of seen) {
      if (causes.has(thing.id)) at(column, row, () => drawRing(pen, palette.cause, alpha));
    }
  }

  /** @param {Pose} ego @param {number} progress */
  function drawIntent({ thing, column, row }, progress) {
    // What comes next is shown once the move before it is made.
    const next = progress === 1 && state?.world?.paused ? foreseen(state)?.decision : null;
    if (next) {
      const [across, down] = STEPS[next.move];
      if (next.move === "stay") drawWait(pen, [column, row], 0, palette);
      else drawMove(pen, [column, row], [thing.cell[0] + across, thing.cell[1] + down], 0, { ...palette, accent: palette.next });
    } else if (!state?.decision) return;
    else if (state.decision.move === "stay") drawWait(pen, [column, row], progress, palette);
    else drawMove(pen, [column, row], thing.cell, progress, palette);
  }

  /** @param {Pose[]} seen */
  function drawHighlight(seen) {
    if (!state?.highlight) return;
    const { ids, cells } = state.highlight;
    const named = seen.filter(({ thing }) => ids.includes(thing.id));
    for (const { column, row } of named) at(column, row, () => drawRing(pen, palette.accent, 1, 0.54));
    for (const [column, row] of cells) {
      // Where it was when it mattered, unless it is there still.
      const there = named.some(({ thing: { cell } }) => cell[0] === column && cell[1] === row);
      if (!there) at(column, row, () => drawCell(pen, palette.accent));
    }
  }

  /** @param {number} column @param {number} row @param {() => void} draw */
  function at(column, row, draw) {
    pen.save();
    pen.translate(column, row);
    draw();
    pen.restore();
  }
}

/**
 * Where movers will be in the ticks to come, as far as that was told.
 * @param {State} state
 */
function aheadOf({ foresight, world }) {
  const tick = world?.tick ?? 0;
  if (!foresight || foresight.tick > tick) return [];
  return foresight.ahead.filter((each) => each.tick > tick).map(({ movers }) => movers);
}
