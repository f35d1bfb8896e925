// @ts-check
/** The road of a quiz's question, drawn as the page draws roads, from the signs of the service's notation. */

import { readPalette } from "../core/theme.js";
import { Sprites } from "../road/paint/sprites.js";
import { drawThing, isFixed } from "../road/paint/things.js";

/** @import { Kind } from "../core/wire.js" */
/** @import { Thing } from "../road/world.js" */

const CELL_PX = 38;
/** Kind and heading by sign; what is disabled looks as it does otherwise. @type {Record<string, [Kind, "left" | "right" | null, boolean?]>} */
const SIGNS = {
  A: ["av", null], o: ["pothole", null], "#": ["barrier", null],
  ">": ["vehicle", "right"], "<": ["vehicle", "left"], "}": ["vehicle", "right", true], "{": ["vehicle", "left", true],
  ")": ["pedestrian", "right"], "(": ["pedestrian", "left"], "]": ["pedestrian", "right", true], "[": ["pedestrian", "left", true],
};

/** What stands where. @param {string[]} rows @returns {Thing[]} */
export function thingsIn(rows) {
  return rows.flatMap((row, down) =>
    [...row].flatMap((sign, across) => {
      const found = SIGNS[sign];
      if (!found) return [];
      const [kind, heading, disabled = false] = found;
      return [{ id: `${kind}-${down}${across}`, kind, cell: /** @type {[number, number]} */ ([across, down]), heading, disabled }];
    }),
  );
}

/** @param {string[]} rows @param {string} label @returns {HTMLCanvasElement} */
export function quizRoad(rows, label) {
  const ratio = Math.min(2, devicePixelRatio || 1);
  const [columns, cell] = [rows[0]?.length ?? 0, CELL_PX * ratio];
  const canvas = Object.assign(document.createElement("canvas"), { className: "quiz-road", width: columns * cell, height: rows.length * cell });
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", label);
  canvas.style.inlineSize = `${columns * CELL_PX}px`;
  const pen = canvas.getContext("2d");
  if (pen === null) return canvas;
  const palette = readPalette(document.documentElement);
  const sprites = new Sprites();
  sprites.fit(cell);
  pen.setTransform(cell, 0, 0, cell, cell / 2, cell / 2);
  pen.fillStyle = palette.asphalt;
  pen.fillRect(-0.5, -0.5, columns, rows.length);
  pen.strokeStyle = palette.marking;
  pen.globalAlpha = 0.45;
  pen.lineWidth = 0.02;
  pen.beginPath();
  for (let lane = 1; lane < columns; lane += 1) {
    pen.moveTo(lane - 0.5, -0.5);
    pen.lineTo(lane - 0.5, rows.length - 0.5);
  }
  for (let row = 1; row < rows.length; row += 1) {
    pen.moveTo(-0.5, row - 0.5);
    pen.lineTo(columns - 0.5, row - 0.5);
  }
  pen.stroke();
  pen.globalAlpha = 1;
  const scene = { pen, sprites, palette, progress: 1, now: 0 };
  const things = thingsIn(rows);
  for (const fixed of [true, false]) {
    for (const thing of things) {
      if (isFixed(thing) !== fixed) continue;
      const facing = thing.heading === "left" ? Math.PI : 0;
      drawThing(scene, { thing, column: thing.cell[0], row: thing.cell[1], facing, scale: 1, alpha: 1, stride: 0 }, null);
    }
  }
  return canvas;
}
