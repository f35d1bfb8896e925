// @ts-check
/** What is drawn on top to explain: the trail, the move under way, rings around causes, the impact. */

/** @import { Palette } from "../../core/theme.js" */

/** @typedef {CanvasRenderingContext2D} Pen */

/**
 * Where the vehicle has been, fading with age. Units are cells; (0, 0) is the centre of cell [0, 0].
 * @param {Pen} pen
 * @param {[number, number][]} cells  oldest first
 * @param {Palette} palette
 */
export function drawTrail(pen, cells, palette) {
  pen.fillStyle = palette.accent;
  cells.forEach(([column, row], at) => {
    pen.globalAlpha = 0.85 * ((at + 1) / cells.length) ** 1.3;
    pen.beginPath();
    pen.arc(column, row, 0.05, 0, 2 * Math.PI);
    pen.fill();
  });
  pen.globalAlpha = 1;
}

/** How much of a mark is left: it fades towards the end of its step. @param {number} progress  0–1 */
function fading(progress) {
  return 1 - Math.max(0, progress - 0.7) / 0.3;
}

/**
 * Standing still: a bar across the way ahead.
 * @param {Pen} pen  in cells
 * @param {[number, number]} at
 * @param {number} progress  0–1
 * @param {Palette} palette
 */
export function drawWait(pen, at, progress, palette) {
  pen.save();
  pen.translate(at[0], at[1]);
  pen.globalAlpha = fading(progress);
  pen.lineCap = "round";
  pen.strokeStyle = palette.danger;
  pen.lineWidth = 0.07;
  pen.beginPath();
  pen.moveTo(-0.22, -0.56);
  pen.lineTo(0.22, -0.56);
  pen.stroke();
  pen.restore();
}

/**
 * The move under way: a band to the cell it leads to, ending in an arrow head.
 * @param {Pen} pen  in cells
 * @param {[number, number]} from
 * @param {[number, number]} to
 * @param {number} progress  0–1
 * @param {Palette} palette
 */
export function drawMove(pen, from, to, progress, palette) {
  const alpha = fading(progress);
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const length = Math.hypot(dx, dy);
  if (length < 0.01) return;
  pen.save();
  pen.translate(from[0], from[1]);
  pen.lineJoin = "round";
  pen.rotate(Math.atan2(dy, dx));
  const reach = length + 0.5;
  const band = pen.createLinearGradient(0, 0, reach, 0);
  band.addColorStop(0, "transparent");
  band.addColorStop(1, palette.accent);
  pen.strokeStyle = band;
  pen.globalAlpha = alpha * 0.34;
  pen.lineWidth = 0.3;
  pen.lineCap = "butt";
  pen.beginPath();
  pen.moveTo(0, 0);
  pen.lineTo(reach - 0.22, 0);
  pen.stroke();
  pen.globalAlpha = alpha * 0.95;
  pen.strokeStyle = palette.accent;
  pen.lineCap = "round";
  pen.lineWidth = 0.075;
  pen.beginPath();
  pen.moveTo(reach - 0.15, -0.16);
  pen.lineTo(reach, 0);
  pen.lineTo(reach - 0.15, 0.16);
  pen.stroke();
  pen.restore();
}

/**
 * A ring around something that matters to the decision.
 * @param {Pen} pen  in cells, centred on it
 * @param {string} colour
 * @param {number} alpha
 * @param {number} radius
 */
export function drawRing(pen, colour, alpha, radius = 0.49) {
  pen.save();
  pen.globalAlpha = alpha * 0.14;
  pen.fillStyle = colour;
  pen.beginPath();
  pen.arc(0, 0, radius, 0, 2 * Math.PI);
  pen.fill();
  pen.globalAlpha = alpha;
  pen.strokeStyle = colour;
  pen.lineWidth = 0.045;
  pen.stroke();
  pen.restore();
}

/**
 * A cell that is spoken of, outlined.
 * @param {Pen} pen  in cells, centred on it
 * @param {string} colour
 */
export function drawCell(pen, colour) {
  pen.save();
  pen.strokeStyle = colour;
  pen.lineWidth = 0.04;
  pen.setLineDash([0.14, 0.09]);
  pen.beginPath();
  pen.roundRect(-0.46, -0.46, 0.92, 0.92, 0.1);
  pen.stroke();
  pen.restore();
}

/**
 * Where bodies touched: a burst under them, so that they stay to be seen.
 * @param {Pen} pen  in cells, centred on it
 * @param {number} progress  0–1 since it happened
 * @param {Palette} palette
 */
export function drawImpact(pen, progress, palette) {
  pen.save();
  for (const [share, colour, alpha] of /** @type {[number, string, number][]} */ ([
    [1, palette.danger, 0.9],
    [0.72, palette.cause, 0.95],
    [0.45, "#fff4d6", 0.95],
  ])) {
    pen.fillStyle = colour;
    pen.globalAlpha = alpha - 0.25 * progress;
    burst(pen, share * (0.4 + 0.2 * progress));
    pen.fill();
  }
  pen.restore();
}

/**
 * A star of uneven points, as the current path.
 * @param {Pen} pen
 * @param {number} size
 */
function burst(pen, size) {
  pen.beginPath();
  for (let at = 0; at < 26; at++) {
    const radius = size * (at % 2 === 0 ? 1 - 0.14 * ((at * 5) % 3) : 0.62);
    const angle = (at / 26) * 2 * Math.PI;
    pen.lineTo(Math.cos(angle) * radius, Math.sin(angle) * radius);
  }
  pen.closePath();
}
