// @ts-check
/** What can be laid over the road: boxes around things, where movers will be, hazards brought out. In cells. */

import { boxOf, sizeOf } from "../collisionGeometry.js";
import { isFixed } from "./things.js";

/** @import { Pose } from "../motion.js" */
/** @import { Cell } from "../../core/protocol.js" */
/** @import { Palette } from "../../core/theme.js" */

/** @typedef {CanvasRenderingContext2D} Pen */

/**
 * The box that each thing is judged by, its sides open, with its name.
 * @param {Pen} pen
 * @param {Pose[]} poses
 * @param {Palette} palette
 */
export function drawBoxes(pen, poses, palette) {
  pen.save();
  pen.lineWidth = 0.025;
  pen.font = "600 0.13px system-ui, sans-serif";
  pen.textAlign = "left";
  pen.textBaseline = "bottom";
  for (const { thing: { kind, id }, column, row, alpha } of poses) {
    const [left, top, right, bottom] = boxOf(kind, [column, row]);
    const arm = 0.09;
    pen.globalAlpha = alpha;
    pen.strokeStyle = pen.fillStyle = palette.roadKinds[kind] ?? palette.danger;
    pen.beginPath();
    for (const [x, y, h, v] of [[left, top, 1, 1], [right, top, -1, 1], [left, bottom, 1, -1], [right, bottom, -1, -1]]) {
      pen.moveTo(x + h * arm, y);
      pen.lineTo(x, y);
      pen.lineTo(x, y + v * arm);
    }
    pen.stroke();
    pen.fillText(id, left, top - 0.02);
  }
  pen.restore();
}

/**
 * Ghosts of the movers in the ticks to come, the nearest the clearest.
 * @param {Pen} pen
 * @param {Pose[]} poses
 * @param {Record<string, Cell>[]} ahead  their cells by id, the next tick first
 * @param {Palette} palette
 */
export function drawForecast(pen, poses, ahead, palette) {
  pen.save();
  pen.setLineDash([0.09, 0.06]);
  for (const { thing: { kind, id }, column, row, alpha } of poses) {
    const cells = ahead.map((movers) => movers[id]).filter(Boolean);
    if (cells.length === 0 || kind === "av") continue;
    const { across, along } = sizeOf(kind);
    pen.strokeStyle = pen.fillStyle = palette.roadKinds[kind] ?? palette.danger;
    let from = column;
    cells.forEach(([to], at) => {
      const clear = alpha * (0.95 - at * 0.3);
      if (at > 0 && to === cells[at - 1][0]) return;
      pen.lineWidth = 0.028;
      pen.globalAlpha = clear * 0.16;
      pen.beginPath();
      pen.roundRect(to - across / 2, row - along / 2, across, along, 0.08);
      pen.fill();
      pen.globalAlpha = clear;
      pen.stroke();
      const side = Math.sign(to - from);
      const [start, end] = [from + (side * across) / 2, to - (side * across) / 2];
      if ((end - start) * side > 0.04) {
        pen.beginPath();
        pen.moveTo(start, row);
        pen.lineTo(end, row);
        pen.stroke();
      }
      from = to;
    });
  }
  pen.restore();
}

/**
 * Cells of hazards brought out.
 * @param {Pen} pen
 * @param {Pose[]} poses
 * @param {Palette} palette
 */
export function drawHazards(pen, poses, palette) {
  pen.save();
  pen.lineWidth = 0.04;
  for (const { thing, column, row, alpha } of poses) {
    if (!isFixed(thing)) continue;
    pen.strokeStyle = pen.fillStyle = palette.roadKinds[thing.kind] ?? palette.danger;
    pen.beginPath();
    pen.roundRect(column - 0.48, row - 0.48, 0.96, 0.96, 0.08);
    pen.globalAlpha = alpha * 0.34;
    pen.fill();
    pen.globalAlpha = alpha;
    pen.stroke();
  }
  pen.restore();
}
