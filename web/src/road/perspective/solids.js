// @ts-check
/** Solid shapes in perspective: faces on the ground, boxes whose top may be smaller than their foot, upright drawings. */

/** @import { Palette } from "../../core/theme.js" */
/** @import { Eye, Point } from "./eye.js" */

/** @typedef {CanvasRenderingContext2D} Pen */
/** @typedef {{left: number, right: number, far: number, near: number, up: number}} Level  a rectangle at a height, in cells */
/** @typedef {{top: string, near: string, side: string}} Faces  the colours of a box */

/** Seams between narrower faces are not seen [px of the line around them]. */
const SEAM_PX = 0.55;
/** Shadows have a soft edge where cells are larger [px]. */
const SOFT_FROM_PX = 40;

/**
 * A closed shape through points, as the current path.
 * @param {Pen} pen
 * @param {readonly Point[]} points
 */
export function shape(pen, points) {
  pen.beginPath();
  points.forEach(([x, y], at) => (at === 0 ? pen.moveTo(x, y) : pen.lineTo(x, y)));
  pen.closePath();
}

/**
 * A rectangle lying on the ground, as the current path.
 * @param {Pen} pen
 * @param {Eye} eye
 * @param {number} left
 * @param {number} right
 * @param {number} far  the row of its far edge
 * @param {number} near
 */
export function flat(pen, eye, left, right, far, near) {
  shape(pen, [eye.spot(left, far), eye.spot(right, far), eye.spot(right, near), eye.spot(left, near)]);
}

/** Adds a rectangle on the ground to the current path. @param {Pen} pen @param {Eye} eye @param {number} left @param {number} right @param {number} far @param {number} near */
export function quad(pen, eye, left, right, far, near) {
  if (far >= near) return;
  pen.moveTo(...eye.spot(left, far));
  pen.lineTo(...eye.spot(right, far));
  pen.lineTo(...eye.spot(right, near));
  pen.lineTo(...eye.spot(left, near));
}

/**
 * Fills a face. Where that is seen, its own colour around it closes the seams and takes the sharpness off its corners.
 * @param {Pen} pen
 * @param {readonly Point[]} points
 * @param {string} colour
 */
export function face(pen, points, colour) {
  shape(pen, points);
  pen.fillStyle = pen.strokeStyle = colour;
  pen.fill();
  if (pen.lineWidth > SEAM_PX) pen.stroke();
}

/**
 * A box from its foot to its top, as far as it is seen from above and behind.
 * @param {Pen} pen
 * @param {Eye} eye
 * @param {Level} foot
 * @param {Level} top
 * @param {Faces} faces
 */
export function solid(pen, eye, foot, top, faces) {
  pen.lineJoin = "round";
  pen.lineWidth = Math.max(0.1, eye.scale(foot.near) * 0.018);
  const [footFar, footNear] = edges(eye, foot);
  const [topFar, topNear] = edges(eye, top);
  if (foot.left > eye.x) face(pen, [footFar[0], topFar[0], topNear[0], footNear[0]], faces.side);
  else if (foot.right < eye.x) face(pen, [footFar[1], topFar[1], topNear[1], footNear[1]], faces.side);
  face(pen, [footNear[0], footNear[1], topNear[1], topNear[0]], faces.near);
  face(pen, [topFar[0], topFar[1], topNear[1], topNear[0]], faces.top);
}

/** The far and the near edge of a level, each from left to right. @param {Eye} eye @param {Level} level */
function edges(eye, { left, right, far, near, up }) {
  return [far, near].map((row) => [eye.spot(left, row, up), eye.spot(right, row, up)]);
}

/**
 * A box of even width.
 * @param {number} column
 * @param {number} row
 * @param {number} across
 * @param {number} along
 * @param {number} up
 * @returns {Level}
 */
export function level(column, row, across, along, up) {
  return { left: column - across / 2, right: column + across / 2, far: row - along / 2, near: row + along / 2, up };
}

/**
 * Draws something that stands upright and faces the eye: one unit is a cell, up is negative, the foot is at the origin.
 * @param {Pen} pen
 * @param {Eye} eye
 * @param {number} column
 * @param {number} row
 * @param {() => void} draw
 */
export function upright(pen, eye, column, row, draw) {
  const [x, y] = eye.spot(column, row);
  const scale = eye.scale(row);
  pen.save();
  pen.translate(x, y);
  pen.scale(scale, scale);
  draw();
  pen.restore();
}

/**
 * A round mark lying on the ground, as the current path.
 * @param {Pen} pen
 * @param {Eye} eye
 * @param {number} column
 * @param {number} row
 * @param {number} across  its radius from side to side
 * @param {number} [along]  and from near to far
 * @param {number} [power]  2 for a circle; more make it a rectangle with round corners (a superellipse)
 */
export function disc(pen, eye, column, row, across, along = across, power = 2) {
  const steps = power === 2 ? 28 : 16;
  const part = (/** @type {number} */ share) => Math.sign(share) * Math.abs(share) ** (2 / power);
  shape(
    pen,
    Array.from({ length: steps }, (_, at) => {
      const angle = (at / steps) * 2 * Math.PI;
      return eye.spot(column + across * part(Math.cos(angle)), row + along * part(Math.sin(angle)));
    }),
  );
}

/** The shadow of a body. @param {Pen} pen @param {Eye} eye @param {number} column @param {number} row @param {number} across @param {number} along @param {Palette} palette */
export function shadow(pen, eye, column, row, across, along, palette) {
  const alpha = pen.globalAlpha;
  pen.fillStyle = palette.shadow;
  const soft = eye.scale(row) > SOFT_FROM_PX;
  for (const more of soft ? [0.07, 0.045, 0.02] : [0.04]) {
    pen.globalAlpha = alpha * (soft ? 0.4 : 0.7);
    disc(pen, eye, column + 0.02, row + 0.02, across / 2 + more, along / 2 + more, 4);
    pen.fill();
  }
  pen.globalAlpha = alpha;
}
