// @ts-check
/** One figure of the whole run, drawn under the timeline on the same axis of ticks; with an axis of its own. */

import { xOf } from "./line.js";

/** @import { Palette } from "../../core/theme.js" */
/** @import { RunJudgement } from "../stripData.js" */

/** @typedef {"risk" | "regret" | "clearance"} Measure */

/** The largest value that is drawn: of six moves, in ticks, in metres. @type {Record<Measure, number>} */
export const MOST = { risk: 6, regret: 4, clearance: 20 };
export const ROW_HEIGHT = 40;
const [TOP, BASE] = [5, 36];

/**
 * The value of a decision; null where there is none.
 * @param {RunJudgement | null | undefined} item
 * @param {Measure} measure
 */
export function valueOf(item, measure) {
  if (!item) return null;
  if (measure === "risk") return item.blocked;
  if (measure === "regret") return item.lost ? MOST.regret : (item.ticks ?? 0);
  return item.clearance_m;
}

/**
 * Where ticks share a pixel, the worst of them is drawn.
 * @param {CanvasRenderingContext2D} pen  in CSS pixels
 * @param {{width: number, span: number, at: number}} line
 * @param {Measure} measure
 * @param {ReadonlyMap<number, RunJudgement | null>} items
 * @param {Palette} palette
 */
export function drawMeasure(pen, line, measure, items, palette) {
  const most = MOST[measure];
  pen.clearRect(0, 0, line.width, ROW_HEIGHT);
  drawAxis(pen, line, most, palette);
  const bar = Math.max(1, xOf(line, 1) - xOf(line, 0) - 0.6);
  /** @type {Map<number, {value: number, lost: boolean}>} */
  const worst = new Map();
  for (const [tick, item] of items) {
    const value = valueOf(item, measure);
    if (value === null || value === undefined) continue;
    const x = bar > 1 ? xOf(line, tick) : Math.round(xOf(line, tick));
    const before = worst.get(x);
    const worse = before === undefined || (measure === "clearance" ? value < before.value : value > before.value);
    worst.set(x, { value: worse ? value : before.value, lost: item?.lost === true || before?.lost === true });
  }
  for (const [x, { value, lost }] of worst) {
    const tall = Math.min(1, value / most) * (BASE - TOP);
    if (tall === 0) continue;
    pen.fillStyle = colourOf(measure, value, lost, palette);
    pen.fillRect(x, BASE - Math.max(2, tall), bar, Math.max(2, tall));
  }
  pen.fillStyle = palette.text;
  pen.fillRect(Math.round(xOf(line, line.at)), TOP - 3, 1, BASE - TOP + 5);
}

/** @param {Measure} measure @param {number} value @param {boolean} lost @param {Palette} palette */
function colourOf(measure, value, lost, palette) {
  if (measure === "clearance") return value <= 5 ? palette.danger : value <= 8 ? palette.kinds.pothole : palette.focus;
  if (measure === "regret") return lost ? palette.danger : palette.focus;
  return value >= 4 ? palette.danger : palette.kinds.pothole;
}

/** Its largest value and nought. @param {CanvasRenderingContext2D} pen @param {{width: number}} line @param {number} most @param {Palette} palette */
function drawAxis(pen, { width }, most, palette) {
  pen.fillStyle = palette.grid;
  pen.fillRect(0, BASE, width, 1);
  pen.fillRect(0, TOP, width, 1);
  pen.font = "10px system-ui, sans-serif";
  pen.fillStyle = palette.faint;
  pen.textAlign = "right";
  pen.textBaseline = "top";
  pen.fillText(String(most), width, TOP + 2);
  pen.textBaseline = "bottom";
  pen.fillText("0", width, BASE - 1);
}
