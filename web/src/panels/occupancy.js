// @ts-check
/** The road as the program has it: a matrix of 0 and 1, each 1 in the colour of what stands there. */

import { make } from "../ui/dom.js";
import { offerPlaces } from "../road/hitTest.js";
import { drawOccupancy } from "../road/paint/occupancy.js";
import { readPalette } from "../core/theme.js";
import { counted } from "../core/words.js";
import { countsOf, egoOf } from "../road/world.js";

/** @import { World } from "../road/world.js" */
/** @import { Panel } from "./index.js" */

const RATIO = 2;

/** @param {HTMLElement} host @returns {Panel} */
export function createOccupancy(host) {
  const canvas = make("canvas", { class: "occupancy-canvas", role: "img", "aria-label": "Occupancy matrix" });
  host.append(canvas);
  const pen = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
  let palette = readPalette(document.documentElement);
  /** @type {World | null} */ let world = null;
  /** @type {World | null} */ let drawn = null;
  let [width, height] = [0, 0];

  const cells = () => {
    const { left, top } = canvas.getBoundingClientRect();
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
      canvas.setAttribute("aria-label", describeMatrix(world));
    },

    repaint() {
      palette = readPalette(document.documentElement);
      drawn = null;
    },

    draw() {
      if (!world || host.clientWidth === 0) return false;
      const { clientWidth, clientHeight } = host;
      if (world === drawn && width === clientWidth && height === clientHeight) return false;
      drawn = world;
      const ratio = Math.min(RATIO, devicePixelRatio || 1);
      if (width !== clientWidth || height !== clientHeight || canvas.width !== Math.round(width * ratio)) {
        [width, height] = [clientWidth, clientHeight];
        canvas.width = Math.round(width * ratio);
        canvas.height = Math.round(height * ratio);
      }
      pen.setTransform(ratio, 0, 0, ratio, 0, 0);
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

/** @param {World} world */
export function describeMatrix(world) {
  const counts = countsOf(world);
  const taken = new Set([...world.things.values()].map(({ cell: [column, row] }) => row * world.columns + column)).size;
  const ego = egoOf(world);
  const kinds = Object.entries(counts).filter(([kind]) => kind !== "av").map(([kind, count]) => counted(count, kind));
  const where = ego ? ` The vehicle is in column ${ego.cell[0] + 1} of row ${ego.cell[1]}.` : "";
  return `Occupancy of ${world.columns} columns and ${world.rows} rows: ${taken} of ${world.columns * world.rows} cells are taken, ${kinds.join(", ") || "by nothing else"}.${where}`;
}
