// @ts-check
/** The road itself: verge, shoulder, asphalt, lane markings, start line, finish line, distance marks. */

import { seeded } from "../random.js";

/** @import { View } from "../camera.js" */
/** @import { Palette } from "../../core/theme.js" */

/** Rows after which the surface repeats. */
const TILE_ROWS = 4;
const GRAINS_PER_CELL = 70;
const TUFTS_PER_CELL = 9;
const CELL_M = 5;
const MARK_EVERY_ROWS = 5;
const MARK_PX = 6;
const MARK_GAP_PX = 5;

/**
 * A piece of road `TILE_ROWS` long and as wide as the canvas, to be laid end to end.
 * @param {View} view
 * @param {number} columns
 * @param {Palette} palette
 * @returns {HTMLCanvasElement}
 */
export function surfaceTile(view, columns, palette) {
  const tile = document.createElement("canvas");
  tile.width = Math.ceil(view.width * view.ratio);
  tile.height = Math.round(TILE_ROWS * view.cell * view.ratio);
  const pen = tile.getContext("2d");
  if (!pen) return tile;
  pen.scale(view.ratio, tile.height / (TILE_ROWS * view.cell));
  const height = TILE_ROWS * view.cell;
  const road = columns * view.cell;
  verge(pen, view, height, palette);
  const { left, shoulder, cell } = view;
  pen.fillStyle = palette.asphaltDeep;
  pen.fillRect(left - shoulder, 0, road + 2 * shoulder, height);
  pen.fillStyle = palette.asphalt;
  pen.fillRect(left, 0, road, height);
  wheelTracks(pen, view, columns, height, palette);
  grain(pen, left - shoulder, road + 2 * shoulder, height, cell, palette);
  pen.fillStyle = palette.edge;
  const line = Math.max(1.5, cell * 0.035);
  pen.fillRect(left - line, 0, line, height);
  pen.fillRect(left + road, 0, line, height);
  pen.fillStyle = palette.marking;
  const dash = Math.max(1, cell * 0.022);
  for (let column = 1; column < columns; column++) {
    for (let row = 0; row < TILE_ROWS; row++) {
      pen.fillRect(left + column * cell - dash / 2, (row + 0.3) * cell, dash, cell * 0.4);
    }
  }
  return tile;
}

/** @param {CanvasRenderingContext2D} pen @param {View} view @param {number} height @param {Palette} palette */
function verge(pen, view, height, palette) {
  pen.fillStyle = palette.verge;
  pen.fillRect(0, 0, view.width, height);
  const random = seeded("verge");
  const tufts = (view.width / view.cell) * TILE_ROWS * TUFTS_PER_CELL;
  pen.strokeStyle = palette.vergeDeep;
  pen.lineWidth = Math.max(1, view.cell * 0.018);
  pen.lineCap = "round";
  for (let tuft = 0; tuft < tufts; tuft++) {
    const x = random() * view.width;
    const y = random() * height;
    const blade = view.cell * (0.03 + 0.05 * random());
    pen.beginPath();
    pen.moveTo(x, y);
    pen.lineTo(x + blade * (random() - 0.5), y - blade);
    pen.stroke();
  }
}

/**
 * The slightly darker bands that wheels leave.
 * @param {CanvasRenderingContext2D} pen
 * @param {View} view
 * @param {number} columns
 * @param {number} height
 * @param {Palette} palette
 */
function wheelTracks(pen, view, columns, height, palette) {
  pen.fillStyle = palette.asphaltDeep;
  pen.globalAlpha = 0.2;
  for (let column = 0; column < columns; column++) {
    for (const at of [0.3, 0.7]) {
      const x = view.left + (column + at) * view.cell;
      pen.fillRect(x - view.cell * 0.08, 0, view.cell * 0.16, height);
    }
  }
  pen.globalAlpha = 1;
}

/**
 * @param {CanvasRenderingContext2D} pen
 * @param {number} left
 * @param {number} width
 * @param {number} height
 * @param {number} cell
 * @param {Palette} palette
 */
function grain(pen, left, width, height, cell, palette) {
  const random = seeded("grain");
  const grains = (width / cell) * TILE_ROWS * GRAINS_PER_CELL;
  pen.fillStyle = palette.grain;
  for (let index = 0; index < grains; index++) {
    pen.globalAlpha = 0.15 + 0.5 * random();
    const size = Math.max(0.6, cell * (0.006 + 0.012 * random()));
    pen.fillRect(left + random() * width, random() * height, size, size);
  }
  pen.globalAlpha = 1;
}

/**
 * Lay the tile over the whole view.
 * @param {CanvasRenderingContext2D} pen  in CSS pixels
 * @param {HTMLCanvasElement} tile
 * @param {View} view
 * @param {number} top  the row at the top edge
 */
export function laySurface(pen, tile, view, top) {
  const height = TILE_ROWS * view.cell;
  const first = Math.floor(top / TILE_ROWS) * TILE_ROWS;
  for (let row = first; row < top + view.visibleRows; row += TILE_ROWS) {
    pen.drawImage(tile, 0, (row - top) * view.cell, view.width, height + 0.5);
  }
}

/**
 * The chequered finish over row 0, the start line under the last row, and metres left on the verge.
 * @param {CanvasRenderingContext2D} pen  in CSS pixels
 * @param {View} view
 * @param {number} top
 * @param {{columns: number, rows: number}} road
 * @param {Palette} palette
 */
export function drawLines(pen, view, top, road, palette) {
  const { cell, left } = view;
  const finish = (0 - top) * cell;
  if (finish > -cell && finish < view.height) chequers(pen, left, finish, road.columns, cell, palette);
  const start = (road.rows - 1 - top) * cell;
  if (start < view.height) {
    pen.fillStyle = palette.marking;
    pen.fillRect(left, start - cell * 0.05, road.columns * cell, cell * 0.05);
  }
  const room = left - view.shoulder;
  pen.font = `500 ${Math.min(12, cell * 0.15)}px system-ui, sans-serif`;
  pen.textAlign = "right";
  pen.textBaseline = "middle";
  pen.fillStyle = palette.ink;
  if (room < pen.measureText(`${road.rows * CELL_M} m`).width + MARK_PX + 2 * MARK_GAP_PX) return;
  for (let row = 0; row < road.rows; row += MARK_EVERY_ROWS) {
    const y = (row + 0.5 - top) * cell;
    if (y < -cell || y > view.height + cell) continue;
    pen.globalAlpha = 0.62;
    pen.fillText(row === 0 ? "Finish" : `${row * CELL_M} m`, room - MARK_PX - MARK_GAP_PX, y);
    pen.globalAlpha = 0.4;
    pen.fillRect(room - MARK_PX, y - 0.75, MARK_PX, 1.5);
  }
  pen.globalAlpha = 1;
}

/**
 * @param {CanvasRenderingContext2D} pen
 * @param {number} left
 * @param {number} top
 * @param {number} columns
 * @param {number} cell
 * @param {Palette} palette
 */
function chequers(pen, left, top, columns, cell, palette) {
  const side = cell / 4;
  pen.fillStyle = palette.goal;
  pen.globalAlpha = 0.16;
  pen.fillRect(left, top, columns * cell, cell);
  pen.globalAlpha = 0.92;
  for (let row = 0; row < 2; row++) {
    for (let column = 0; column < columns * 4; column++) {
      pen.fillStyle = (row + column) % 2 === 0 ? "#f5f6f8" : "#15181d";
      pen.fillRect(left + column * side, top + cell - (2 - row) * side, side + 0.3, side + 0.3);
    }
  }
  pen.globalAlpha = 1;
}
