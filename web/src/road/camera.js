// @ts-check
/**
 * Which part of the road is seen, and where on the canvas.
 *
 * The camera keeps the vehicle about a quarter from the bottom and trails it a little, so that the
 * road scrolls evenly while the vehicle's own steps stay visible.
 */

/** Where the vehicle stands in the view, as a share of its height from the top. */
const EGO_SHARE = 0.74;
/** How far the view goes beyond the road's ends, in cells. */
const BEYOND_CELLS = 0.7;
/** Time in which the camera makes up most of its distance. */
const LAG_S = 0.22;
/** The paved shoulder on either side, in cells. */
const SHOULDER_CELLS = 0.32;

/**
 * @typedef {object} View
 * @property {number} width  of the canvas, in CSS pixels
 * @property {number} height
 * @property {number} ratio  device pixels per CSS pixel
 * @property {number} cell  side of a cell, in CSS pixels
 * @property {number} left  of column 0
 * @property {number} visibleRows  as many as fit, in cells
 * @property {number} shoulder  in CSS pixels
 */

/**
 * Cells as large as fit, the road centred.
 * @param {{width: number, height: number, ratio: number}} canvas
 * @param {{columns: number, visibleRows: number}} road
 * @returns {View}
 */
export function viewOf({ width, height, ratio }, { columns, visibleRows }) {
  const cell = Math.max(1, Math.min(width / (columns + 2 * SHOULDER_CELLS), height / visibleRows));
  return {
    width,
    height,
    ratio,
    cell,
    left: (width - columns * cell) / 2,
    visibleRows: height / cell,
    shoulder: SHOULDER_CELLS * cell,
  };
}

/** The row at the top edge of the view, as it follows the vehicle. */
export class Camera {
  /** @type {number | null} */ top = null;

  /**
   * @param {number} egoRow  the vehicle's centre, in rows
   * @param {{rows: number}} road
   * @param {View} view
   * @param {number} elapsedS  since the last frame; Infinity cuts to the place
   * @returns {boolean} whether the camera is still on its way
   */
  follow(egoRow, { rows }, view, elapsedS) {
    const wanted = egoRow + 0.5 - view.visibleRows * EGO_SHARE;
    const lowest = rows + BEYOND_CELLS - view.visibleRows;
    const target = Math.max(-BEYOND_CELLS, Math.min(lowest, wanted));
    if (this.top === null || elapsedS === Infinity) this.top = target;
    this.top += (target - this.top) * (1 - Math.exp(-elapsedS / LAG_S));
    if (Math.abs(target - this.top) < 0.002) this.top = target;
    return this.top !== target;
  }
}
