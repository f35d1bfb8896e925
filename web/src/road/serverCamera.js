// @ts-check
/**
 * Where cells are on a picture that the service has drawn (`sim/render/camera.py`), so that it can be pointed at and
 * touched like the page's own. Pure.
 */

/** How far down the picture the vehicle is kept. */
const AHEAD_SHARE = 0.7;

/**
 * @typedef {object} Served
 * @property {number} cell  side of a cell, in CSS pixels
 * @property {number} left  of column 0, from the host's left
 * @property {number} top  of the picture, from the host's top
 * @property {number} row  at the picture's upper edge
 */

/**
 * @param {{width: number, height: number}} host  in CSS pixels; the picture is as large as fits, in the middle
 * @param {{width: number, height: number}} picture  in its own pixels
 * @param {{columns: number, rows: number, visibleRows: number}} world
 * @param {number} egoRow  the row the vehicle is seen in
 * @returns {Served}
 */
export function servedView(host, picture, { columns, rows, visibleRows }, egoRow) {
  const scale = Math.min(host.width / picture.width, host.height / picture.height);
  // A quarter of a cell, in whole pixels, is verge on either side.
  let cell = Math.ceil(picture.width / columns);
  while (cell > 1 && columns * cell + 2 * Math.floor(cell / 4) > picture.width) cell -= 1;
  const seen = Math.min(visibleRows, rows);
  return {
    cell: cell * scale,
    left: (host.width - picture.width * scale) / 2 + Math.floor(cell / 4) * scale,
    top: (host.height - picture.height * scale) / 2,
    row: Math.min(Math.max(0, egoRow + 0.5 - AHEAD_SHARE * seen), rows - seen),
  };
}
