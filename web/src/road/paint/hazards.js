// @ts-check
/** What lies on the road, each within its box: potholes whose cracks are drawn from their id, barricades, cones. */

import { SIZES } from "../collisionGeometry.js";
import { hash, seeded } from "../random.js";
import { blob, box, castShadow } from "./shapes.js";

/** @import { Palette } from "../../core/theme.js" */

/** @typedef {CanvasRenderingContext2D} Pen */
/** @typedef {[number, number]} Point */

const RIM_POINTS = 13;
/** Half a pothole's box, in cells. */
const HALF = SIZES.pothole.across / 2;
/** How much wider than its rim the broken ground around it is. */
const CRUMBLING = 1.1;
/** Half of a barrier's length and depth. */
const [REACH, DEPTH] = [SIZES.barrier.across / 2, SIZES.barrier.along / 2];

/**
 * The outline of a pothole, in cells around its centre.
 * @param {string} id
 * @returns {Point[]}
 */
export function rimOf(id) {
  const random = seeded(id);
  const squash = 0.86 + 0.14 * random();
  const tilt = random() * Math.PI;
  return Array.from({ length: RIM_POINTS }, (_, at) => {
    const angle = (at / RIM_POINTS) * 2 * Math.PI;
    const radius = (HALF / CRUMBLING) * (0.78 + 0.22 * random());
    const x = Math.cos(angle) * radius;
    const y = Math.sin(angle) * radius * squash;
    return /** @type {Point} */ ([
      x * Math.cos(tilt) - y * Math.sin(tilt),
      x * Math.sin(tilt) + y * Math.cos(tilt),
    ]);
  });
}

/**
 * The cracks around a pothole: polylines from its rim outwards, some with a branch.
 * @param {string} id
 * @returns {Point[][]}
 */
export function cracksOf(id) {
  const random = seeded(`${id} cracks`);
  const rim = rimOf(id);
  const cracks = [];
  const count = 5 + Math.floor(random() * 4);
  for (let at = 0; at < count; at++) {
    const start = rim[Math.floor(((at + random() * 0.8) / count) * RIM_POINTS) % RIM_POINTS];
    const crack = wander([start[0] * 0.92, start[1] * 0.92], Math.atan2(start[1], start[0]), 3, 0.03, random);
    cracks.push(crack);
    if (random() < 0.5) {
      const turn = random() < 0.5 ? 0.9 : -0.9;
      cracks.push(wander(crack[1], Math.atan2(start[1], start[0]) + turn, 2, 0.025, random));
    }
  }
  return cracks;
}

/**
 * @param {Point} from
 * @param {number} angle
 * @param {number} steps
 * @param {number} stride  shortest step, in cells
 * @param {() => number} random
 * @returns {Point[]}
 */
function wander(from, angle, steps, stride, random) {
  const line = [from];
  let [x, y] = from;
  let heading = angle;
  for (let step = 0; step < steps; step++) {
    heading += (random() - 0.5) * 1.1;
    const length = stride * (0.7 + 0.9 * random());
    x = inside(x + Math.cos(heading) * length);
    y = inside(y + Math.sin(heading) * length);
    line.push([x, y]);
  }
  return line;
}

/** @param {number} value */
function inside(value) {
  const most = HALF - 0.012;
  return Math.max(-most, Math.min(most, value));
}

/** @param {Pen} pen @param {string} id @param {Palette} palette */
export function paintPothole(pen, id, palette) {
  const rim = rimOf(id);
  const scaled = (/** @type {number} */ by, dx = 0, dy = 0) =>
    rim.map(([x, y]) => /** @type {Point} */ ([x * by + dx, y * by + dy]));
  pen.lineJoin = pen.lineCap = "round";
  pen.strokeStyle = palette.crack;
  for (const crack of cracksOf(id)) {
    for (let at = 1; at < crack.length; at++) {
      pen.lineWidth = 0.022 * (1 - (at - 1) / crack.length);
      pen.globalAlpha = 0.9 - 0.55 * ((at - 1) / crack.length);
      pen.beginPath();
      pen.moveTo(...crack[at - 1]);
      pen.lineTo(...crack[at]);
      pen.stroke();
    }
  }
  pen.fillStyle = palette.asphaltDeep;
  pen.globalAlpha = 0.85;
  blob(pen, scaled(CRUMBLING));
  pen.fill();
  pen.fillStyle = palette.edge;
  pen.globalAlpha = 0.28;
  blob(pen, scaled(1.02, 0, 0.016));
  pen.fill();
  pen.globalAlpha = 1;
  const depth = pen.createRadialGradient(0.015, 0.035, 0.02, 0, 0, 0.27);
  depth.addColorStop(0, palette.asphaltDeep);
  depth.addColorStop(0.5, palette.hole);
  depth.addColorStop(1, "#08090b");
  pen.fillStyle = depth;
  blob(pen, scaled(0.98));
  pen.fill();
  pen.save();
  blob(pen, scaled(0.98));
  pen.clip();
  rubble(pen, id, palette);
  pen.strokeStyle = "rgb(0 0 0 / 0.65)";
  pen.lineWidth = 0.06;
  blob(pen, scaled(1, 0, 0.0));
  pen.stroke();
  pen.restore();
}

/** @param {Pen} pen @param {string} id @param {Palette} palette */
function rubble(pen, id, palette) {
  const random = seeded(`${id} rubble`);
  for (let stone = 0; stone < 12; stone++) {
    const x = (random() - 0.5) * 0.32;
    const y = (random() - 0.5) * 0.32;
    pen.fillStyle = random() < 0.5 ? palette.asphalt : palette.crack;
    pen.globalAlpha = 0.55;
    pen.beginPath();
    pen.ellipse(x, y, 0.01 + 0.016 * random(), 0.008 + 0.01 * random(), random() * 3, 0, 2 * Math.PI);
    pen.fill();
  }
  pen.globalAlpha = 1;
}

/**
 * A barricade, or three cones: which one, the id decides.
 * @param {Pen} pen
 * @param {string} id
 * @param {Palette} palette
 */
export function paintBarrier(pen, id, palette) {
  if (hash(id) % 3 === 0) {
    for (const [x, y] of /** @type {Point[]} */ ([[-0.225, 0.03], [0, -0.03], [0.225, 0.03]])) cone(pen, x, y, palette);
  } else {
    barricade(pen, palette);
  }
}

/** @param {Pen} pen @param {Palette} palette */
function barricade(pen, palette) {
  castShadow(pen, palette.shadow, 0.05, () => {
    box(pen, 0.015, 0.04, 2 * REACH, 0.18, 0.035);
    pen.fill();
  });
  pen.fillStyle = "#33373f";
  for (const x of [-0.235, 0.235]) {
    box(pen, x, 0, 0.065, 2 * DEPTH, 0.025);
    pen.fill();
  }
  pen.save();
  box(pen, 0, 0, 2 * REACH, 0.16, 0.035);
  pen.fillStyle = "#f6f4ef";
  pen.fill();
  pen.clip();
  pen.fillStyle = "#d6402f";
  for (let x = -0.48; x < 0.48; x += 0.17) {
    pen.beginPath();
    pen.moveTo(x, 0.08);
    pen.lineTo(x + 0.08, 0.08);
    pen.lineTo(x + 0.19, -0.08);
    pen.lineTo(x + 0.11, -0.08);
    pen.closePath();
    pen.fill();
  }
  const sheen = pen.createLinearGradient(0, -0.08, 0, 0.08);
  sheen.addColorStop(0, "rgb(255 255 255 / 0.3)");
  sheen.addColorStop(0.5, "rgb(255 255 255 / 0)");
  sheen.addColorStop(1, "rgb(0 0 0 / 0.22)");
  pen.fillStyle = sheen;
  pen.fillRect(-REACH, -0.08, 2 * REACH, 0.16);
  pen.restore();
  for (const x of [-0.235, 0.235]) {
    pen.fillStyle = "#f4b23c";
    pen.beginPath();
    pen.arc(x, 0, 0.038, 0, 2 * Math.PI);
    pen.fill();
  }
}

/** @param {Pen} pen @param {number} x @param {number} y @param {Palette} palette */
function cone(pen, x, y, palette) {
  castShadow(pen, palette.shadow, 0.05, () => {
    box(pen, x + 0.02, y + 0.03, 0.2, 0.2, 0.045);
    pen.fill();
  });
  pen.fillStyle = "#b8431a";
  box(pen, x, y, 0.2, 0.2, 0.045);
  pen.fill();
  const rings = /** @type {[number, string][]} */ ([[0.083, "#ef6a2c"], [0.061, "#fbf3ea"], [0.043, "#ef6a2c"], [0.019, "#8d3313"]]);
  for (const [radius, colour] of rings) {
    pen.fillStyle = colour;
    pen.beginPath();
    pen.arc(x, y, radius, 0, 2 * Math.PI);
    pen.fill();
  }
}
