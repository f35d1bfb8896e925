// @ts-check
/**
 * Pedestrians from above, facing right, one cell being the unit; legs and arms swing with the step. All of one stays
 * within a circle as wide as its box, whichever way it faces.
 */

import { seeded } from "../random.js";
import { castShadow } from "./shapes.js";

/** @import { Palette } from "../../core/theme.js" */

/** @typedef {CanvasRenderingContext2D} Pen */

const SHIRTS = ["#e4572e", "#2a9d8f", "#f2b134", "#9b5de5", "#ef798a", "#4c9f70", "#e9ecef"];
const HAIR = ["#2b1d14", "#5a3a22", "#8d6a43", "#1b1b1f", "#b9a27c"];

/** @param {Pen} pen @param {Palette} palette */
export function paintWalkerShadow(pen, palette) {
  castShadow(pen, palette.shadow, 0.05, () => {
    pen.beginPath();
    pen.ellipse(0, 0, 0.09, 0.14, 0, 0, 2 * Math.PI);
    pen.fill();
  });
}

/**
 * @param {Pen} pen
 * @param {string} id
 * @param {number} stride  how far into the step, 0–1
 * @param {boolean} hurt  lying on the ground: it will not walk on
 */
export function drawPedestrian(pen, id, stride, hurt) {
  const random = seeded(id);
  const shirt = SHIRTS[Math.floor(random() * SHIRTS.length)];
  const hair = HAIR[Math.floor(random() * HAIR.length)];
  const swing = hurt ? 0.6 : Math.sin(stride * 2 * Math.PI);
  pen.lineCap = "round";
  pen.strokeStyle = "#232a38";
  pen.lineWidth = 0.06;
  for (const side of [-1, 1]) {
    pen.beginPath();
    pen.moveTo(0, side * 0.04);
    pen.lineTo(side * swing * 0.1, side * 0.045);
    pen.stroke();
  }
  pen.strokeStyle = "#d9a57c";
  pen.lineWidth = 0.045;
  for (const side of [-1, 1]) {
    pen.beginPath();
    pen.moveTo(0, side * 0.1);
    pen.lineTo(-side * swing * 0.07, side * 0.105);
    pen.stroke();
  }
  pen.fillStyle = hurt ? "#8a8d93" : shirt;
  pen.beginPath();
  pen.ellipse(0, 0, 0.075, 0.14, 0, 0, 2 * Math.PI);
  pen.fill();
  pen.lineWidth = 0.012;
  pen.strokeStyle = "rgb(0 0 0 / 0.3)";
  pen.stroke();
  pen.fillStyle = "#d9a57c";
  pen.beginPath();
  pen.arc(0.015, 0, 0.07, 0, 2 * Math.PI);
  pen.fill();
  pen.fillStyle = hair;
  pen.beginPath();
  pen.arc(-0.005, 0, 0.065, 0, 2 * Math.PI);
  pen.fill();
}
