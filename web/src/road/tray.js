// @ts-check
/** The small tray over the road with what can be put on it, each as it looks there. */

import { make } from "../ui/dom.js";
import { TOOLS } from "./edit.js";
import { icon } from "../ui/icons.js";
import { Sprites } from "./paint/sprites.js";
import { drawThing } from "./paint/things.js";
import { readPalette } from "../core/theme.js";

/** @import { Places } from "./hitTest.js" */
/** @import { Thing } from "./world.js" */

/**
 * @param {HTMLElement} host  the road
 * @param {Places} places
 * @param {{grab: (kind: string, event: PointerEvent) => void, choose: (kind: string | null) => void}} hand
 */
export function createTray(host, places, { grab, choose }) {
  const opener = make(
    "button",
    { class: "tray-open", type: "button", "aria-expanded": "false", "aria-controls": "tray-tools", "aria-label": "Put things on the road", onclick: open },
    icon("plus"),
  );
  const tools = TOOLS.map(({ kind, name }) => {
    const tool = make("button", {
      class: "tray-tool",
      type: "button",
      "data-kind": kind,
      "aria-pressed": "false",
      "aria-label": `${name}: drag it onto the road, or choose it and click there`,
      title: `${name}: drag it onto the road`,
      onclick: () => choose(tool.getAttribute("aria-pressed") === "true" ? null : kind),
    });
    tool.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      tool.setPointerCapture(event.pointerId);
      grab(kind, event);
    });
    return { kind, tool };
  });
  const list = make("div", { class: "tray-tools", id: "tray-tools", role: "group", "aria-label": "Put on the road" }, ...tools.map(({ tool }) => tool));
  host.append(make("div", { class: "tray" }, opener, list));
  let painted = 0;

  function open() {
    const on = host.toggleAttribute("data-tray");
    opener.setAttribute("aria-expanded", String(on));
    if (on) draw();
    else choose(null);
  }

  /** Each as it looks on the road, of the size it has there. */
  function draw() {
    const size = places.placeOf([0, 0])?.width ?? 0;
    if (size === painted || size === 0) return;
    painted = size;
    for (const { kind, tool } of tools) tool.replaceChildren(portrait(places, kind, `${kind}-0`));
  }

  return {
    draw,
    /** @param {string | null} kind */
    press(kind) {
      for (const each of tools) each.tool.setAttribute("aria-pressed", String(each.kind === kind));
    },
    repaint() {
      painted = 0;
    },
  };
}

/**
 * A thing as it looks on the road, of the size it has there.
 * @param {Places} places
 * @param {string} kind
 * @param {string} id
 */
export function portrait(places, kind, id) {
  const ratio = Math.min(2, devicePixelRatio || 1);
  const size = Math.round((places.placeOf([0, 0])?.width ?? 40) * ratio);
  const canvas = make("canvas", { class: "portrait", width: size, height: size });
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
