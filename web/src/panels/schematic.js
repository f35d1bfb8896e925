// @ts-check
/** The whole road at a glance: one small square a cell, and the part in view. */

import { make } from "../dom.js";
import { readPalette } from "../theme.js";

/** @typedef {import("../world.js").World} World */

const COLOURS = /** @type {Record<string, string>} */ ({
  av: "#2f6fed",
  vehicle: "#d5534a",
  pedestrian: "#3f9d77",
  pothole: "#d9a520",
  barrier: "#c77b3c",
});

/**
 * @param {HTMLElement} host
 * @returns {import("./index.js").Panel}
 */
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
      const cell = Math.min(width / world.columns, height / world.rows);
      const left = (width - cell * world.columns) / 2;
      const top = (height - cell * world.rows) / 2;
      pen.setTransform(ratio, 0, 0, ratio, left * ratio, top * ratio);
      pen.fillStyle = palette.asphalt;
      pen.beginPath();
      pen.roundRect(0, 0, cell * world.columns, cell * world.rows, 4);
      pen.fill();
      pen.fillStyle = palette.goal;
      pen.fillRect(0, 0, cell * world.columns, cell * 0.5);
      for (const { kind, cell: [column, row], disabled } of world.things.values()) {
        pen.fillStyle = disabled ? "#8a8d93" : (COLOURS[kind] ?? palette.marking);
        pen.beginPath();
        const gap = kind === "av" ? 0 : cell * 0.12;
        pen.roundRect(column * cell + gap, row * cell + gap, cell - 2 * gap, cell - 2 * gap, cell * 0.25);
        pen.fill();
      }
      return false;
    },
  };
}
