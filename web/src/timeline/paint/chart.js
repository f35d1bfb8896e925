// @ts-check
/** Two figures along the run, one above the other, a bar for each tick. */

import { WINDOW } from "../../why/regret.js";

/** @import { Judged } from "../../why/regret.js" */
/** @import { Palette } from "../../core/theme.js" */

/** @typedef {"blocked" | "ticks"} Figure */

const MOST = { blocked: 6, ticks: 3 };

/**
 * @param {CanvasRenderingContext2D} pen  in CSS pixels
 * @param {{width: number, height: number}} size
 * @param {Figure} figure
 * @param {number} tick  the first that is not drawn any more
 * @param {(tick: number) => Judged | null | undefined} of
 * @param {Palette} palette
 */
export function drawChart(pen, { width, height }, figure, tick, of, palette) {
  const base = height - 1;
  const step = width / WINDOW;
  pen.clearRect(0, 0, width, height);
  pen.fillStyle = palette.grid;
  pen.fillRect(0, base, width, 1);
  for (let at = 0; at < WINDOW; at++) {
    const item = of(tick - WINDOW + at);
    if (!item) continue;
    const value = figure === "ticks" && item.lost ? MOST.ticks : item[figure];
    if (value === undefined || value === null || value === 0) continue;
    const tall = Math.max(2, Math.min(1, value / MOST[figure]) * (base - 1));
    pen.fillStyle = figure === "ticks" ? (item.lost ? palette.danger : palette.focus) : value >= 4 ? palette.danger : palette.kinds.pothole;
    pen.fillRect(at * step, base - tall, Math.max(1, step - 0.6), tall);
  }
}
