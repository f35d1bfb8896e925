// @ts-check
/** Vehicles from above, facing right, one cell being the unit. */

import { seeded } from "../seeded.js";
import { box, castShadow, disc } from "./shapes.js";

/** @import { Palette } from "../theme.js" */

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
  { main: "#4a4f5a", light: "#6d7380", dark: "#2d3038" },
];
const BODIES = /** @type {const} */ (["saloon", "hatch", "saloon", "van", "hatch", "truck"]);
const DISABLED = { main: "#7d7f84", light: "#94969b", dark: "#56585d" };
const EGO = { main: "#2f6fed", light: "#5c93ff", dark: "#1a48ad" };
/** Cones laid over one another, so that a beam is soft at its sides; in cells at its far end. */
const BEAM_SPREADS = [0.1, 0.16, 0.22, 0.28, 0.34, 0.4];
const GLASS = "#1a222e";

/** @type {Record<Look["body"] | "ego", {length: number, width: number}>} in cells */
export const SIZES = {
  saloon: { length: 0.8, width: 0.4 },
  hatch: { length: 0.68, width: 0.39 },
  van: { length: 0.82, width: 0.43 },
  truck: { length: 0.92, width: 0.45 },
  ego: { length: 0.82, width: 0.43 },
};

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

/** @param {Pen} pen @param {Look["body"] | "ego"} body @param {Palette} palette */
export function paintVehicleShadow(pen, body, palette) {
  const { length, width } = SIZES[body];
  castShadow(pen, palette.shadow, 0.09, () => {
    box(pen, 0, 0, length * 0.99, width * 1.02, 0.1);
    pen.fill();
  });
}

/** @param {Pen} pen @param {Look} look */
export function paintVehicle(pen, look) {
  const { length, width } = SIZES[look.body];
  wheels(pen, length, width);
  if (look.body === "truck") {
    truck(pen, look.paint, length, width);
  } else {
    shell(pen, look.paint, length, width, look.body === "van" ? 0.08 : 0.13);
    const long = look.body === "saloon";
    cabin(pen, look.paint, length, width, long ? 0.5 : 0.62, long ? -0.03 : -0.07);
  }
  lamps(pen, length, width);
}

/**
 * The autonomous vehicle: blue, with its sensor on the roof.
 * @param {Pen} pen
 */
export function paintEgo(pen) {
  const { length, width } = SIZES.ego;
  wheels(pen, length, width);
  shell(pen, EGO, length, width, 0.15);
  cabin(pen, EGO, length, width, 0.54, -0.04);
  pen.fillStyle = "rgb(255 255 255 / 0.9)";
  box(pen, 0.3, 0, 0.012, width * 0.5, 0.006);
  pen.fill();
  lamps(pen, length, width);
  pen.fillStyle = "#0d1728";
  disc(pen, -0.04, 0, 0.078);
  pen.fillStyle = "#dfe9ff";
  disc(pen, -0.04, 0, 0.052);
  pen.fillStyle = EGO.main;
  disc(pen, -0.04, 0, 0.026);
}

/**
 * The light thrown ahead.
 * @param {Pen} pen
 * @param {number} strength  0–1
 */
export function paintBeams(pen, strength) {
  for (const side of [-1, 1]) {
    const y = side * 0.13;
    const glow = pen.createRadialGradient(0.36, y, 0.02, 0.45, y, 1);
    glow.addColorStop(0, `rgb(255 246 214 / ${0.16 * strength})`);
    glow.addColorStop(1, "rgb(255 246 214 / 0)");
    pen.fillStyle = glow;
    for (const spread of BEAM_SPREADS) {
      pen.beginPath();
      pen.moveTo(0.38, y - 0.03);
      pen.lineTo(1.45, y - spread + side * 0.08);
      pen.lineTo(1.45, y + spread + side * 0.08);
      pen.lineTo(0.38, y + 0.03);
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
      box(pen, x * length * 1.1, side * width * 0.49, 0.15, 0.05, 0.02);
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
  box(pen, 0, 0, length, width, [0.09, nose, nose, 0.09]);
  pen.fill();
  pen.lineWidth = 0.012;
  pen.strokeStyle = "rgb(0 0 0 / 0.28)";
  pen.stroke();
  pen.fillStyle = paint.dark;
  for (const side of [-1, 1]) {
    box(pen, length * 0.13, side * (width / 2 + 0.018), 0.06, 0.045, 0.02);
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
  box(pen, shift, 0, size, width * 0.82, [0.07, 0.1, 0.1, 0.07]);
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
  box(pen, shift - 0.02, 0, size * 0.54, width * 0.68, 0.05);
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
  shell(pen, paint, cab, width * 0.94, 0.09);
  pen.fillStyle = GLASS;
  box(pen, 0.03, 0, 0.07, width * 0.76, 0.03);
  pen.fill();
  pen.restore();
  const load = length * 0.68;
  const canvas = pen.createLinearGradient(0, -width / 2, 0, width / 2);
  canvas.addColorStop(0, "#fbfcfd");
  canvas.addColorStop(1, "#c3c8d0");
  pen.fillStyle = canvas;
  box(pen, -length / 2 + load / 2, 0, load, width, 0.03);
  pen.fill();
  pen.strokeStyle = "rgb(20 24 32 / 0.28)";
  pen.lineWidth = 0.012;
  pen.stroke();
  pen.fillStyle = paint.main;
  box(pen, -length / 2 + load / 2, 0, load, width * 0.2, 0);
  pen.fill();
}

/** @param {Pen} pen @param {number} length @param {number} width */
function lamps(pen, length, width) {
  for (const side of [-1, 1]) {
    pen.fillStyle = "#fff6d8";
    box(pen, length / 2 - 0.035, side * width * 0.34, 0.04, 0.085, 0.02);
    pen.fill();
    pen.fillStyle = "#d3342d";
    box(pen, -length / 2 + 0.02, side * width * 0.36, 0.028, 0.085, 0.012);
    pen.fill();
  }
}

