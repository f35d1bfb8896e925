// @ts-check
/** Places in an element that several parts share: each part renders into its own slot and leaves the others alone. */

import { render } from "../../vendor/lit-html.js";

/**
 * A slot in an element: what is rendered becomes children of the element, before a node of it or at its end.
 * @param {HTMLElement} host
 * @param {ChildNode | null} [before]
 * @returns {(content: unknown) => void}  renders into the slot
 */
export function createSlot(host, before = null) {
  const end = host.insertBefore(document.createComment(""), before);
  return (content) => void render(content, host, { renderBefore: end });
}

/**
 * The element a template has rendered, which is known to be there.
 * @template {HTMLElement} [Found=HTMLElement]
 * @param {ParentNode} host
 * @param {string} selector
 * @returns {Found}
 */
export function find(host, selector) {
  const found = host.querySelector(selector);
  if (found === null) throw new Error(`nothing matches ${selector}`);
  return /** @type {Found} */ (found);
}

/**
 * A canvas that fills an element, as sharp as the screen, in CSS pixels from here on. Sets its size where that differs.
 * @param {HTMLCanvasElement} canvas
 * @param {number} width
 * @param {number} height
 * @returns {CanvasRenderingContext2D}
 */
export function fitCanvas(canvas, width, height) {
  const ratio = Math.min(2, devicePixelRatio || 1);
  const [across, down] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== across || canvas.height !== down) Object.assign(canvas, { width: across, height: down });
  const pen = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  return pen;
}
