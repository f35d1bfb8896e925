// @ts-check
/** Paths that several painters share. */

/**
 * A rounded rectangle centred on (x, y), as the current path.
 * @param {CanvasRenderingContext2D} pen
 * @param {number} x
 * @param {number} y
 * @param {number} width
 * @param {number} height
 * @param {number | number[]} radius  one for all corners, or four clockwise from the upper left
 */
export function box(pen, x, y, width, height, radius) {
  pen.beginPath();
  pen.roundRect(x - width / 2, y - height / 2, width, height, radius);
}

/**
 * A closed smooth curve through points, as the current path.
 * @param {CanvasRenderingContext2D} pen
 * @param {[number, number][]} points
 */
export function blob(pen, points) {
  const count = points.length;
  const between = (/** @type {number} */ at) => {
    const [ax, ay] = points[at % count];
    const [bx, by] = points[(at + 1) % count];
    return /** @type {const} */ ([(ax + bx) / 2, (ay + by) / 2]);
  };
  pen.beginPath();
  pen.moveTo(...between(count - 1));
  for (let at = 0; at < count; at++) pen.quadraticCurveTo(...points[at], ...between(at));
  pen.closePath();
}

/**
 * A soft shadow of the current look of `fill`, without the shape itself: the shape is drawn far
 * outside the picture and only its shadow falls inside.
 * @param {CanvasRenderingContext2D} pen  in cells, unrotated
 * @param {string} colour
 * @param {number} blurCells
 * @param {(pen: CanvasRenderingContext2D) => void} fill
 */
export function castShadow(pen, colour, blurCells, fill) {
  const away = 8;
  const scale = pen.getTransform().a;
  pen.save();
  pen.shadowColor = colour;
  pen.shadowBlur = blurCells * scale;
  pen.shadowOffsetX = away * scale;
  pen.fillStyle = "#000";
  pen.translate(-away, 0);
  fill(pen);
  pen.restore();
}

/**
 * A filled circle.
 * @param {CanvasRenderingContext2D} pen
 * @param {number} x
 * @param {number} y
 * @param {number} radius
 */
export function disc(pen, x, y, radius) {
  pen.beginPath();
  pen.arc(x, y, radius, 0, 2 * Math.PI);
  pen.fill();
}
