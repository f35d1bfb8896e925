// @ts-check
/** Things as signs, for views that are read and not looked at: each kind has a shape of its own beside its colour. */

import { box, disc } from "./shapes.js";

/** @import { Palette } from "../../core/theme.js" */

/** @typedef {CanvasRenderingContext2D} Pen */

/**
 * @param {Pen} pen
 * @param {{kind: string, heading?: "left" | "right" | null, disabled?: boolean}} thing
 * @param {number} x  of its centre
 * @param {number} y
 * @param {number} size  of the cell
 * @param {Palette} palette
 */
export function drawGlyph(pen, { kind, heading, disabled }, x, y, size, palette) {
  pen.save();
  pen.translate(x, y);
  pen.fillStyle = pen.strokeStyle = palette.kinds[kind] ?? palette.danger;
  if (disabled) pen.globalAlpha *= 0.55;
  (GLYPHS[kind] ?? GLYPHS.unknown)(pen, size, heading === "left" ? -1 : 1, palette);
  pen.restore();
}

/** @type {Record<string, (pen: Pen, size: number, side: number, palette: Palette) => void>} */
const GLYPHS = {
  /** Pointing the way it goes. */
  av(pen, size, _side, palette) {
    const half = size * 0.42;
    pen.beginPath();
    pen.moveTo(0, -half * 1.1);
    pen.lineTo(half, half);
    pen.lineTo(0, half * 0.55);
    pen.lineTo(-half, half);
    pen.closePath();
    pen.lineJoin = "round";
    pen.lineWidth = Math.max(1, size * 0.12);
    pen.strokeStyle = palette.surface;
    pen.stroke();
    pen.fill();
  },

  /** A box with a bevelled nose. */
  vehicle(pen, size, side) {
    const [half, high, nose] = [size * 0.38, size * 0.24, size * 0.18];
    pen.beginPath();
    pen.moveTo(-side * half, -high);
    pen.lineTo(side * (half - nose), -high);
    pen.lineTo(side * half, 0);
    pen.lineTo(side * (half - nose), high);
    pen.lineTo(-side * half, high);
    pen.closePath();
    pen.fill();
  },

  pedestrian(pen, size) {
    const half = size * 0.32;
    pen.rotate(Math.PI / 4);
    box(pen, 0, 0, half * 1.5, half * 1.5, half * 0.2);
    pen.fill();
  },

  pothole(pen, size, _side, palette) {
    disc(pen, 0, 0, size * 0.32);
    if (size < 9) return;
    pen.fillStyle = palette.hole;
    disc(pen, 0, 0, size * 0.16);
  },

  /** A bar with feet. */
  barrier(pen, size) {
    box(pen, 0, -size * 0.06, size * 0.78, size * 0.26, size * 0.05);
    pen.fill();
    for (const at of [-0.26, 0.26]) pen.fillRect(size * (at - 0.05), 0, size * 0.1, size * 0.3);
  },

  unknown(pen, size) {
    pen.lineWidth = size * 0.1;
    pen.strokeRect(-size * 0.3, -size * 0.3, size * 0.6, size * 0.6);
  },
};
