// @ts-check
/** A figure along the run, a bar for each tick; with axes where there is room for them. */

import { WINDOW } from "../../why/regret.js";

/** @import { Judged } from "../../why/regret.js" */
/** @import { Palette } from "../../core/theme.js" */

/** @typedef {"blocked" | "ticks"} Figure */
/** @typedef {{width: number, height: number}} Size  in CSS pixels */
/** @typedef {{left: number, top: number, width: number, base: number, axes: boolean}} Area  where the bars stand */

/** The largest value that is drawn, and where the axis is labelled. */
const SCALES = { blocked: { most: 6, marks: [0, 2, 4, 6] }, ticks: { most: 3, marks: [0, 1, 2, 3] } };
/** From this size on there are axes. @type {Size} */
const ROOM = { width: 240, height: 90 };
/** Room for the figures of the axes. */
const [LEFT, BELOW, ABOVE] = [26, 18, 8];
const TICK_STEP = 10;

/** @param {Size} size @returns {Area} */
export function chartArea({ width, height }) {
  const axes = width >= ROOM.width && height >= ROOM.height;
  return axes ? { left: LEFT, top: ABOVE, width: width - LEFT, base: height - BELOW, axes } : { left: 0, top: 0, width, base: height - 1, axes };
}

/** The tick at a place of the chart. @param {Size} size @param {number} x @param {number} tick  the first that is not drawn any more */
export function chartTick(size, x, tick) {
  const { left, width } = chartArea(size);
  return tick - WINDOW + Math.floor(((x - left) / width) * WINDOW);
}

/**
 * @param {CanvasRenderingContext2D} pen  in CSS pixels
 * @param {Size} size
 * @param {Figure} figure
 * @param {number} tick  the first that is not drawn any more
 * @param {(tick: number) => Judged | null | undefined} of
 * @param {Palette} palette
 */
export function drawChart(pen, size, figure, tick, of, palette) {
  const area = chartArea(size);
  const { left, top, width, base } = area;
  const { most } = SCALES[figure];
  const step = width / WINDOW;
  pen.clearRect(0, 0, size.width, size.height);
  if (area.axes) drawAxes(pen, area, figure, tick, palette);
  pen.fillStyle = palette.grid;
  pen.fillRect(left, base, width, 1);
  for (let at = 0; at < WINDOW; at++) {
    const item = of(tick - WINDOW + at);
    if (!item) continue;
    const value = figure === "ticks" && item.lost ? most : item[figure];
    if (value === undefined || value === null || value === 0) continue;
    const tall = Math.max(2, Math.min(1, value / most) * (base - top - 1));
    pen.fillStyle = figure === "ticks" ? (item.lost ? palette.danger : palette.focus) : value >= 4 ? palette.danger : palette.kinds.pothole;
    pen.fillRect(left + at * step, base - tall, Math.max(1, step - 0.6), tall);
  }
}

/**
 * Lines and figures of both axes: values to the left, ticks beneath.
 * @param {CanvasRenderingContext2D} pen
 * @param {Area} area
 * @param {Figure} figure
 * @param {number} tick
 * @param {Palette} palette
 */
function drawAxes(pen, { left, top, width, base }, figure, tick, palette) {
  const { most, marks } = SCALES[figure];
  pen.font = "11px system-ui, sans-serif";
  pen.textBaseline = "middle";
  pen.textAlign = "right";
  for (const mark of marks) {
    const y = base - (mark / most) * (base - top - 1);
    pen.fillStyle = palette.grid;
    pen.fillRect(left, Math.round(y), width, 1);
    pen.fillStyle = palette.faint;
    pen.fillText(String(mark), left - 6, y);
  }
  pen.textBaseline = "top";
  pen.textAlign = "center";
  const first = tick - WINDOW;
  for (let at = Math.max(0, Math.ceil(first / TICK_STEP) * TICK_STEP); at < tick; at += TICK_STEP) {
    const x = left + ((at - first + 0.5) / WINDOW) * width;
    pen.fillText(String(at), Math.min(x, left + width - 8), base + 5);
  }
}
