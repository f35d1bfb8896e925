// @ts-check
/**
 * The eye of the perspective view: where it is, and where places on the road are seen. Pure.
 *
 * One vanishing point and an upright picture plane (a lens shifted down, not tilted): what stands upright is seen upright,
 * and a row of the road is a level line. Units are cells, whole numbers being centres of cells; `up` is the height above
 * the road.
 */

/** Where the horizon and the vehicle's row are, as shares of the height from the top. */
const HORIZON_SHARE = 0.13;
const EGO_SHARE = 0.79;
/** How far behind the vehicle's centre the eye is, as a multiple of its height. */
const BACK_SHARE = 1.45;
/** Wider roads are seen in part, and the eye goes sideways with the vehicle. */
const MOST_COLUMNS = 11;
/** What is seen of the verge on either side, in cells. */
const VERGE_CELLS = 0.85;
/** The eye is this high at least, in cells: on a low, wide canvas cells are smaller instead. */
const LEAST_HEIGHT = 4.2;
/** Time in which the eye makes up most of its distance. */
const LAG_S = 0.22;
/** Nothing nearer than this share of the nearest ground is seen. */
const NEAR_SHARE = 0.86;
/** Rows that are drawn ahead of the vehicle. */
export const AHEAD_ROWS = 46;

/** @typedef {readonly [x: number, y: number]} Point  in CSS pixels */

/**
 * @typedef {object} Lens
 * @property {number} width  of the canvas, in CSS pixels
 * @property {number} height
 * @property {number} ratio  device pixels per CSS pixel
 * @property {number} columns  that are seen in the vehicle's row
 * @property {number} cell  side of a cell there, in CSS pixels
 * @property {number} horizon  in CSS pixels from the top
 * @property {number} lift  height of the eye, in cells
 * @property {number} back  its distance behind the vehicle, in cells
 * @property {number} near  the least distance at which anything is seen, in cells
 */

/**
 * @param {{width: number, height: number, ratio: number}} canvas
 * @param {{columns: number}} road
 * @returns {Lens}
 */
export function lensOf({ width, height, ratio }, road) {
  const columns = Math.min(road.columns, MOST_COLUMNS) + 2 * VERGE_CELLS;
  const fall = (EGO_SHARE - HORIZON_SHARE) * height;
  const cell = Math.max(1, Math.min(width / columns, fall / LEAST_HEIGHT));
  const lift = fall / cell;
  const back = lift * BACK_SHARE;
  const near = (NEAR_SHARE * back * fall) / (height * (1 - HORIZON_SHARE));
  return { width, height, ratio, columns: width / cell, cell, horizon: HORIZON_SHARE * height, lift, back, near };
}

export class Eye {
  /** Above which column. */ x = 0;
  /** Behind which row. @type {number | null} */ row = null;

  /** @param {Lens} lens */
  constructor(lens) {
    this.lens = lens;
  }

  /**
   * Goes after the vehicle.
   * @param {{column: number, row: number}} ego  its centre
   * @param {{columns: number}} road
   * @param {number} elapsedS  since the last frame; Infinity cuts to the place
   * @returns {boolean} whether it is still on its way
   */
  follow(ego, { columns }, elapsedS) {
    const beside = Math.max(0, (columns + 2 * VERGE_CELLS - this.lens.columns) / 2);
    const middle = (columns - 1) / 2;
    const x = middle + Math.max(-beside, Math.min(beside, ego.column - middle));
    const cut = this.row === null || elapsedS === Infinity;
    const share = cut ? 1 : 1 - Math.exp(-elapsedS / LAG_S);
    const row = this.row ?? ego.row;
    this.x += (x - this.x) * share;
    this.row = row + (ego.row - row) * share;
    if (Math.hypot(x - this.x, ego.row - this.row) < 0.002) [this.x, this.row] = [x, ego.row];
    return this.x !== x || this.row !== ego.row;
  }

  /** How far ahead of the eye a row is, in cells. @param {number} row */
  distance(row) {
    return (this.row ?? 0) - row + this.lens.back;
  }

  /** The nearest row of which anything is seen. */
  get nearest() {
    return (this.row ?? 0) + this.lens.back - this.lens.near;
  }

  /** The side of a cell in a row, in CSS pixels. @param {number} row */
  scale(row) {
    const { cell, back, near } = this.lens;
    return (cell * back) / Math.max(near, this.distance(row));
  }

  /** @param {number} column @param {number} row @param {number} [up] @returns {Point} */
  spot(column, row, up = 0) {
    const { width, horizon, lift } = this.lens;
    const scale = this.scale(row);
    return [width / 2 + (column - this.x) * scale, horizon + (lift - up) * scale];
  }

  /** Where on the road a point is; null for the sky. @param {number} x @param {number} y @returns {[column: number, row: number] | null} */
  ground(x, y) {
    const { width, horizon, lift, cell, back } = this.lens;
    const scale = (y - horizon) / lift;
    if (scale < (cell * back) / (4 * AHEAD_ROWS)) return null;
    return [this.x + (x - width / 2) / scale, (this.row ?? 0) + back - (cell * back) / scale];
  }
}
