// @ts-check
/** What of the road goes by, in perspective: bands and grass of the verge, wear, dashes, start and finish, posts. */

import { seeded } from "../random.js";
import { SHOULDER_CELLS } from "./backdrop.js";
import { AHEAD_ROWS } from "./eye.js";
import { flat, quad, shape, upright } from "./solids.js";

/** @import { Palette } from "../../core/theme.js" */
/** @import { World } from "../world.js" */
/** @import { Eye } from "./eye.js" */

/** @typedef {CanvasRenderingContext2D} Pen */

const CELL_M = 5;
const MARK_EVERY_ROWS = 5;
const DASH_CELLS = { wide: 0.03, from: -0.2, to: 0.2 };
/** How clear the dashes between lanes are, from so many rows away to so many; far ones are thin lines. */
const DASH_FADES = [[0, 12, 1], [12, 20, 0.7], [20, 28, 0.4], [28, 38, 0.2]];
/** Worn spots of the asphalt in a row, tufts of grass on either side of it; beyond so many rows nobody sees them. */
const SPOTS_PER_ROW = 14;
const TUFTS_PER_ROW = 7;
const DETAIL_ROWS = 11;
const TUFTS_WIDE_CELLS = 6;
/** Rows after which the details are the same again. */
const TURNS = 8;
/** Depth of a mown band of the verge. */
const BAND_ROWS = 3;
/** A smaller label than this nobody reads [px of a cell]. */
const LABEL_FROM_PX = 24;

/** Details of the rows: where across (a share of the room there is), where along, how large. */
const DETAILS = Array.from({ length: TURNS }, (_, turn) => {
  const random = seeded(`details ${turn}`);
  const some = (/** @type {number} */ count) => Array.from({ length: count }, () => /** @type {const} */ ([random(), random() - 0.5, random()]));
  return { spots: some(SPOTS_PER_ROW), tufts: some(TUFTS_PER_ROW) };
});

/**
 * @param {Pen} pen  in CSS pixels
 * @param {Eye} eye
 * @param {World} world
 * @param {Palette} palette
 */
export function drawGround(pen, eye, { columns, rows }, palette) {
  bands(pen, eye, columns, palette);
  details(pen, eye, columns, palette);
  dashes(pen, eye, columns, palette);
  const { nearest } = eye;
  if (rows - 1.5 < nearest) {
    flat(pen, eye, -0.5, columns - 0.5, rows - 1.55, Math.min(nearest, rows - 1.48));
    pen.fillStyle = palette.marking;
    pen.fill();
  }
  if (0.5 < nearest && eye.distance(0) < 2 * AHEAD_ROWS) chequers(pen, eye, columns, palette);
}

/** Mown bands across the verge: they show how fast the road goes by. @param {Pen} pen @param {Eye} eye @param {number} columns @param {Palette} palette */
function bands(pen, eye, columns, palette) {
  const { lens: { width }, nearest } = eye;
  const [left, right] = [-0.5 - SHOULDER_CELLS, columns - 0.5 + SHOULDER_CELLS];
  pen.fillStyle = palette.vergeDeep;
  for (let row = 2 * BAND_ROWS * Math.floor((nearest - AHEAD_ROWS) / (2 * BAND_ROWS)); row < nearest; row += 2 * BAND_ROWS) {
    pen.globalAlpha = 0.3 * Math.min(1, Math.max(0, (AHEAD_ROWS - (nearest - row)) / AHEAD_ROWS));
    const near = Math.min(nearest, row + BAND_ROWS);
    for (const [column, edge] of [[left, 0], [right, width]]) {
      const [[farX, top], [nearX, bottom]] = [eye.spot(column, row), eye.spot(column, near)];
      shape(pen, [[edge, top], [farX, top], [nearX, bottom], [edge, bottom]]);
      pen.fill();
    }
  }
  pen.globalAlpha = 1;
}

/** Grass on the verge and worn spots of the asphalt. @param {Pen} pen @param {Eye} eye @param {number} columns @param {Palette} palette */
function details(pen, eye, columns, palette) {
  const first = Math.floor(eye.nearest);
  pen.strokeStyle = palette.vergeDeep;
  pen.lineWidth = 1;
  pen.beginPath();
  for (let row = first; row > first - DETAIL_ROWS; row--) {
    for (const [across, along, size] of DETAILS[turnOf(row)].tufts) {
      const away = 0.6 + SHOULDER_CELLS + TUFTS_WIDE_CELLS * across ** 2;
      const blade = 0.05 + 0.06 * size;
      for (const column of [-away, columns - 1 + away]) {
        const [x, y] = eye.spot(column, row + along);
        const scale = eye.scale(row);
        pen.moveTo(x, y);
        pen.lineTo(x + (blade / 3) * scale, y - blade * scale);
      }
    }
  }
  pen.stroke();
  pen.fillStyle = palette.grain;
  pen.globalAlpha = 0.3;
  for (let row = first; row > first - DETAIL_ROWS; row--) {
    for (const [across, along, size] of DETAILS[turnOf(row)].spots) {
      const [x, y] = eye.spot(across * columns - 0.5, row + along);
      const side = eye.scale(row) * (0.012 + 0.02 * size);
      pen.fillRect(x, y, 1.6 * side, 0.7 * side);
    }
  }
  pen.globalAlpha = 1;
}

/** @param {number} row */
function turnOf(row) {
  return ((row % TURNS) + TURNS) % TURNS;
}

/** The dashes between lanes; far away, where they would run into one another, they grow faint. @param {Pen} pen @param {Eye} eye @param {number} columns @param {Palette} palette */
function dashes(pen, eye, columns, palette) {
  const { nearest } = eye;
  pen.fillStyle = pen.strokeStyle = palette.marking;
  pen.lineWidth = 0.8;
  for (const [from, to, alpha] of DASH_FADES) {
    pen.globalAlpha = alpha;
    pen.beginPath();
    for (let row = Math.floor(nearest) - from; row > nearest - to; row--) {
      for (let column = 0.5; column < columns - 1; column++) {
        const [far, near] = [row + DASH_CELLS.from, Math.min(nearest, row + DASH_CELLS.to)];
        if (from === 0) quad(pen, eye, column - DASH_CELLS.wide / 2, column + DASH_CELLS.wide / 2, far, near);
        else {
          pen.moveTo(...eye.spot(column, far));
          pen.lineTo(...eye.spot(column, near));
        }
      }
    }
    if (from === 0) pen.fill();
    else pen.stroke();
  }
  pen.globalAlpha = 1;
}

/** The destination: row 0 in its colour, and a chequered band across. @param {Pen} pen @param {Eye} eye @param {number} columns @param {Palette} palette */
function chequers(pen, eye, columns, palette) {
  const near = Math.min(eye.nearest, 0.5);
  flat(pen, eye, -0.5, columns - 0.5, -0.5, near);
  pen.fillStyle = palette.goal;
  pen.globalAlpha = 0.2;
  pen.fill();
  pen.globalAlpha = 0.92;
  for (const [parity, colour] of /** @type {const} */ ([[0, "#f5f6f8"], [1, "#15181d"]])) {
    pen.beginPath();
    for (let line = 0; line < 2; line++) {
      for (let square = (line + parity) % 2; square < columns * 4; square += 2) {
        const [left, far] = [square / 4 - 0.5, line / 4];
        quad(pen, eye, left, left + 0.25, Math.min(near, far), Math.min(near, far + 0.25));
      }
    }
    pen.fillStyle = colour;
    pen.fill();
  }
  pen.globalAlpha = 1;
}

/**
 * A post with its distance on either side of the road, in every fifth row that is seen, the far ones first.
 * @param {Pen} pen
 * @param {Eye} eye
 * @param {World} world
 * @param {Palette} palette
 * @param {(row: number) => number} clear  how much of a row is seen through the haze, 0–1
 */
export function drawPosts(pen, eye, { columns, rows }, palette, clear) {
  const first = Math.max(0, Math.ceil((eye.nearest - AHEAD_ROWS) / MARK_EVERY_ROWS) * MARK_EVERY_ROWS);
  for (let row = first; row < Math.min(rows, eye.nearest - 0.2); row += MARK_EVERY_ROWS) {
    for (const side of [-1, 1]) {
      const column = side < 0 ? -0.5 - SHOULDER_CELLS - 0.14 : columns - 0.5 + SHOULDER_CELLS + 0.14;
      pen.globalAlpha = clear(row);
      const scale = eye.scale(row);
      const named = side < 0 && row > 0 && scale > LABEL_FROM_PX && eye.spot(column, row)[0] > scale / 2;
      upright(pen, eye, column, row, () => post(pen, named ? `${row * CELL_M} m` : "", palette));
    }
  }
  pen.globalAlpha = 1;
}

/** @param {Pen} pen @param {string} text @param {Palette} palette */
function post(pen, text, palette) {
  pen.fillStyle = "#eceef1";
  shape(pen, [[-0.035, 0], [-0.03, -0.34], [0.03, -0.34], [0.035, 0]]);
  pen.fill();
  pen.fillStyle = "#22262d";
  pen.fillRect(-0.032, -0.29, 0.064, 0.08);
  if (text === "") return;
  pen.fillStyle = palette.ink;
  // Fonts below a pixel are drawn at one: a hundred units to the cell.
  pen.scale(0.01, 0.01);
  pen.font = "600 19px system-ui, sans-serif";
  pen.textAlign = "center";
  pen.textBaseline = "alphabetic";
  pen.fillText(text, 0, -40);
}
