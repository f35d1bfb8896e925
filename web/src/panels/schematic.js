// @ts-check
/** The whole road at a glance: a sign for each thing, and a frame around what the road's view shows of it. */

import { make } from "../ui/dom.js";
import { offerPlaces } from "../road/hitTest.js";
import { drawGlyph } from "../road/paint/glyphs.js";
import { readPalette } from "../core/theme.js";

/** @import { Places } from "../road/hitTest.js" */
/** @import { World } from "../road/world.js" */
/** @import { Panel } from "./index.js" */

const MARGIN_PX = 9;
const LEGEND = "The whole road. Blue: the vehicle · red: cars · green: walkers · yellow: potholes · orange: barriers";

/** @param {HTMLElement} host @param {Places} road  whose view is framed @returns {Panel} */
export function createSchematic(host, road) {
  const canvas = make("canvas", { role: "img", "aria-label": LEGEND, title: LEGEND });
  host.append(canvas);
  const pen = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
  let palette = readPalette(document.documentElement);
  /** @type {World | null} */ let world = null;
  let drawn = "";
  /** @type {World | null} */ let of = null;
  const layout = (/** @type {World} */ { columns, rows }) => {
    const across = (host.clientWidth - 2 * MARGIN_PX) / columns;
    const along = (host.clientHeight - 2 * MARGIN_PX) / rows;
    const width = Math.min(across, along * 2.4);
    return { x: (host.clientWidth - width * columns) / 2, y: MARGIN_PX, across: width, along };
  };

  offerPlaces(canvas, {
    cellAt(x, y) {
      if (!world) return null;
      const { left, top } = canvas.getBoundingClientRect();
      const at = layout(world);
      return [Math.floor((x - left - at.x) / at.across), Math.floor((y - top - at.y) / at.along)];
    },
    placeOf([column, row]) {
      if (!world) return null;
      const { left, top } = canvas.getBoundingClientRect();
      const at = layout(world);
      return { left: left + at.x + column * at.across, top: top + at.y + row * at.along, width: at.across, height: at.along };
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
      const ratio = Math.min(2, devicePixelRatio || 1);
      const seen = road.window?.() ?? null;
      const { x, y, across, along } = layout(world);
      const key = `${width} ${height} ${seen?.map((row) => Math.round(row * along))}`;
      if (world === of && key === drawn) return false;
      of = world;
      drawn = key;
      if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
        canvas.width = Math.round(width * ratio);
        canvas.height = Math.round(height * ratio);
      }
      pen.setTransform(ratio, 0, 0, ratio, 0, 0);
      pen.clearRect(0, 0, width, height);
      pen.translate(x, y);
      const [road_width, road_height] = [across * world.columns, along * world.rows];
      pen.fillStyle = palette.cell;
      pen.beginPath();
      pen.roundRect(-3, -3, road_width + 6, road_height + 6, 6);
      pen.fill();
      pen.fillStyle = palette.goal;
      pen.fillRect(0, 0, road_width, Math.min(3, along));
      if (seen) frame(pen, seen, road_width, road_height, along, palette);
      const size = Math.min(across * 1.3, along);
      for (const fixed of [true, false]) {
        for (const thing of world.things.values()) {
          if ((thing.heading === null && thing.kind !== "av") !== fixed) continue;
          const [column, row] = thing.cell;
          drawGlyph(pen, thing, (column + 0.5) * across, (row + 0.5) * along, thing.kind === "av" ? size * 1.35 : size, palette);
        }
      }
      return false;
    },
  };
}

/**
 * What the road's view shows, from row to row.
 * @param {CanvasRenderingContext2D} pen
 * @param {[number, number]} rows
 * @param {number} width
 * @param {number} height
 * @param {number} along
 * @param {import("../core/theme.js").Palette} palette
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
