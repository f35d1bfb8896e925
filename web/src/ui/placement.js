// @ts-check
/** Where a card goes in the window, and whether what it speaks of is still to be seen. Geometry alone. */

/** @import { Place } from "../road/hitTest.js" */

const GAP_PX = 10;

/**
 * Where a card goes: beside what it speaks of, or above or below; wholly in the window, and rather not on the vehicle.
 * @param {Place} anchor
 * @param {number} width
 * @param {number} height
 * @param {Place | null} ego
 * @returns {[number, number]}
 */
export function besides(anchor, width, height, ego) {
  const middle = anchor.top + (anchor.height - height) / 2;
  const centre = anchor.left + (anchor.width - width) / 2;
  const spots = [
    [anchor.left + anchor.width + GAP_PX, middle],
    [anchor.left - GAP_PX - width, middle],
    [centre, anchor.top - GAP_PX - height],
    [centre, anchor.top + anchor.height + GAP_PX],
  ].map(([x, y]) => [inside(x, width, innerWidth), inside(y, height, innerHeight)]);
  const overlap = (/** @type {number[]} */ [left, top], /** @type {Place | null} */ other) =>
    other === null
      ? 0
      : Math.max(0, Math.min(left + width, other.left + other.width) - Math.max(left, other.left)) *
        Math.max(0, Math.min(top + height, other.top + other.height) - Math.max(top, other.top));
  const badness = spots.map((spot) => 4 * overlap(spot, anchor) + overlap(spot, ego));
  const [x, y] = spots[badness.indexOf(Math.min(...badness))];
  return [x, y];
}

/** @param {number} at @param {number} size @param {number} room */
function inside(at, size, room) {
  return Math.round(Math.max(GAP_PX, Math.min(at, room - size - GAP_PX)));
}

/** Whether a place is seen in a frame, if only in part. @param {Place} place @param {DOMRect} frame */
export function meets({ left, top, width, height }, frame) {
  return left < frame.right - 2 && left + width > frame.left + 2 && top < frame.bottom - 2 && top + height > frame.top + 2;
}

/** Lay an element over a place of the window. @param {HTMLElement} element @param {Place} place */
export function lay(element, { left, top, width, height }) {
  element.style.transform = `translate(${left}px, ${top}px)`;
  element.style.inlineSize = `${width}px`;
  element.style.blockSize = `${height}px`;
}
