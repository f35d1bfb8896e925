// @ts-check
/** The road as the program has it: a matrix of 0 and 1, each 1 in the colour of what stands there; around the vehicle where not all of it could be read. */

import { html, render } from "../../vendor/lit-html.js";
import { listText, t } from "../core/texts.js";
import { readPalette } from "../core/theme.js";
import { offerPlaces } from "../road/hitTest.js";
import { drawOccupancy } from "../road/paint/occupancy.js";
import { countTexts, egoOf } from "../road/world.js";
import { find, fitCanvas } from "../ui/slot.js";

/** @import { World } from "../road/world.js" */
/** @import { Panel } from "./index.js" */

/** The least size of a cell whose figure can be read [px]. */
const LEAST_CELL = { across: 11, along: 14 };
/** The share of the rows that lies ahead of the vehicle, where not all are shown. */
const AHEAD = 0.65;

/** @param {HTMLElement} host @returns {Panel} */
export function createOccupancy(host) {
  let palette = readPalette(document.documentElement);
  /** @type {World | null} */ let world = null;
  let drawn = "";
  /** @type {World | null} */ let of = null;

  const show = () => render(html`<canvas class="occupancy-canvas" role="img" aria-label=${world ? matrixText(world) : t("occupancy.label")}></canvas>`, host);
  show();
  const canvas = /** @type {HTMLCanvasElement} */ (find(host, "canvas"));

  const cells = () => {
    const { left, top, width, height } = canvas.getBoundingClientRect();
    return world && { left, top, ...layout(world, width, height) };
  };
  offerPlaces(canvas, {
    cellAt(x, y) {
      const at = cells();
      return at && [Math.floor((x - at.left - at.x) / at.across), Math.floor((y - at.top - at.y) / at.along)];
    },
    placeOf([column, row]) {
      const at = cells();
      return at && { left: at.left + at.x + column * at.across, top: at.top + at.y + row * at.along, width: at.across, height: at.along };
    },
  });

  return {
    update(state) {
      if (state.world === world || state.world === null) return;
      world = state.world;
      show();
    },

    repaint() {
      palette = readPalette(document.documentElement);
      of = null;
    },

    draw() {
      if (!world || host.clientWidth === 0) return false;
      const { clientWidth: width, clientHeight: height } = canvas;
      if (world === of && drawn === `${width} ${height}`) return false;
      of = world;
      drawn = `${width} ${height}`;
      const pen = fitCanvas(canvas, width, height);
      pen.clearRect(0, 0, width, height);
      drawOccupancy(pen, world, layout(world, width, height), palette);
      return false;
    },
  };
}

/**
 * Where the matrix is drawn. Where not all of it can be read at once, the stretch around the vehicle is shown.
 * @param {World} world @param {number} width @param {number} height
 */
export function layout(world, width, height) {
  const [column, row] = egoOf(world)?.cell ?? [0, 0];
  const acrossWay = stretch(world.columns, Math.floor(width / LEAST_CELL.across), column, 0.5);
  const alongWay = stretch(world.rows, Math.floor(height / LEAST_CELL.along), row, AHEAD);
  const along = height / alongWay.count;
  const across = Math.min(width / acrossWay.count, along * 1.7);
  const x = (width - across * acrossWay.count) / 2 - acrossWay.first * across;
  return { x, y: -alongWay.first * along, across, along, columns: acrossWay, rows: alongWay };
}

/** So many of `all`, with `at` at a share of them. @param {number} all @param {number} most @param {number} at @param {number} share */
function stretch(all, most, at, share) {
  const count = Math.min(all, Math.max(1, most));
  return { first: Math.max(0, Math.min(all - count, Math.round(at - count * share))), count };
}

/** The matrix in words. @param {World} world */
export function matrixText(world) {
  const { columns, rows } = world;
  const taken = new Set([...world.things.values()].map(({ cell: [column, row] }) => row * columns + column)).size;
  const things = listText(countTexts(world)) || t("occupancy.nothing");
  const text = t("occupancy.text", { columns, rows, taken, cells: columns * rows, things });
  const ego = egoOf(world);
  return ego ? `${text} ${t("occupancy.vehicle", { column: ego.cell[0] + 1, row: ego.cell[1] })}` : text;
}
