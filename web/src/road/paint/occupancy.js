// @ts-check
/** The matrix: a figure for each cell, and a box around the vehicle's. */

import { box } from "./shapes.js";

/** @import { Palette } from "../../core/theme.js" */
/** @import { World } from "../world.js" */

/** @typedef {{first: number, count: number}} Stretch */

const MONO = 'ui-monospace, "Liberation Mono", monospace';

/**
 * @param {CanvasRenderingContext2D} pen  in CSS pixels
 * @param {World} world
 * @param {{x: number, y: number, across: number, along: number, columns?: Stretch, rows?: Stretch}} layout  with the stretch that is shown
 * @param {Palette} palette
 */
export function drawOccupancy(pen, { columns, rows, things }, layout, palette) {
  const { x, y, across, along, columns: seen = { first: 0, count: columns }, rows: long = { first: 0, count: rows } } = layout;
  /** @type {Map<number, string>} */
  const kinds = new Map();
  for (const { kind, cell: [column, row] } of things.values()) {
    const at = row * columns + column;
    if (column < seen.first || column >= seen.first + seen.count || row < long.first || row >= long.first + long.count) continue;
    if (kind === "av" || kinds.get(at) !== "av") kinds.set(at, kind);
  }
  const size = Math.min(along * 0.98, across * 1.3, 18);
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  /** @param {number} at */
  const centre = (at) => /** @type {const} */ ([x + ((at % columns) + 0.5) * across, y + (Math.floor(at / columns) + 0.5) * along]);
  pen.font = `400 ${size}px ${MONO}`;
  pen.fillStyle = palette.faint;
  pen.globalAlpha = 0.55;
  for (let row = long.first; row < long.first + long.count; row++) {
    for (let column = seen.first; column < seen.first + seen.count; column++) {
      const at = row * columns + column;
      if (kinds.has(at)) continue;
      const [left, top] = centre(at);
      pen.fillText("0", left, top + size * 0.06);
    }
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
