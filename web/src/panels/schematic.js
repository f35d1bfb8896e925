// @ts-check
/** The whole road at a glance: a small square for each thing, the road stretched to the room. */

import { make } from "../dom.js";
import { readPalette } from "../theme.js";

/** @import { World } from "../world.js" */
/** @import { Panel } from "./index.js" */

const COLOURS = /** @type {Record<string, string>} */ ({
  av: "#2f6fed",
  vehicle: "#d5534a",
  pedestrian: "#3f9d77",
  pothole: "#d9a520",
  barrier: "#c77b3c",
});

const MARGIN_PX = 12;

/** @param {HTMLElement} host @returns {Panel} */
export function createSchematic(host) {
  const canvas = make("canvas", { "aria-hidden": "true" });
  host.append(canvas);
  const pen = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
  /** @type {World | null} */ let world = null;
  /** @type {World | null} */ let drawn = null;

  return {
    update(state) {
      world = state.world;
    },

    repaint() {
      drawn = null;
    },

    draw() {
      if (world === null || world === drawn || host.clientWidth === 0) return false;
      drawn = world;
      const ratio = devicePixelRatio || 1;
      const { clientWidth: width, clientHeight: height } = host;
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
      const palette = readPalette(document.documentElement);
      pen.setTransform(ratio, 0, 0, ratio, MARGIN_PX * ratio, MARGIN_PX * ratio);
      const across = (width - 2 * MARGIN_PX) / world.columns;
      const along = (height - 2 * MARGIN_PX) / world.rows;
      pen.fillStyle = palette.asphalt;
      pen.beginPath();
      pen.roundRect(-2, -2, across * world.columns + 4, along * world.rows + 4, 6);
      pen.fill();
      pen.fillStyle = palette.goal;
      pen.fillRect(0, 0, across * world.columns, Math.min(3, along));
      const side = Math.min(across, along) * 0.82;
      for (const { kind, cell: [column, row], disabled } of world.things.values()) {
        const size = kind === "av" ? side * 1.5 : side;
        pen.fillStyle = disabled ? "#8a8d93" : (COLOURS[kind] ?? palette.marking);
        pen.beginPath();
        pen.roundRect((column + 0.5) * across - size / 2, (row + 0.5) * along - size / 2, size, size, size * 0.3);
        pen.fill();
        if (kind !== "av") continue;
        pen.strokeStyle = "#ffffff";
        pen.lineWidth = 1.5;
        pen.stroke();
      }
      return false;
    },
  };
}
