// @ts-check
/** The whole road at a glance: a sign for each thing, and a frame around what the road's view shows of it. */

import { html, render } from "../../vendor/lit-html.js";
import { t } from "../core/texts.js";
import { readPalette } from "../core/theme.js";
import { offerPlaces } from "../road/hitTest.js";
import { drawGlyph } from "../road/paint/glyphs.js";
import { find, fitCanvas } from "../ui/slot.js";

/** @import { Places } from "../road/hitTest.js" */
/** @import { World } from "../road/world.js" */
/** @import { Palette } from "../core/theme.js" */
/** @import { Panel } from "./index.js" */

/** @typedef {{x: number, y: number, across: number, along: number}} Layout  of cells, in CSS pixels */

const MARGIN_PX = 9;

/** @param {HTMLElement} host @param {Places} road  whose view is framed @returns {Panel} */
export function createSchematic(host, road) {
  const label = t("schematic.label");
  render(html`<canvas role="img" aria-label=${label} title=${label}></canvas>`, host);
  const canvas = /** @type {HTMLCanvasElement} */ (find(host, "canvas"));
  let palette = readPalette(document.documentElement);
  /** @type {World | null} */ let world = null;
  let drawn = "";
  /** @type {World | null} */ let of = null;

  /** Cells as the canvas shows them, from the window's corner. */
  const cells = () => {
    if (!world) return null;
    const { left, top } = canvas.getBoundingClientRect();
    const { x, y, across, along } = layout(world, host);
    return { left: left + x, top: top + y, across, along };
  };
  offerPlaces(canvas, {
    cellAt(x, y) {
      const at = cells();
      return at && [Math.floor((x - at.left) / at.across), Math.floor((y - at.top) / at.along)];
    },
    placeOf([column, row]) {
      const at = cells();
      return at && { left: at.left + column * at.across, top: at.top + row * at.along, width: at.across, height: at.along };
    },
  });

  return {
    update(state) {
      world = state.world;
    },

    repaint() {
      palette = readPalette(document.documentElement);
      of = null;
    },

    draw() {
      if (world === null || host.clientWidth === 0) return false;
      const { clientWidth: width, clientHeight: height } = host;
      const seen = road.window?.() ?? null;
      const at = layout(world, host);
      const key = `${width} ${height} ${seen?.map((row) => Math.round(row * at.along))}`;
      if (world === of && key === drawn) return false;
      of = world;
      drawn = key;
      const pen = fitCanvas(canvas, width, height);
      pen.clearRect(0, 0, width, height);
      paint(pen, world, at, seen, palette);
      return false;
    },
  };
}

/** Cells as large as fit, not too wide, in the middle. @param {World} world @param {HTMLElement} host @returns {Layout} */
function layout({ columns, rows }, { clientWidth, clientHeight }) {
  const along = (clientHeight - 2 * MARGIN_PX) / rows;
  const across = Math.min((clientWidth - 2 * MARGIN_PX) / columns, along * 2.4);
  return { x: (clientWidth - across * columns) / 2, y: MARGIN_PX, across, along };
}

/**
 * @param {CanvasRenderingContext2D} pen
 * @param {World} world
 * @param {Layout} at
 * @param {[number, number] | null} seen  the rows that the road's view shows
 * @param {Palette} palette
 */
function paint(pen, world, { x, y, across, along }, seen, palette) {
  pen.translate(x, y);
  const [width, height] = [across * world.columns, along * world.rows];
  pen.fillStyle = palette.cell;
  pen.beginPath();
  pen.roundRect(-3, -3, width + 6, height + 6, 6);
  pen.fill();
  pen.fillStyle = palette.goal;
  pen.fillRect(0, 0, width, Math.min(3, along));
  if (seen) frame(pen, seen, width, height, along, palette);
  const size = Math.min(across * 1.3, along);
  for (const fixed of [true, false]) {
    for (const thing of world.things.values()) {
      if ((thing.heading === null && thing.kind !== "av") !== fixed) continue;
      const [column, row] = thing.cell;
      drawGlyph(pen, thing, (column + 0.5) * across, (row + 0.5) * along, thing.kind === "av" ? size * 1.35 : size, palette);
    }
  }
}

/**
 * What the road's view shows, from row to row.
 * @param {CanvasRenderingContext2D} pen
 * @param {[number, number]} rows
 * @param {number} width
 * @param {number} height
 * @param {number} along
 * @param {Palette} palette
 */
function frame(pen, [first, last], width, height, along, palette) {
  const top = Math.max(-2, first * along);
  const bottom = Math.min(height + 2, last * along);
  pen.save();
  pen.beginPath();
  pen.roundRect(-3, top, width + 6, bottom - top, 4);
  pen.globalAlpha = 0.1;
  pen.fillStyle = palette.focus;
  pen.fill();
  pen.globalAlpha = 0.7;
  pen.lineWidth = 1.25;
  pen.strokeStyle = palette.focus;
  pen.stroke();
  pen.restore();
}
