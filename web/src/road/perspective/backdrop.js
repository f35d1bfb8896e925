// @ts-check
/**
 * What of the perspective view stands still while the road goes by: sky, hills, verge, asphalt with wheel tracks and edge
 * lines. Painted once for a size, a road and the colours, then laid under each frame.
 */

import { AHEAD_ROWS, Eye } from "./eye.js";
import { flat, quad } from "./solids.js";

/** @import { Palette } from "../../core/theme.js" */

/** @typedef {CanvasRenderingContext2D} Pen */

export const SHOULDER_CELLS = 0.3;
const LINE_CELLS = 0.045;
const TRACKS_AHEAD_ROWS = 24;
/** Lines of hills: how clear, how high as a share of the sky, how many waves, where they begin. */
const HILLS = [[0.3, 0.42, 7, 0.6], [0.5, 0.24, 11, 2.4]];
const HILL_STEPS = 48;

export class Backdrop {
  /** @type {HTMLCanvasElement | null} */ #canvas = null;
  #key = "";
  /** @type {Palette | null} */ #palette = null;

  /** @param {() => HTMLCanvasElement} [make] */
  constructor(make = () => document.createElement("canvas")) {
    this.make = make;
  }

  /** @param {Pen} pen  in CSS pixels @param {Eye} eye @param {number} columns @param {Palette} palette */
  lay(pen, eye, columns, palette) {
    const { lens, x } = eye;
    const key = [lens.width, lens.height, lens.ratio, columns, x].join(" ");
    if (this.#canvas === null || key !== this.#key || palette !== this.#palette) {
      this.#canvas ??= this.make();
      this.#key = key;
      this.#palette = palette;
      this.#canvas.width = Math.max(1, Math.round(lens.width * lens.ratio));
      this.#canvas.height = Math.max(1, Math.round(lens.height * lens.ratio));
      const brush = this.#canvas.getContext("2d", { alpha: false });
      if (brush === null) return;
      brush.setTransform(lens.ratio, 0, 0, lens.ratio, 0, 0);
      const still = new Eye(lens);
      still.follow({ column: 0, row: 0 }, { columns }, Infinity);
      still.x = x;
      paintBackdrop(brush, still, columns, palette);
    }
    pen.drawImage(this.#canvas, 0, 0, lens.width, lens.height);
  }
}

/** @param {Pen} pen  in CSS pixels @param {Eye} eye @param {number} columns @param {Palette} palette */
export function paintBackdrop(pen, eye, columns, palette) {
  const { width, height, horizon } = eye.lens;
  const sky = pen.createLinearGradient(0, 0, 0, horizon);
  sky.addColorStop(0, palette.sky);
  sky.addColorStop(1, palette.haze);
  pen.fillStyle = sky;
  pen.fillRect(0, 0, width, horizon + 1);
  hills(pen, eye, palette);
  pen.fillStyle = hazed(pen, eye, palette.verge, palette);
  pen.fillRect(0, horizon, width, height - horizon);
  const right = columns - 0.5;
  surface(pen, eye, -0.5 - SHOULDER_CELLS, right + SHOULDER_CELLS, palette.asphaltDeep, palette);
  surface(pen, eye, -0.5, right, palette.asphalt, palette);
  tracks(pen, eye, columns, palette);
  for (const column of [-0.5 - LINE_CELLS, right]) surface(pen, eye, column, column + LINE_CELLS, palette.edge, palette);
}

/** Two soft lines of hills along the horizon. @param {Pen} pen @param {Eye} eye @param {Palette} palette */
function hills(pen, { lens: { width, horizon } }, palette) {
  const fill = pen.createLinearGradient(0, horizon / 2, 0, horizon);
  fill.addColorStop(0, palette.verge);
  fill.addColorStop(0.4, palette.verge);
  fill.addColorStop(1, palette.haze);
  pen.fillStyle = fill;
  for (const [alpha, high, long, shift] of HILLS) {
    pen.globalAlpha = alpha;
    pen.beginPath();
    pen.moveTo(0, horizon + 1);
    for (let step = 0; step <= HILL_STEPS; step++) {
      const x = step / HILL_STEPS;
      const rise = 0.55 + 0.3 * Math.sin(long * x + shift) + 0.15 * Math.sin(2.7 * long * x + 2 * shift);
      pen.lineTo(x * width, horizon - high * horizon * rise);
    }
    pen.lineTo(width, horizon + 1);
    pen.fill();
  }
  pen.globalAlpha = 1;
}

/** A colour that goes over into the haze towards the horizon. @param {Pen} pen @param {Eye} eye @param {string} colour @param {Palette} palette */
function hazed(pen, { lens: { horizon, height } }, colour, { haze }) {
  const fill = pen.createLinearGradient(0, horizon, 0, height);
  fill.addColorStop(0, haze);
  fill.addColorStop(0.22, colour);
  return fill;
}

/** A strip of the road up to the horizon. @param {Pen} pen @param {Eye} eye @param {number} left @param {number} right @param {string} colour @param {Palette} palette */
function surface(pen, eye, left, right, colour, palette) {
  flat(pen, eye, left, right, (eye.row ?? 0) - AHEAD_ROWS * 60, eye.nearest);
  pen.fillStyle = hazed(pen, eye, colour, palette);
  pen.fill();
}

/** The slightly darker bands that wheels leave. @param {Pen} pen @param {Eye} eye @param {number} columns @param {Palette} palette */
function tracks(pen, eye, columns, palette) {
  const { nearest } = eye;
  const fill = pen.createLinearGradient(0, eye.spot(0, nearest - TRACKS_AHEAD_ROWS)[1], 0, eye.lens.height);
  fill.addColorStop(0, "transparent");
  fill.addColorStop(0.5, palette.asphaltDeep);
  pen.fillStyle = fill;
  pen.globalAlpha = 0.24;
  pen.beginPath();
  for (let column = 0; column < columns; column++) {
    for (const aside of [-0.2, 0.2]) quad(pen, eye, column + aside - 0.08, column + aside + 0.08, nearest - TRACKS_AHEAD_ROWS, nearest);
  }
  pen.fill();
  pen.globalAlpha = 1;
}
