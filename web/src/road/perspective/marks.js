// @ts-check
/** What explains, in perspective, lying on the road: the path as a ribbon, the trail, next cells, rings, the impact. */

import { sizeOf } from "../collisionGeometry.js";
import { disc, flat, shape, upright } from "./solids.js";

/** @import { Cell } from "../../core/protocol.js" */
/** @import { Palette } from "../../core/theme.js" */
/** @import { Pose } from "../motion.js" */
/** @import { Eye } from "./eye.js" */

/** @typedef {CanvasRenderingContext2D} Pen */
/** @typedef {[column: number, row: number]} Spot */

const RIBBON = { half: 0.13, steps: 8, nearest: 0.62, farthest: 0.12 };
const CHEVRON = { half: 0.17, along: 0.13 };
/** How much of a mover's cell is seen in each tick to come. */
const NEXT_ALPHAS = [0.95, 0.6, 0.35];

/**
 * The planned path: a band on the road that fades with the time to come, an arrow head in each cell it leads to, and a
 * bar where it waits.
 * @param {Pen} pen
 * @param {Eye} eye
 * @param {Spot[]} cells  from where the vehicle is
 * @param {Palette} palette
 */
export function drawRibbon(pen, eye, cells, palette) {
  const ways = cells.filter((cell, at) => at === 0 || !near(cell, cells[at - 1]));
  pen.save();
  pen.fillStyle = palette.next;
  const pieces = curve(ways);
  const edges = pieces.map((spot, at) => sides(spot, pieces[Math.max(0, at - 1)], pieces[Math.min(pieces.length - 1, at + 1)]));
  for (let at = 1; at < pieces.length; at++) {
    pen.globalAlpha = RIBBON.nearest + (RIBBON.farthest - RIBBON.nearest) * ((at - 1) / Math.max(1, pieces.length - 2));
    const [a, b] = [edges[at - 1], edges[at]];
    shape(pen, [a[0], a[1], b[1], b[0]].map(([column, row]) => eye.spot(column, row)));
    pen.fill();
  }
  ways.slice(1).forEach((cell, at) => {
    pen.globalAlpha = 0.95 - (0.6 * at) / Math.max(1, ways.length - 1);
    chevron(pen, eye, ways[at], cell);
  });
  const waits = cells.slice(1).filter((cell, at) => near(cell, cells[at]));
  if (waits.length > 0) bar(pen, eye, waits[0], palette);
  pen.restore();
}

/** @param {Spot} one @param {Spot} other */
function near(one, other) {
  return Math.hypot(one[0] - other[0], one[1] - other[1]) < 0.01;
}

/** A smooth line through cells (Catmull-Rom). @param {Spot[]} cells @returns {Spot[]} */
function curve(cells) {
  /** @type {Spot[]} */ const line = cells.length > 0 ? [cells[0]] : [];
  for (let at = 0; at + 1 < cells.length; at++) {
    const [from, to] = [cells[at], cells[at + 1]];
    const [before, after] = [cells[at - 1] ?? from, cells[at + 2] ?? to];
    for (let step = 1; step <= RIBBON.steps; step++) {
      const t = step / RIBBON.steps;
      const part = (/** @type {0 | 1} */ axis) =>
        0.5 * (2 * from[axis] + (to[axis] - before[axis]) * t + (2 * before[axis] - 5 * from[axis] + 4 * to[axis] - after[axis]) * t ** 2 + (3 * from[axis] - before[axis] - 3 * to[axis] + after[axis]) * t ** 3);
      line.push([part(0), part(1)]);
    }
  }
  return line;
}

/** Both edges of the band at a spot. @param {Spot} spot @param {Spot} before @param {Spot} after @returns {[Spot, Spot]} */
function sides([column, row], before, after) {
  const [across, along] = [after[0] - before[0], after[1] - before[1]];
  const length = Math.hypot(across, along) || 1;
  const [x, y] = [(-along / length) * RIBBON.half, (across / length) * RIBBON.half];
  return [[column + x, row + y], [column - x, row - y]];
}

/** An arrow head at the cell that a step leads to. @param {Pen} pen @param {Eye} eye @param {Spot} from @param {Spot} to */
function chevron(pen, eye, from, to) {
  const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
  const [x, y] = [(to[0] - from[0]) / length, (to[1] - from[1]) / length];
  const at = (/** @type {number} */ along, /** @type {number} */ aside) => eye.spot(to[0] + x * along - y * aside, to[1] + y * along + x * aside);
  const { half, along } = CHEVRON;
  shape(pen, [at(-along, -half), at(0.02, 0), at(-along, half), at(-along + 0.12, half), at(along + 0.02, 0), at(-along + 0.12, -half)]);
  pen.fill();
}

/** Standing still: a bar across the way ahead. @param {Pen} pen @param {Eye} eye @param {Spot} cell @param {Palette} palette */
function bar(pen, eye, [column, row], palette) {
  flat(pen, eye, column - 0.26, column + 0.26, row - 0.6, row - 0.52);
  pen.globalAlpha = 0.9;
  pen.fillStyle = palette.danger;
  pen.fill();
}

/** Where the vehicle has been, fading with age. @param {Pen} pen @param {Eye} eye @param {Spot[]} cells  oldest first @param {Palette} palette */
export function drawTrail(pen, eye, cells, palette) {
  pen.fillStyle = palette.accent;
  cells.forEach(([column, row], at) => {
    if (row > eye.nearest - 0.1) return;
    pen.globalAlpha = 0.85 * ((at + 1) / cells.length) ** 1.3;
    disc(pen, eye, column, row, 0.055);
    pen.fill();
  });
  pen.globalAlpha = 1;
}

/**
 * The cells of the movers in the ticks to come, the nearest the clearest.
 * @param {Pen} pen
 * @param {Eye} eye
 * @param {Pose[]} poses
 * @param {Record<string, Cell>[]} ahead  their cells by id, the next tick first
 * @param {Palette} palette
 */
export function drawNext(pen, eye, poses, ahead, palette) {
  pen.save();
  for (const { thing: { kind, id }, row, alpha } of poses) {
    if (kind === "av") continue;
    const colour = palette.roadKinds[kind] ?? palette.danger;
    const { across, along } = sizeOf(kind);
    pen.lineWidth = Math.max(1, eye.scale(row) * 0.025);
    let last = NaN;
    ahead.forEach((movers, tick) => {
      const cell = movers[id];
      if (!cell || cell[0] === last) return;
      last = cell[0];
      flat(pen, eye, cell[0] - across / 2, cell[0] + across / 2, cell[1] - along / 2, cell[1] + along / 2);
      pen.fillStyle = pen.strokeStyle = colour;
      pen.globalAlpha = alpha * NEXT_ALPHAS[tick] * 0.22;
      pen.fill();
      pen.globalAlpha = alpha * NEXT_ALPHAS[tick] * 0.9;
      pen.stroke();
    });
  }
  pen.restore();
}

/** A ring around something that matters. @param {Pen} pen @param {Eye} eye @param {Spot} spot @param {string} colour @param {number} alpha @param {number} [radius] */
export function drawRing(pen, eye, [column, row], colour, alpha, radius = 0.49) {
  disc(pen, eye, column, row, radius);
  pen.fillStyle = pen.strokeStyle = colour;
  pen.globalAlpha = alpha * 0.16;
  pen.fill();
  pen.globalAlpha = alpha;
  pen.lineWidth = Math.max(1.2, eye.scale(row) * 0.04);
  pen.stroke();
  pen.globalAlpha = 1;
}

/** A cell that is spoken of, outlined; or one of a hazard, filled. @param {Pen} pen @param {Eye} eye @param {Spot} spot @param {string} colour @param {boolean} filled */
export function drawCell(pen, eye, [column, row], colour, filled) {
  pen.save();
  flat(pen, eye, column - 0.47, column + 0.47, row - 0.47, row + 0.47);
  pen.fillStyle = pen.strokeStyle = colour;
  pen.lineWidth = Math.max(1.2, eye.scale(row) * 0.035);
  if (filled) {
    pen.globalAlpha *= 0.34;
    pen.fill();
    pen.globalAlpha /= 0.34;
  } else pen.setLineDash([pen.lineWidth * 3.5, pen.lineWidth * 2.2]);
  pen.stroke();
  pen.restore();
}

/**
 * What the sensor misses and makes up.
 * @param {Pen} pen
 * @param {Eye} eye
 * @param {Pose[]} poses
 * @param {{missed: Set<string>, madeUp: Spot[]}} marks
 * @param {Palette} palette
 */
export function drawSensed(pen, eye, poses, { missed, madeUp }, palette) {
  pen.save();
  for (const { thing, column, row } of poses) {
    if (!missed.has(thing.id)) continue;
    const scale = eye.scale(row);
    pen.strokeStyle = palette.marking;
    pen.lineWidth = Math.max(1.2, scale * 0.04);
    pen.setLineDash([scale * 0.14, scale * 0.1]);
    disc(pen, eye, column, row, 0.42);
    pen.stroke();
  }
  pen.setLineDash([]);
  pen.strokeStyle = palette.danger;
  for (const [column, row] of madeUp) {
    if (row > eye.nearest - 0.3) continue;
    pen.lineWidth = Math.max(1.2, eye.scale(row) * 0.045);
    pen.beginPath();
    for (const side of [-0.25, 0.25]) {
      pen.moveTo(...eye.spot(column - side, row - 0.25));
      pen.lineTo(...eye.spot(column + side, row + 0.25));
    }
    pen.stroke();
  }
  pen.restore();
}

/** Where bodies touched. @param {Pen} pen @param {Eye} eye @param {Spot} spot @param {(pen: Pen) => void} burst  in cells */
export function drawTouch(pen, eye, [column, row], burst) {
  upright(pen, eye, column, row, () => {
    pen.translate(0, -0.12);
    burst(pen);
  });
}
