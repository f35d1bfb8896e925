// @ts-check
/** Weather and time of day over the road, lightly; and what a sensor misses or makes up. */

/** @import { Palette } from "../../core/theme.js" */
/** @import { Pose } from "../motion.js" */

/** @typedef {CanvasRenderingContext2D} Pen */

/** How much of the colour lies over the road. @type {Record<string, number>} */
const VEILS = { rain: 0.14, fog: 0.34, snow: 0.18, dusk: 0.2, dawn: 0.16, night: 0.42 };
/** Drops or flakes in a square of ten cells. */
const DROPS = 60;
const MOST_DROPS = 400;
/** Multiples of it, modulo 1, are spread evenly. */
const SPREAD = 0.754877666;
/** How far drops and flakes fall in a tick, as a share of the height. */
const FALL = { rain: 1.7, snow: 0.35 };

/**
 * @param {Pen} pen  in CSS pixels
 * @param {{width: number, height: number, cell: number}} view
 * @param {{weather: string, light: string}} conditions
 * @param {number} time  in ticks
 * @param {Palette} palette
 */
export function drawWeather(pen, { width, height, cell }, { weather, light }, time, palette) {
  for (const veil of [weather, light]) {
    const alpha = VEILS[veil];
    if (alpha === undefined) continue;
    pen.globalAlpha = alpha;
    pen.fillStyle = palette.veils[veil];
    pen.fillRect(0, 0, width, height);
  }
  if (weather === "rain" || weather === "snow") drawDrops(pen, { width, height, cell }, weather, time, palette.veils.drops);
  pen.globalAlpha = 1;
}

/**
 * @param {Pen} pen @param {{width: number, height: number, cell: number}} view
 * @param {"rain" | "snow"} weather @param {number} time @param {string} colour
 */
function drawDrops(pen, { width, height, cell }, weather, time, colour) {
  const count = Math.min(MOST_DROPS, 1 + Math.round((DROPS * width * height) / (100 * cell * cell)));
  pen.globalAlpha = weather === "rain" ? 0.4 : 0.7;
  pen.strokeStyle = pen.fillStyle = colour;
  pen.lineWidth = 1;
  pen.beginPath();
  for (let drop = 1; drop <= count; drop++) {
    const x = ((drop * SPREAD) % 1) * width;
    const y = ((drop * SPREAD * SPREAD + FALL[weather] * time) % 1) * height;
    if (weather === "rain") {
      pen.moveTo(x, y);
      pen.lineTo(x - cell / 12, y + cell / 4);
    } else pen.rect(x, y, Math.max(1, cell / 24), Math.max(1, cell / 24));
  }
  if (weather === "rain") pen.stroke();
  else pen.fill();
}

/**
 * A dashed ring round what is there and not seen, a cross where something is seen that is not there.
 * @param {Pen} pen  in cells
 * @param {Pose[]} poses  of all that is in view
 * @param {{missed: Set<string>, madeUp: [number, number][]}} marks
 * @param {Palette} palette
 */
export function drawMarks(pen, poses, { missed, madeUp }, palette) {
  pen.save();
  pen.lineWidth = 0.045;
  pen.setLineDash([0.14, 0.1]);
  pen.strokeStyle = palette.marking;
  for (const { thing, column, row } of poses) {
    if (!missed.has(thing.id)) continue;
    pen.beginPath();
    pen.arc(column, row, 0.42, 0, 2 * Math.PI);
    pen.stroke();
  }
  pen.setLineDash([]);
  pen.strokeStyle = palette.danger;
  for (const [column, row] of madeUp) {
    pen.beginPath();
    pen.moveTo(column - 0.25, row - 0.25);
    pen.lineTo(column + 0.25, row + 0.25);
    pen.moveTo(column - 0.25, row + 0.25);
    pen.lineTo(column + 0.25, row - 0.25);
    pen.stroke();
  }
  pen.restore();
}
