// @ts-check
/** The matrix: a figure for each cell, and a box around the vehicle's. */

import { box } from "./shapes.js";

/** @import { Palette } from "../theme.js" */
/** @import { World } from "../world.js" */

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
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  for (let row = 0; row < rows; row++) {
    for (let column = 0; column < columns; column++) {
      const kind = kinds.get(row * columns + column);
      const [left, top] = [x + column * across, y + row * along];
      if (kind) {
        pen.fillStyle = palette.kinds[kind] ?? palette.danger;
        pen.globalAlpha = kind === "av" ? 1 : 0.16;
        box(pen, left + across / 2, top + along / 2, across - 1, along - 1, 2);
        pen.fill();
        pen.globalAlpha = 1;
      }
      pen.font = `${kind ? 700 : 400} ${size}px ui-monospace, "Liberation Mono", monospace`;
      pen.fillStyle = kind === "av" ? palette.surface : kind ? (palette.kinds[kind] ?? palette.danger) : palette.faint;
      pen.globalAlpha = kind ? 1 : 0.55;
      pen.fillText(kind ? "1" : "0", left + across / 2, top + along / 2 + size * 0.06);
      pen.globalAlpha = 1;
    }
  }
}
