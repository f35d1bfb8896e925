// @ts-check
/** One thing of any kind in its pose: which painter, which sprite, which shadow. */

import { paintBarrier, paintPothole } from "./hazards.js";
import { drawSignal, paintWarning } from "./signals.js";
import { lookOf, paintBeams, paintEgo, paintVehicle, paintVehicleShadow } from "./vehicle.js";
import { drawPedestrian, paintWalkerShadow } from "./pedestrian.js";

/** @import { Pose } from "../motion.js" */
/** @import { Move } from "../../core/protocol.js" */
/** @import { Palette } from "../../core/theme.js" */
/** @import { Sprites } from "./sprites.js" */

/**
 * @typedef {object} Scene  what painters work with; the pen's unit is one cell
 * @property {CanvasRenderingContext2D} pen
 * @property {Sprites} sprites
 * @property {Palette} palette
 * @property {number} progress  of the present step, 0–1
 * @property {number} now  ms
 */

/** Which way shadows fall, in cells. */
const SHADOW = { x: 0.025, y: 0.035 };
const SPRITE_CELLS = 1;
const BEAM_CELLS = 3;
/** Which way the autonomous vehicle points, always. */
const UP = -Math.PI / 2;

/** @param {{kind: string}} thing */
export function isFixed({ kind }) {
  return kind === "pothole" || kind === "barrier";
}

/**
 * @param {Scene} scene
 * @param {Pose} pose
 * @param {Move | null} move  the autonomous vehicle's present move, shown by its lamps
 */
export function drawThing(scene, pose, move) {
  const { pen } = scene;
  pen.save();
  pen.translate(pose.column, pose.row);
  pen.scale(pose.scale, pose.scale);
  pen.globalAlpha = pose.alpha;
  (PAINTERS[pose.thing.kind] ?? drawUnknown)(scene, pose, move);
  pen.restore();
}

/**
 * The light a vehicle throws on the road, to be drawn before all that stands on it.
 * @param {Scene} scene
 * @param {Pose} pose
 */
export function drawLight({ pen, sprites, palette }, { thing, column, row, facing, scale, alpha }) {
  const own = thing.kind === "av";
  if (palette.lamps === 0 || thing.disabled || !(own || thing.kind === "vehicle")) return;
  pen.save();
  pen.translate(column, row);
  pen.scale(scale, scale);
  pen.globalAlpha = alpha;
  pen.rotate(own ? UP : facing < Math.PI / 2 ? 0 : Math.PI);
  sprites.stamp(pen, "beams", BEAM_CELLS, (brush) => paintBeams(brush, palette.lamps));
  pen.restore();
}

/** @type {Record<string, (scene: Scene, pose: Pose, move: Move | null) => void>} */
const PAINTERS = {
  pothole({ pen, sprites, palette }, { thing }) {
    sprites.stamp(pen, thing.id, SPRITE_CELLS, (brush) => paintPothole(brush, thing.id, palette));
  },

  barrier({ pen, sprites, palette }, { thing }) {
    sprites.stamp(pen, thing.id, SPRITE_CELLS, (brush) => paintBarrier(brush, thing.id, palette));
  },

  vehicle({ pen, sprites, palette }, { thing, facing }) {
    const look = lookOf(thing.id, thing.disabled);
    shadowed(pen, 0, () => sprites.stamp(pen, "shadow vehicle", SPRITE_CELLS, (brush) => paintVehicleShadow(brush, palette)));
    // Front and rear change places without the body leaving its box, as it would if it swung round.
    const turned = facing / Math.PI;
    const { globalAlpha } = pen;
    for (const [angle, share] of [[0, turned < 1 ? 1 : 0], [Math.PI, turned]]) {
      if (share === 0) continue;
      pen.save();
      pen.rotate(angle);
      pen.globalAlpha = globalAlpha * share;
      sprites.stamp(pen, look.key, SPRITE_CELLS, (brush) => paintVehicle(brush, look));
      pen.restore();
    }
    if (thing.disabled) sprites.stamp(pen, "warning", SPRITE_CELLS, paintWarning);
  },

  pedestrian({ pen, sprites, palette }, { thing, facing, stride }) {
    shadowed(pen, facing, () =>
      sprites.stamp(pen, "shadow walker", SPRITE_CELLS, (brush) => paintWalkerShadow(brush, palette)),
    );
    pen.save();
    pen.rotate(facing);
    drawPedestrian(pen, thing.id, stride, thing.disabled);
    pen.restore();
  },

  av({ pen, sprites, palette, progress }, _, move) {
    shadowed(pen, UP, () => sprites.stamp(pen, "shadow vehicle", SPRITE_CELLS, (brush) => paintVehicleShadow(brush, palette)));
    pen.rotate(UP);
    sprites.stamp(pen, "ego", SPRITE_CELLS, paintEgo);
    if (move === "stay") drawSignal(pen, "brake");
    else if (move && move !== "forward" && blinks(progress)) drawSignal(pen, move.endsWith("left") ? "left" : "right");
  },
};

/** Two blinks a step. @param {number} progress */
export function blinks(progress) {
  return progress < 1 && (progress * 4) % 2 < 1.2;
}

/** @param {CanvasRenderingContext2D} pen @param {number} facing @param {() => void} stamp */
function shadowed(pen, facing, stamp) {
  pen.save();
  pen.translate(SHADOW.x, SHADOW.y);
  pen.rotate(facing);
  stamp();
  pen.restore();
}

/** A kind this page does not know yet is still seen. @param {Scene} scene */
function drawUnknown({ pen, palette }) {
  pen.strokeStyle = palette.danger;
  pen.lineWidth = 0.06;
  pen.strokeRect(-0.3, -0.3, 0.6, 0.6);
}
