// @ts-check
/** The road as the program has it: a matrix of 0 and 1, each 1 in the colour of what stands there; squares where figures could not be read. */

import { html, render } from "../../vendor/lit-html.js";
import { listText, t } from "../core/texts.js";
import { readPalette } from "../core/theme.js";
import { offerPlaces } from "../road/hitTest.js";
import { drawOccupancy } from "../road/paint/occupancy.js";
import { countTexts, egoOf } from "../road/world.js";
import { find, fitCanvas } from "../ui/slot.js";

/** @import { World } from "../road/world.js" */
/** @import { Panel } from "./index.js" */

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

/** Cells no wider than they need to be, in the middle. @param {World} world @param {number} width @param {number} height */
function layout({ columns, rows }, width, height) {
  const along = height / rows;
  const across = Math.min(width / columns, along * 1.7);
  return { x: (width - across * columns) / 2, y: 0, across, along };
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
