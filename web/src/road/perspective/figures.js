// @ts-check
/** What stands or gapes on the road, in perspective: pedestrians, barriers, cones, potholes. */

import { SIZES } from "../collisionGeometry.js";
import { cracksOf, rimOf } from "../paint/hazards.js";
import { hash, seeded } from "../random.js";
import { shadow, shape, upright } from "./solids.js";

/** @import { Palette } from "../../core/theme.js" */
/** @import { Pose } from "../motion.js" */
/** @import { Eye } from "./eye.js" */

/** @typedef {CanvasRenderingContext2D} Pen */

const SHIRTS = ["#e4572e", "#2a9d8f", "#f2b134", "#9b5de5", "#ef798a", "#4c9f70", "#e9ecef"];
const HAIR = ["#2b1d14", "#5a3a22", "#8d6a43", "#1b1b1f", "#b9a27c"];

/** @param {Pen} pen @param {Eye} eye @param {Pose} pose @param {Palette} palette */
export function drawPedestrian(pen, eye, { thing, column, row, facing, stride }, palette) {
  const random = seeded(thing.id);
  const shirt = SHIRTS[Math.floor(random() * SHIRTS.length)];
  const hair = HAIR[Math.floor(random() * HAIR.length)];
  shadow(pen, eye, column, row, thing.disabled ? 0.3 : 0.12, 0.08, palette);
  const swing = 0.07 * Math.sin(stride * 2 * Math.PI);
  upright(pen, eye, column, row, () => {
    if (thing.disabled) pen.transform(0, -0.35, 1, 0, 0.18, -0.05); // lying on the ground
    else if (facing > Math.PI / 2) pen.scale(-1, 1);
    pen.lineCap = "round";
    pen.strokeStyle = "#232a38";
    pen.lineWidth = 0.055;
    for (const side of [-1, 1]) {
      pen.beginPath();
      pen.moveTo(0, -0.17);
      pen.lineTo(side * swing + side * 0.018, -0.025);
      pen.stroke();
    }
    pen.strokeStyle = shirt;
    pen.lineWidth = 0.1;
    pen.beginPath();
    pen.moveTo(0, -0.26);
    pen.lineTo(0, -0.19);
    pen.stroke();
    pen.strokeStyle = "#d9a57c";
    pen.lineWidth = 0.035;
    pen.beginPath();
    pen.moveTo(0.01, -0.265);
    pen.lineTo(-swing * 0.9 + 0.01, -0.16);
    pen.stroke();
    for (const [x, y, size, colour] of /** @type {const} */ ([[0, -0.362, 0.052, hair], [0.014, -0.352, 0.042, "#d9a57c"]])) {
      pen.fillStyle = colour;
      pen.beginPath();
      pen.arc(x, y, size, 0, 2 * Math.PI);
      pen.fill();
    }
  });
}

/** A barricade, or three cones: the id decides, as in the view from above. @param {Pen} pen @param {Eye} eye @param {Pose} pose @param {Palette} palette */
export function drawBarrier(pen, eye, { thing, column, row }, palette) {
  const { across, along } = SIZES.barrier;
  const cones = hash(thing.id) % 3 === 0;
  shadow(pen, eye, column, row, across, cones ? 0.12 : along, palette);
  if (cones) for (const aside of [-0.225, 0, 0.225]) upright(pen, eye, column + aside, row, () => cone(pen));
  else upright(pen, eye, column, row, () => barricade(pen, across / 2));
}

/** @param {Pen} pen  in cells, upright @param {number} reach */
function barricade(pen, reach) {
  pen.fillStyle = "#3a3f48";
  for (const x of [-0.24, 0.24]) {
    shape(pen, [[x - 0.07, 0.02], [x - 0.02, -0.24], [x + 0.02, -0.24], [x + 0.07, 0.02], [x + 0.035, 0.02], [x, -0.16], [x - 0.035, 0.02]]);
    pen.fill();
  }
  for (const top of [-0.25, -0.13]) {
    const high = top === -0.25 ? 0.1 : 0.07;
    pen.save();
    pen.beginPath();
    pen.roundRect(-reach, top, 2 * reach, high, 0.02);
    pen.fillStyle = "#f6f4ef";
    pen.fill();
    pen.clip();
    pen.fillStyle = "#d6402f";
    for (let x = -reach - 0.1; x < reach; x += 0.17) {
      shape(pen, [[x, top + high], [x + 0.08, top + high], [x + 0.15, top], [x + 0.07, top]]);
      pen.fill();
    }
    pen.restore();
  }
  pen.fillStyle = "#f4b23c";
  for (const x of [-0.24, 0.24]) {
    pen.beginPath();
    pen.arc(x, -0.275, 0.03, 0, 2 * Math.PI);
    pen.fill();
  }
}

/** @param {Pen} pen  in cells, upright */
function cone(pen) {
  pen.fillStyle = "#b8431a";
  pen.beginPath();
  pen.roundRect(-0.1, -0.025, 0.2, 0.04, 0.012);
  pen.fill();
  for (const [low, high, colour] of /** @type {const} */ ([[0, 0.27, "#ef6a2c"], [0.09, 0.15, "#fbf3ea"]])) {
    const wide = (/** @type {number} */ up) => 0.078 * (1 - up / 0.31);
    shape(pen, [[-wide(low), -low], [-wide(high), -high], [wide(high), -high], [wide(low), -low]]);
    pen.fillStyle = colour;
    pen.fill();
  }
}

/** A hole in the ground, with the cracks around it. @param {Pen} pen @param {Eye} eye @param {Pose} pose @param {Palette} palette */
export function drawPothole(pen, eye, { thing, column, row }, palette) {
  const rim = rimOf(thing.id);
  const unit = eye.scale(row);
  const outline = (/** @type {number} */ by, near = 0) => rim.map(([x, y]) => eye.spot(column + by * x, row + by * y + near));
  pen.lineJoin = "round";
  pen.lineWidth = Math.max(0.6, 0.014 * unit);
  pen.strokeStyle = palette.crack;
  pen.beginPath();
  for (const crack of cracksOf(thing.id)) {
    crack.forEach(([x, y], at) => {
      const spot = eye.spot(column + x, row + y);
      if (at === 0) pen.moveTo(...spot);
      else pen.lineTo(...spot);
    });
  }
  pen.stroke();
  for (const [by, near, colour] of /** @type {const} */ ([[1.12, 0, palette.asphaltDeep], [1, 0, palette.crack], [0.93, 0.02, palette.hole], [0.62, 0.03, "#08090b"]])) {
    shape(pen, outline(by, near));
    pen.fillStyle = colour;
    pen.fill();
  }
}
