// @ts-check
/** What vehicles say with lamps and signs: braking, turning, never moving again. */

import { box, disc } from "./shapes.js";
import { SIZES } from "./vehicle.js";

/** @typedef {CanvasRenderingContext2D} Pen */

/**
 * Lamps at the vehicle's rear corners: brakes, or one side's indicator.
 * @param {Pen} pen
 * @param {"brake" | "left" | "right"} signal
 */
export function drawSignal(pen, signal) {
  const { length, width } = SIZES.ego;
  const spots =
    signal === "brake"
      ? [[-1, -1], [-1, 1]]
      : [[-1, signal === "left" ? -1 : 1], [1, signal === "left" ? -1 : 1]];
  for (const [end, side] of spots) {
    const x = (end * length * 0.94) / 2;
    const y = (side * width * 0.8) / 2;
    const glow = pen.createRadialGradient(x, y, 0, x, y, 0.15);
    glow.addColorStop(0, signal === "brake" ? "rgb(255 60 50 / 0.95)" : "rgb(255 176 46 / 0.95)");
    glow.addColorStop(1, "rgb(255 120 46 / 0)");
    pen.fillStyle = glow;
    disc(pen, x, y, 0.15);
  }
}

/**
 * The sign over a vehicle that will not move again.
 * @param {Pen} pen  unrotated
 */
export function paintWarning(pen) {
  pen.lineJoin = "round";
  pen.beginPath();
  pen.moveTo(0, -0.17);
  pen.lineTo(0.18, 0.14);
  pen.lineTo(-0.18, 0.14);
  pen.closePath();
  pen.fillStyle = "#fff";
  pen.strokeStyle = "#d0342c";
  pen.lineWidth = 0.065;
  pen.stroke();
  pen.fill();
  pen.fillStyle = "#1b1f27";
  box(pen, 0, -0.005, 0.034, 0.12, 0.017);
  pen.fill();
  disc(pen, 0, 0.095, 0.02);
}
