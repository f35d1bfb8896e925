// @ts-check
/** What vehicles say with lamps and signs: braking, turning, never moving again. */

import { box, disc } from "./shapes.js";
import { EGO_LENGTH, EGO_WIDTH } from "./vehicle.js";

/** @typedef {CanvasRenderingContext2D} Pen */

/** Radius of a lamp's glow, in cells. */
const GLOW = 0.1;

/**
 * Lamps at the vehicle's rear corners: brakes, or one side's indicator.
 * @param {Pen} pen
 * @param {"brake" | "left" | "right"} signal
 */
export function drawSignal(pen, signal) {
  const spots =
    signal === "brake"
      ? [[-1, -1], [-1, 1]]
      : [[-1, signal === "left" ? -1 : 1], [1, signal === "left" ? -1 : 1]];
  for (const [end, side] of spots) {
    const x = (end * EGO_LENGTH * 0.9) / 2;
    const y = (side * EGO_WIDTH * 0.7) / 2;
    const glow = pen.createRadialGradient(x, y, 0, x, y, GLOW);
    glow.addColorStop(0, signal === "brake" ? "rgb(255 60 50 / 0.95)" : "rgb(255 176 46 / 0.95)");
    glow.addColorStop(1, "rgb(255 120 46 / 0)");
    pen.fillStyle = glow;
    disc(pen, x, y, GLOW);
  }
}

/**
 * The sign over a vehicle that will not move again.
 * @param {Pen} pen  unrotated
 */
export function paintWarning(pen) {
  pen.lineJoin = "round";
  pen.beginPath();
  pen.moveTo(0, -0.1);
  pen.lineTo(0.115, 0.09);
  pen.lineTo(-0.115, 0.09);
  pen.closePath();
  pen.fillStyle = "#fff";
  pen.strokeStyle = "#d0342c";
  pen.lineWidth = 0.05;
  pen.stroke();
  pen.fill();
  pen.fillStyle = "#1b1f27";
  box(pen, 0, 0.002, 0.026, 0.076, 0.013);
  pen.fill();
  disc(pen, 0, 0.066, 0.015);
}
