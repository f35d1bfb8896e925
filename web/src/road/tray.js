// @ts-check
/** The small tray over the road with what can be put on it, each as it looks there. */

import { html, nothing } from "../../vendor/lit-html.js";
import { t } from "../core/texts.js";
import { readPalette } from "../core/theme.js";
import { icon } from "../ui/icons.js";
import { createSlot } from "../ui/slot.js";
import { TOOLS } from "./edit.js";
import { cellPx } from "./hitTest.js";
import { Sprites } from "./paint/sprites.js";
import { drawThing } from "./paint/things.js";
import { nounOf } from "./placeTexts.js";

/** @import { Kind } from "../core/wire.js" */
/** @import { Places } from "./hitTest.js" */
/** @import { Thing } from "./world.js" */

/**
 * @param {HTMLElement} host  the road
 * @param {Places} places
 * @param {{grab: (kind: Kind, event: PointerEvent) => void, choose: (kind: Kind | null) => void}} hand
 */
export function createTray(host, places, { grab, choose }) {
  const show = createSlot(host);
  let open = false;
  /** @type {Kind | null} */ let chosen = null;
  /** The size of a cell for which the pictures were painted, in CSS pixels. */
  let painted = 0;
  /** @type {Record<string, HTMLCanvasElement>} */ let pictures = {};

  function update() {
    host.toggleAttribute("data-tray", open);
    show(
      html`<div class="tray">
        <button class="tray-open" type="button" aria-expanded=${String(open)} aria-controls="tray-tools" aria-label=${t("road.put_things")} @click=${toggle}>${icon("plus")}</button>
        <div class="tray-tools" id="tray-tools" role="group" aria-label=${t("road.put_on")}>${TOOLS.map(({ kind }) => tool(kind))}</div>
      </div>`,
    );
  }

  /** @param {Kind} kind */
  function tool(kind) {
    const name = nounOf({ kind });
    return html`<button
      class="tray-tool"
      type="button"
      data-kind=${kind}
      aria-pressed=${String(kind === chosen)}
      aria-label=${t("road.put_tool", { name })}
      title=${t("road.drag_tool", { name })}
      @click=${() => choose(kind === chosen ? null : kind)}
      @pointerdown=${(/** @type {PointerEvent} */ event) => take(kind, event)}
    >${pictures[kind] ?? nothing}</button>`;
  }

  /** @param {Kind} kind @param {PointerEvent} event */
  function take(kind, event) {
    if (event.button !== 0) return;
    /** @type {HTMLElement} */ (event.currentTarget).setPointerCapture(event.pointerId);
    grab(kind, event);
  }

  function toggle() {
    open = !open;
    update();
    if (open) draw();
    else choose(null);
  }

  /** Each as it looks on the road, of the size it has there. */
  function draw() {
    const size = cellPx(places);
    if (!open || size === painted || size === 0) return;
    painted = size;
    pictures = Object.fromEntries(TOOLS.map(({ kind }) => [kind, portrait(places, kind, `${kind}-0`)]));
    update();
  }

  update();
  return {
    draw,
    /** @param {Kind | null} kind */
    press(kind) {
      chosen = kind;
      update();
    },
    repaint() {
      painted = 0;
    },
  };
}

/**
 * A thing as it looks on the road, of the size it has there.
 * @param {Places} places
 * @param {Kind} kind
 * @param {string} id
 */
export function portrait(places, kind, id) {
  const ratio = Math.min(2, devicePixelRatio || 1);
  const size = Math.round((cellPx(places) || 40) * ratio);
  const canvas = Object.assign(document.createElement("canvas"), { className: "portrait", width: size, height: size });
  const pen = canvas.getContext("2d");
  if (pen === null) return canvas;
  const sprites = new Sprites();
  sprites.fit(size);
  pen.setTransform(size, 0, 0, size, size / 2, size / 2);
  const heading = kind === "vehicle" || kind === "pedestrian" ? "right" : null;
  const thing = /** @type {Thing} */ ({ id, kind, cell: [0, 0], heading, disabled: false });
  const scene = { pen, sprites, palette: readPalette(document.documentElement), progress: 1, now: 0 };
  drawThing(scene, { thing, column: 0, row: 0, facing: 0, scale: 1, alpha: 1, stride: 0 }, null);
  return canvas;
}
