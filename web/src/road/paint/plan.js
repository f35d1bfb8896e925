// @ts-check
/** Nine by nine cells around the vehicle: what is there, where it is about to be, which moves there are. */

import { drawGlyph } from "./glyphs.js";
import { box } from "./shapes.js";

/** @import { Move, Cell } from "../../core/protocol.js" */
/** @import { Palette } from "../../core/theme.js" */
/** @import { World } from "../world.js" */

/** @typedef {CanvasRenderingContext2D} Pen */
/** @typedef {{move: Move, cell: Cell, standing: "taken" | "free" | "blocked" | "off_road"}} Way */

export const SPAN = 9;

/**
 * @typedef {object} Sight
 * @property {World} world
 * @property {Cell} centre  the vehicle's
 * @property {Record<string, Cell>} next  where movers are about to be, by id
 * @property {Way[]} ways
 * @property {Cell | null} pointed  the cell that is spoken of
 * @property {Cell[]} [lit]  cells of what an answer points at
 */

/**
 * @param {Pen} pen  in CSS pixels
 * @param {number} side  of the whole
 * @param {Sight} sight
 * @param {Palette} palette
 */
export function drawPlan(pen, side, { world, centre, next, ways, pointed, lit = [] }, palette) {
  const cell = side / SPAN;
  const half = (SPAN - 1) / 2;
  /** @param {Cell} at @returns {[number, number]} the centre of a cell */
  const spot = ([column, row]) => [(column - centre[0] + half + 0.5) * cell, (row - centre[1] + half + 0.5) * cell];
  /** @param {Cell} at */
  const near = ([column, row]) => Math.abs(column - centre[0]) <= half && Math.abs(row - centre[1]) <= half;

  pen.clearRect(0, 0, side, side);
  ground(pen, cell, world, centre, palette);
  for (const { move, cell: to, standing } of ways) {
    if (move === "stay" || !near(to)) continue;
    const [x, y] = spot(to);
    if (standing === "blocked") mark(pen, x, y, cell, palette.danger);
  }
  for (const thing of world.things.values()) {
    if (thing.kind === "av") continue;
    const to = next[thing.id];
    const moves = to && (to[0] !== thing.cell[0] || to[1] !== thing.cell[1]);
    if (moves && near(to)) expected(pen, spot(to), cell, palette.kinds[thing.kind] ?? palette.danger);
  }
  for (const thing of world.things.values()) {
    if (near(thing.cell)) drawGlyph(pen, thing, ...spot(thing.cell), cell, palette);
  }
  for (const { move, cell: to, standing } of ways) {
    if (!near(to)) continue;
    if (standing === "blocked" && move !== "stay") cross(pen, ...spot(to), cell, palette);
    if (standing === "taken") intended(pen, spot(centre), spot(to), cell, palette);
  }
  for (const at of lit.filter(near)) ring(pen, ...spot(at), cell, palette.accent);
  if (pointed && near(pointed)) {
    const [x, y] = spot(pointed);
    pen.strokeStyle = palette.focus;
    pen.lineWidth = 2;
    box(pen, x, y, cell - 2, cell - 2, 4);
    pen.stroke();
  }
}

/** @param {Pen} pen @param {number} cell @param {World} world @param {Cell} centre @param {Palette} palette */
function ground(pen, cell, world, centre, palette) {
  const half = (SPAN - 1) / 2;
  for (let down = 0; down < SPAN; down++) {
    for (let across = 0; across < SPAN; across++) {
      const [column, row] = [centre[0] + across - half, centre[1] + down - half];
      if (column < 0 || column >= world.columns || row < 0 || row >= world.rows) {
        pen.fillStyle = palette.faint;
        pen.globalAlpha = 0.35;
        pen.fillRect((across + 0.5) * cell - 1, (down + 0.5) * cell - 1, 2, 2);
        pen.globalAlpha = 1;
        continue;
      }
      pen.fillStyle = row === 0 ? palette.goal : palette.cell;
      pen.globalAlpha = row === 0 ? 0.3 : 1;
      pen.fillRect(across * cell + 0.5, down * cell + 0.5, cell - 1, cell - 1);
      pen.globalAlpha = 1;
    }
  }
}

/** Round what is pointed at. @param {Pen} pen @param {number} x @param {number} y @param {number} cell @param {string} colour */
function ring(pen, x, y, cell, colour) {
  pen.strokeStyle = colour;
  pen.lineWidth = Math.max(1.5, cell * 0.06);
  pen.beginPath();
  pen.arc(x, y, cell * 0.47, 0, 2 * Math.PI);
  pen.stroke();
}

/** A cell that is not to be had. @param {Pen} pen @param {number} x @param {number} y @param {number} cell @param {string} colour */
function mark(pen, x, y, cell, colour) {
  pen.fillStyle = colour;
  pen.globalAlpha = 0.14;
  pen.fillRect(x - cell / 2 + 0.5, y - cell / 2 + 0.5, cell - 1, cell - 1);
  pen.globalAlpha = 1;
}

/** In a corner, so that what stands there is still seen. @param {Pen} pen @param {number} x @param {number} y @param {number} cell @param {Palette} palette */
function cross(pen, x, y, cell, palette) {
  const arm = cell * 0.1;
  const [left, top] = [x + cell * 0.32, y - cell * 0.32];
  pen.strokeStyle = palette.danger;
  pen.lineWidth = Math.max(1.5, cell * 0.07);
  pen.lineCap = "round";
  pen.beginPath();
  for (const way of [-1, 1]) {
    pen.moveTo(left - arm, top - way * arm);
    pen.lineTo(left + arm, top + way * arm);
  }
  pen.stroke();
}

/**
 * Where a mover is about to be.
 * @param {Pen} pen
 * @param {[number, number]} to
 * @param {number} cell
 * @param {string} colour
 */
function expected(pen, to, cell, colour) {
  pen.save();
  pen.strokeStyle = colour;
  pen.globalAlpha = 0.8;
  pen.lineWidth = 1.25;
  pen.setLineDash([3, 2.5]);
  box(pen, to[0], to[1], cell * 0.72, cell * 0.5, cell * 0.1);
  pen.stroke();
  pen.restore();
}

/**
 * @param {Pen} pen
 * @param {[number, number]} from
 * @param {[number, number]} to
 * @param {number} cell
 * @param {Palette} palette
 */
function intended(pen, from, to, cell, palette) {
  pen.save();
  pen.strokeStyle = pen.fillStyle = palette.good;
  pen.lineWidth = Math.max(2.5, cell * 0.13);
  pen.lineCap = pen.lineJoin = "round";
  pen.beginPath();
  if (from[0] === to[0] && from[1] === to[1]) {
    pen.arc(...from, cell * 0.5, 0, 2 * Math.PI);
    pen.stroke();
  } else {
    const angle = Math.atan2(to[1] - from[1], to[0] - from[0]);
    const reach = Math.hypot(to[0] - from[0], to[1] - from[1]) + cell * 0.22;
    pen.translate(...from);
    pen.rotate(angle);
    pen.moveTo(cell * 0.5, 0);
    pen.lineTo(reach - cell * 0.2, 0);
    pen.stroke();
    pen.beginPath();
    pen.moveTo(reach, 0);
    pen.lineTo(reach - cell * 0.36, -cell * 0.26);
    pen.lineTo(reach - cell * 0.36, cell * 0.26);
    pen.closePath();
    pen.fill();
  }
  pen.restore();
}
