// @ts-check
/** Vehicles from above, facing right, one cell being the unit; all that is solid stays within a vehicle's box. */

import { SIZES as SIZES } from "../collisionGeometry.js";
import { seeded } from "../random.js";
import { box, castShadow, disc } from "./shapes.js";

/** @import { Palette } from "../../core/theme.js" */

/** @typedef {CanvasRenderingContext2D} Pen */

/**
 * @typedef {object} Look
 * @property {string} key  equal for vehicles that look the same
 * @property {"saloon" | "hatch" | "van" | "truck"} body
 * @property {{main: string, light: string, dark: string}} paint
 */

const PAINTS = [
  { main: "#c8453b", light: "#e2685d", dark: "#93291f" },
  { main: "#d98a2b", light: "#f0ab55", dark: "#a1621a" },
  { main: "#e3c24a", light: "#f4dc7d", dark: "#ae8f23" },
  { main: "#4f8f5b", light: "#74b480", dark: "#33663d" },
  { main: "#8b5aa8", light: "#ad80c7", dark: "#633b7c" },
  { main: "#c25a84", light: "#de84a8", dark: "#8f3a5d" },
  { main: "#d9dce1", light: "#f6f7f9", dark: "#a4a9b3" },
  { main: "#7f8ea6", light: "#a6b3c8", dark: "#566277" },
];
const BODIES = /** @type {const} */ (["saloon", "hatch", "saloon", "van", "hatch", "truck"]);
const DISABLED = { main: "#7d7f84", light: "#94969b", dark: "#56585d" };
const EGO = { main: "#2f6fed", light: "#5c93ff", dark: "#1a48ad" };
/** Cones laid over one another, so that a beam is soft at its sides; in cells at its far end. */
const BEAM_SPREADS = [0.08, 0.13, 0.18, 0.23, 0.28, 0.33];
const GLASS = "#1a222e";

/** Of every vehicle, in cells: one faces along its box, the other across. */
const LENGTH = SIZES.vehicle.across;
const WIDTH = SIZES.vehicle.along;
export const EGO_LENGTH = SIZES.av.along;
export const EGO_WIDTH = SIZES.av.across;
/** How far mirrors and wheels stand out from the bodywork on either side. */
const STANDS_OUT = 0.01;

/**
 * The look a vehicle has for life.
 * @param {string} id
 * @param {boolean} disabled
 * @returns {Look}
 */
export function lookOf(id, disabled) {
  const random = seeded(id);
  const body = BODIES[Math.floor(random() * BODIES.length)];
  const colour = Math.floor(random() * PAINTS.length);
  return disabled
    ? { key: `${body} disabled`, body, paint: DISABLED }
    : { key: `${body} ${colour}`, body, paint: PAINTS[colour] };
}

/** @param {Pen} pen @param {Palette} palette */
export function paintVehicleShadow(pen, palette) {
  castShadow(pen, palette.shadow, 0.06, () => {
    box(pen, 0, 0, LENGTH, WIDTH, 0.08);
    pen.fill();
  });
}

/** @param {Pen} pen @param {Look} look */
export function paintVehicle(pen, look) {
  wheels(pen, LENGTH, WIDTH);
  const width = WIDTH - 2 * STANDS_OUT;
  if (look.body === "truck") {
    truck(pen, look.paint, LENGTH, width);
  } else {
    shell(pen, look.paint, LENGTH, width, look.body === "van" ? 0.06 : 0.1);
    const long = look.body === "saloon";
    cabin(pen, look.paint, LENGTH, width, long ? 0.5 : look.body === "van" ? 0.68 : 0.58, long ? -0.025 : -0.06);
  }
  lamps(pen, LENGTH, width);
}

/**
 * The autonomous vehicle: blue, with its sensor on the roof.
 * @param {Pen} pen
 */
export function paintEgo(pen) {
  wheels(pen, EGO_LENGTH, EGO_WIDTH);
  const width = EGO_WIDTH - 2 * STANDS_OUT;
  shell(pen, EGO, EGO_LENGTH, width, 0.11);
  cabin(pen, EGO, EGO_LENGTH, width, 0.54, -0.03);
  pen.fillStyle = "rgb(255 255 255 / 0.9)";
  box(pen, 0.24, 0, 0.01, width * 0.5, 0.005);
  pen.fill();
  lamps(pen, EGO_LENGTH, width);
  pen.fillStyle = "#0d1728";
  disc(pen, -0.045, 0, 0.058);
  pen.fillStyle = "#dfe9ff";
  disc(pen, -0.045, 0, 0.039);
  pen.fillStyle = EGO.main;
  disc(pen, -0.045, 0, 0.02);
}

/**
 * The light thrown ahead.
 * @param {Pen} pen
 * @param {number} strength  0–1
 */
export function paintBeams(pen, strength) {
  for (const side of [-1, 1]) {
    const y = side * WIDTH * 0.3;
    const glow = pen.createRadialGradient(0.32, y, 0.02, 0.4, y, 0.9);
    glow.addColorStop(0, `rgb(255 246 214 / ${0.16 * strength})`);
    glow.addColorStop(1, "rgb(255 246 214 / 0)");
    pen.fillStyle = glow;
    for (const spread of BEAM_SPREADS) {
      pen.beginPath();
      pen.moveTo(0.31, y - 0.025);
      pen.lineTo(1.3, y - spread + side * 0.06);
      pen.lineTo(1.3, y + spread + side * 0.06);
      pen.lineTo(0.31, y + 0.025);
      pen.closePath();
      pen.fill();
    }
  }
}

/** @param {Pen} pen @param {number} length @param {number} width */
function wheels(pen, length, width) {
  pen.fillStyle = "#15171b";
  for (const x of [-0.29, 0.27]) {
    for (const side of [-1, 1]) {
      box(pen, x * length * 1.08, side * (width / 2 - 0.02), 0.12, 0.04, 0.016);
      pen.fill();
    }
  }
}

/**
 * @param {Pen} pen
 * @param {Look["paint"]} paint
 * @param {number} length
 * @param {number} width
 * @param {number} nose  radius of the front corners
 */
function shell(pen, paint, length, width, nose) {
  const sheen = pen.createLinearGradient(0, -width / 2, 0, width / 2);
  sheen.addColorStop(0, paint.light);
  sheen.addColorStop(0.28, paint.main);
  sheen.addColorStop(0.75, paint.main);
  sheen.addColorStop(1, paint.dark);
  pen.fillStyle = sheen;
  box(pen, 0, 0, length, width, [0.07, nose, nose, 0.07]);
  pen.fill();
  pen.lineWidth = 0.01;
  pen.strokeStyle = "rgb(0 0 0 / 0.3)";
  box(pen, 0, 0, length - 0.01, width - 0.01, [0.065, nose, nose, 0.065]);
  pen.stroke();
  pen.fillStyle = paint.dark;
  for (const side of [-1, 1]) {
    box(pen, length * 0.13, side * (width / 2 + STANDS_OUT - 0.016), 0.04, 0.032, 0.014);
    pen.fill();
  }
}

/**
 * @param {Pen} pen
 * @param {Look["paint"]} paint
 * @param {number} length
 * @param {number} width
 * @param {number} share  of the length that is cabin
 * @param {number} shift  of its middle, in cells
 */
function cabin(pen, paint, length, width, share, shift) {
  const size = length * share;
  pen.fillStyle = GLASS;
  box(pen, shift, 0, size, width * 0.84, [0.055, 0.08, 0.08, 0.055]);
  pen.fill();
  const sky = pen.createLinearGradient(shift, -width / 2, shift + size / 2, width / 2);
  sky.addColorStop(0, "rgb(190 215 245 / 0.5)");
  sky.addColorStop(0.5, "rgb(190 215 245 / 0.08)");
  pen.fillStyle = sky;
  pen.fill();
  const roof = pen.createLinearGradient(0, -width / 2, 0, width / 2);
  roof.addColorStop(0, paint.light);
  roof.addColorStop(0.5, paint.main);
  roof.addColorStop(1, paint.dark);
  pen.fillStyle = roof;
  box(pen, shift - 0.016, 0, size * 0.54, width * 0.7, 0.04);
  pen.fill();
}

/** @param {Pen} pen @param {Look["paint"]} paint @param {number} length @param {number} width */
function truck(pen, paint, length, width) {
  const cab = length * 0.28;
  pen.fillStyle = "#22252b";
  box(pen, 0, 0, length * 0.9, width * 0.5, 0.02);
  pen.fill();
  pen.save();
  pen.translate(length / 2 - cab / 2, 0);
  shell(pen, paint, cab, width * 0.94, 0.07);
  pen.fillStyle = GLASS;
  box(pen, 0.025, 0, 0.055, width * 0.76, 0.024);
  pen.fill();
  pen.restore();
  const load = length * 0.68;
  const canvas = pen.createLinearGradient(0, -width / 2, 0, width / 2);
  canvas.addColorStop(0, "#fbfcfd");
  canvas.addColorStop(1, "#c3c8d0");
  pen.fillStyle = canvas;
  box(pen, -length / 2 + load / 2, 0, load, width, 0.025);
  pen.fill();
  pen.strokeStyle = "rgb(20 24 32 / 0.28)";
  pen.lineWidth = 0.01;
  box(pen, -length / 2 + load / 2, 0, load - 0.01, width - 0.01, 0.02);
  pen.stroke();
  pen.fillStyle = paint.main;
  box(pen, -length / 2 + load / 2, 0, load, width * 0.2, 0);
  pen.fill();
}

/** @param {Pen} pen @param {number} length @param {number} width */
function lamps(pen, length, width) {
  for (const side of [-1, 1]) {
    pen.fillStyle = "#fff6d8";
    box(pen, length / 2 - 0.03, side * width * 0.33, 0.034, 0.066, 0.016);
    pen.fill();
    pen.fillStyle = "#d3342d";
    box(pen, -length / 2 + 0.017, side * width * 0.35, 0.024, 0.07, 0.01);
    pen.fill();
  }
}

