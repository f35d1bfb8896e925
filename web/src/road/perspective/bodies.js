// @ts-check
/** What is on the road, in perspective: vehicles as solids, their lamps, light and boxes. */

import { SIZES } from "../collisionGeometry.js";
import { lookOf } from "../paint/vehicle.js";
import { drawBarrier, drawPedestrian } from "./figures.js";
import { face, level, shadow, shape, solid, upright } from "./solids.js";

/** @import { Move } from "../../core/protocol.js" */
/** @import { Palette } from "../../core/theme.js" */
/** @import { Pose } from "../motion.js" */
/** @import { Eye } from "./eye.js" */
/** @import { Faces, Level } from "./solids.js" */

/** @typedef {CanvasRenderingContext2D} Pen */
/** @typedef {{main: string, light: string, dark: string}} Paint */

const EGO = { main: "#2f6fed", light: "#5c93ff", dark: "#1a48ad" };
const GLASS = { near: "#1c2532", side: "#151c27", top: "#27303f" };
const CARGO = { near: "#dfe3e9", side: "#b9bfc9", top: "#f7f8fa" };
const TYRE = "#14161a";
/** Heights above the road, in cells: of the ground below a car, its bonnet, its roof by body. */
const SILL = 0.05;
const BONNET = 0.16;
const ROOFS = { saloon: 0.265, hatch: 0.27, van: 0.32, truck: 0.38 };
/** Wheels, lamps and posts between windows are not seen where cells are smaller [px]. */
const DETAILED_FROM_PX = 22;
/** The names of boxes would lie over one another where cells are smaller [px]. */
const NAMED_FROM_PX = 30;
/** Where a cabin begins and ends along a car, from its middle to the front, and how much it narrows. */
const CABINS = { saloon: [-0.2, 0.12], hatch: [-0.28, 0.1], van: [-0.31, 0.16] };

/**
 * @param {Pen} pen
 * @param {Eye} eye
 * @param {Pose} pose
 * @param {Palette} palette
 * @param {{move: Move | null, blink: boolean}} signal  what the autonomous vehicle's lamps show
 */
export function drawBody(pen, eye, pose, palette, signal) {
  const { thing, column, row } = pose;
  if (thing.kind === "av") drawEgo(pen, eye, column, row, palette, signal);
  else if (thing.kind === "vehicle") drawVehicle(pen, eye, pose, palette);
  else if (thing.kind === "pedestrian") drawPedestrian(pen, eye, pose, palette);
  else if (thing.kind === "barrier") drawBarrier(pen, eye, pose, palette);
  else drawUnknown(pen, eye, column, row, palette);
}

/** How high a thing is, in cells. @param {{kind: string, id: string, disabled: boolean}} thing */
export function heightOf({ kind, id, disabled }) {
  if (kind === "vehicle") return ROOFS[lookOf(id, disabled).body];
  return { av: 0.31, pedestrian: disabled ? 0.1 : 0.4, barrier: 0.26, pothole: 0 }[kind] ?? 0.2;
}

/** The bodywork below the windows: the light comes from above. @param {Paint} paint @returns {Faces} */
function painted({ main, dark }) {
  return { top: main, near: mixed(main, dark), side: dark };
}

/** Halfway between two colours. @param {string} one @param {string} other  as #rrggbb */
function mixed(one, other) {
  const key = one + other;
  const known = MIXED.get(key);
  if (known) return known;
  const parts = [1, 3, 5].map((at) => (parseInt(one.slice(at, at + 2), 16) + parseInt(other.slice(at, at + 2), 16)) >> 1);
  const made = `rgb(${parts.join(" ")})`;
  MIXED.set(key, made);
  return made;
}

/** @type {Map<string, string>} */
const MIXED = new Map();

/**
 * Windows all around and a roof over them, with a post between the windows of the side that is seen.
 * @param {Pen} pen
 * @param {Eye} eye
 * @param {Level} foot
 * @param {Level} top
 * @param {{light: string, main: string}} paint
 * @param {number} [post]  its column
 */
function cabin(pen, eye, foot, top, { light, main }, post) {
  solid(pen, eye, foot, top, { ...GLASS, top: main });
  const roof = { ...top, left: top.left + 0.012, right: top.right - 0.012, far: top.far + 0.012, near: top.near - 0.012 };
  face(pen, [eye.spot(roof.left, roof.far, top.up), eye.spot(roof.right, roof.far, top.up), eye.spot(roof.right, roof.near, top.up), eye.spot(roof.left, roof.near, top.up)], light);
  if (post === undefined || eye.scale(foot.near) < DETAILED_FROM_PX) return;
  pen.strokeStyle = main;
  pen.lineWidth = eye.scale(foot.near) * 0.022;
  pen.beginPath();
  pen.moveTo(...eye.spot(post, foot.near, foot.up));
  pen.lineTo(...eye.spot(post, top.near, top.up));
  pen.stroke();
}

/**
 * A car that goes from left to right or back: a body, a cabin of glass, a roof, wheels and lamps on the near side.
 * @param {Pen} pen
 * @param {Eye} eye
 * @param {Pose} pose
 * @param {Palette} palette
 */
function drawVehicle(pen, eye, { thing, column, row, facing }, palette) {
  const { across, along } = SIZES.vehicle;
  const { body, paint } = lookOf(thing.id, thing.disabled);
  const front = facing < Math.PI / 2 ? 1 : -1;
  shadow(pen, eye, column, row, across, along, palette);
  wheels(pen, eye, [column - 0.19, column + 0.19], row + along / 2);
  if (body === "truck") truck(pen, eye, column, row, front, paint);
  else {
    const faces = painted(paint);
    const roof = ROOFS[body];
    solid(pen, eye, level(column, row, across, along, SILL), level(column, row, across - 0.03, along - 0.02, BONNET), faces);
    const [from, to] = CABINS[body].map((at) => column + front * at).sort((a, b) => a - b);
    const foot = { left: from, right: to, far: row - along * 0.44, near: row + along * 0.44, up: BONNET };
    const top = { left: from + 0.05, right: to - 0.05, far: row - along * 0.36, near: row + along * 0.36, up: roof };
    cabin(pen, eye, foot, top, paint, (from + to) / 2 - front * 0.02);
  }
  lamp(pen, eye, column + front * (across / 2 - 0.03), row + along / 2, 0.12, "#fff3cf");
  lamp(pen, eye, column - front * (across / 2 - 0.025), row + along / 2, 0.12, "#d3342d");
  if (thing.disabled) upright(pen, eye, column, row, () => warning(pen));
}

/** @param {Pen} pen @param {Eye} eye @param {number} column @param {number} row @param {number} front  1 to the right, -1 to the left @param {Paint} paint */
function truck(pen, eye, column, row, front, paint) {
  const along = SIZES.vehicle.along - 0.02;
  const load = { at: column - front * 0.1, across: 0.45 };
  const cab = { at: column + front * 0.235, across: 0.18 };
  const parts = [
    () => solid(pen, eye, level(load.at, row, load.across, along, 0.09), level(load.at, row, load.across, along, ROOFS.truck), CARGO),
    () => {
      solid(pen, eye, level(cab.at, row, cab.across, along, SILL), level(cab.at, row, cab.across, along, 0.17), painted(paint));
      cabin(pen, eye, level(cab.at, row, cab.across, along, 0.17), level(cab.at - front * 0.02, row, cab.across - 0.05, along - 0.03, 0.29), paint);
    },
  ];
  // What is further from the eye's column is behind.
  if (Math.abs(load.at - eye.x) < Math.abs(cab.at - eye.x)) parts.reverse();
  for (const draw of parts) draw();
  face(pen, [[-0.2, 0.2], [0.2, 0.2], [0.2, 0.27], [-0.2, 0.27]].map(([x, up]) => eye.spot(load.at + x, row + along / 2, up)), paint.main);
}

/** The autonomous vehicle from behind. @param {Pen} pen @param {Eye} eye @param {number} column @param {number} row @param {Palette} palette @param {{move: Move | null, blink: boolean}} signal */
function drawEgo(pen, eye, column, row, palette, { move, blink }) {
  const { across, along } = SIZES.av;
  const rear = row + along / 2;
  shadow(pen, eye, column, row, across, along, palette);
  wheels(pen, eye, [column - across / 2 + 0.035, column + across / 2 - 0.035], rear);
  solid(pen, eye, level(column, row, across, along, SILL), level(column, row, across - 0.02, along - 0.05, BONNET + 0.01), painted(EGO));
  const foot = { left: column - 0.14, right: column + 0.14, far: row - 0.16, near: row + 0.26, up: BONNET + 0.01 };
  const top = { left: column - 0.115, right: column + 0.115, far: row - 0.05, near: row + 0.17, up: 0.28 };
  cabin(pen, eye, foot, top, EGO);
  // The sensor on the roof.
  const [x, y] = eye.spot(column, row + 0.06, 0.29);
  const unit = eye.scale(row);
  for (const [size, colour, rise] of /** @type {const} */ ([[0.06, "#0d1728", 0], [0.052, "#dfe9ff", 0.018], [0.026, EGO.main, 0.022]])) {
    pen.fillStyle = colour;
    pen.beginPath();
    pen.ellipse(x, y - rise * unit, size * unit, size * 0.62 * unit, 0, 0, 2 * Math.PI);
    pen.fill();
  }
  for (const side of [-1, 1]) {
    const turning = blink && move !== null && move.endsWith(side < 0 ? "left" : "right");
    const [colour, glow] = turning ? ["#ffb02e", true] : move === "stay" ? ["#ff3c32", true] : ["#c42a24", false];
    lamp(pen, eye, column + side * (across / 2 - 0.045), rear, 0.12, colour, glow);
  }
}

/** @param {Pen} pen @param {Eye} eye @param {number[]} columns @param {number} row  of the side that is seen */
function wheels(pen, eye, columns, row) {
  const unit = eye.scale(row);
  if (unit < DETAILED_FROM_PX) return;
  pen.fillStyle = TYRE;
  for (const column of columns) {
    const [x, y] = eye.spot(column, row, 0.045);
    pen.beginPath();
    pen.ellipse(x, y, 0.05 * unit, 0.05 * unit, 0, 0, 2 * Math.PI);
    pen.fill();
  }
}

/** @param {Pen} pen @param {Eye} eye @param {number} column @param {number} row @param {number} up @param {string} colour @param {boolean} [glow] */
function lamp(pen, eye, column, row, up, colour, glow = false) {
  const [x, y] = eye.spot(column, row, up);
  const unit = eye.scale(row);
  if (unit < DETAILED_FROM_PX && !glow) return;
  if (glow) {
    const light = pen.createRadialGradient(x, y, 0, x, y, 0.13 * unit);
    light.addColorStop(0, colour);
    light.addColorStop(1, "rgb(255 120 46 / 0)");
    pen.fillStyle = light;
    pen.fillRect(x - 0.13 * unit, y - 0.13 * unit, 0.26 * unit, 0.26 * unit);
  }
  pen.fillStyle = colour;
  pen.beginPath();
  pen.ellipse(x, y, 0.032 * unit, 0.02 * unit, 0, 0, 2 * Math.PI);
  pen.fill();
}

/** Over a vehicle that will not move again. @param {Pen} pen  in cells, upright */
function warning(pen) {
  pen.lineJoin = "round";
  pen.lineWidth = 0.04;
  pen.strokeStyle = "#d0342c";
  pen.fillStyle = "#fff";
  shape(pen, [[0, -0.6], [0.11, -0.42], [-0.11, -0.42]]);
  pen.stroke();
  pen.fill();
  pen.fillStyle = "#1b1f27";
  pen.fillRect(-0.012, -0.55, 0.024, 0.075);
  pen.fillRect(-0.012, -0.46, 0.024, 0.024);
}

/** A kind this page does not know yet is still seen. @param {Pen} pen @param {Eye} eye @param {number} column @param {number} row @param {Palette} palette */
function drawUnknown(pen, eye, column, row, palette) {
  const colour = palette.danger;
  solid(pen, eye, level(column, row, 0.5, 0.5, 0), level(column, row, 0.5, 0.5, 0.2), { top: colour, near: colour, side: colour });
}

/** The light that a vehicle throws ahead of it. @param {Pen} pen @param {Eye} eye @param {Pose} pose @param {number} strength  0–1 */
export function drawBeam(pen, eye, { thing, column, row, facing }, strength) {
  const ahead = thing.kind === "av" ? [0, -1] : [facing < Math.PI / 2 ? 1 : -1, 0];
  const [start, reach] = [0.3, 1.5];
  const beam = (/** @type {number} */ along, /** @type {number} */ aside) =>
    eye.spot(column + ahead[0] * along + ahead[1] * aside, row + ahead[1] * along + ahead[0] * aside);
  const [from, to] = [beam(start, 0), beam(reach, 0)];
  const light = pen.createLinearGradient(...from, ...to);
  light.addColorStop(0, `rgb(255 246 214 / ${0.32 * strength})`);
  light.addColorStop(1, "rgb(255 246 214 / 0)");
  pen.fillStyle = light;
  for (const wide of [0.28, 0.42]) {
    shape(pen, [beam(start, -0.12), beam(reach, -wide), beam(reach, wide), beam(start, 0.12)]);
    pen.fill();
  }
}

/**
 * The edges of a box around a body, as a detector would draw them, with its name.
 * @param {Pen} pen
 * @param {Eye} eye
 * @param {Pose} pose
 * @param {{across: number, along: number}} size
 * @param {string} colour
 */
export function drawBox(pen, eye, { thing, column, row }, { across, along }, colour) {
  /** @type {Level[]} */
  const [foot, top] = [0, Math.max(0.06, heightOf(thing))].map((up) => level(column, row, across, along, up));
  pen.strokeStyle = pen.fillStyle = colour;
  pen.lineWidth = Math.max(1, eye.scale(row) * 0.02);
  const corners = (/** @type {Level} */ { left, right, far, near, up }) => [eye.spot(left, far, up), eye.spot(right, far, up), eye.spot(right, near, up), eye.spot(left, near, up)];
  const [low, high] = [corners(foot), corners(top)];
  for (const ring of [low, high]) {
    shape(pen, ring);
    pen.stroke();
  }
  pen.beginPath();
  low.forEach((spot, at) => {
    pen.moveTo(...spot);
    pen.lineTo(...high[at]);
  });
  pen.stroke();
  if (eye.scale(row) < NAMED_FROM_PX) return;
  pen.font = `600 ${Math.max(9, eye.scale(row) * 0.15)}px system-ui, sans-serif`;
  pen.textAlign = "left";
  pen.textBaseline = "bottom";
  pen.fillText(thing.id, high[0][0], high[0][1] - 2);
}
