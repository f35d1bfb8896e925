// @ts-check
/** The matrix: a figure for each cell, and a box around the vehicle's; where figures would be too small, squares. */

import { box } from "./shapes.js";

/** @import { Palette } from "../../core/theme.js" */
/** @import { World } from "../world.js" */

/** Smaller figures than this cannot be read [px]. */
const LEAST_FIGURE = 9;
const MONO = 'ui-monospace, "Liberation Mono", monospace';

/**
 * @param {CanvasRenderingContext2D} pen  in CSS pixels
 * @param {World} world
 * @param {{x: number, y: number, across: number, along: number}} layout
 * @param {Palette} palette
 */
export function drawOccupancy(pen, { columns, rows, things }, { x, y, across, along }, palette) {
  /** @type {Map<number, string>} */
  const kinds = new Map();
  for (const { kind, cell: [column, row] } of things.values()) {
    const at = row * columns + column;
    if (kind === "av" || kinds.get(at) !== "av") kinds.set(at, kind);
  }
  const size = Math.min(along * 0.98, across * 1.3, 18);
  if (size < LEAST_FIGURE) return drawSquares(pen, kinds, { columns, rows }, { x, y, across, along }, palette);
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  /** @param {number} at */
  const centre = (at) => /** @type {const} */ ([x + ((at % columns) + 0.5) * across, y + (Math.floor(at / columns) + 0.5) * along]);
  pen.font = `400 ${size}px ${MONO}`;
  pen.fillStyle = palette.faint;
  pen.globalAlpha = 0.55;
  for (let at = 0; at < rows * columns; at++) {
    if (kinds.has(at)) continue;
    const [left, top] = centre(at);
    pen.fillText("0", left, top + size * 0.06);
  }
  pen.font = `700 ${size}px ${MONO}`;
  for (const [at, kind] of kinds) {
    const [left, top] = centre(at);
    const colour = palette.kinds[kind] ?? palette.danger;
    pen.fillStyle = colour;
    pen.globalAlpha = kind === "av" ? 1 : 0.16;
    box(pen, left, top, across - 1, along - 1, 2);
    pen.fill();
    pen.globalAlpha = 1;
    if (kind === "av") pen.fillStyle = palette.surface;
    pen.fillText("1", left, top + size * 0.06);
  }
}

/**
 * The same without figures: a square for each cell, in the colour of what takes it.
 * @param {CanvasRenderingContext2D} pen
 * @param {Map<number, string>} kinds  of what stands there, by cell
 * @param {{columns: number, rows: number}} road
 * @param {{x: number, y: number, across: number, along: number}} layout
 * @param {Palette} palette
 */
function drawSquares(pen, kinds, { columns, rows }, { x, y, across, along }, palette) {
  const gap = Math.min(1, along / 6, across / 6);
  for (let at = 0; at < rows * columns; at++) {
    const kind = kinds.get(at);
    pen.fillStyle = kind === undefined ? palette.cell : (palette.kinds[kind] ?? palette.danger);
    pen.fillRect(x + (at % columns) * across, y + Math.floor(at / columns) * along, across - gap, along - gap);
  }
}
