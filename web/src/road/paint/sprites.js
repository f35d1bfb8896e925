// @ts-check
/**
 * Pictures painted once and stamped often.
 *
 * Painters draw in units of one cell around the origin; a sprite is that drawing in device pixels,
 * painted again only when the size of a cell or the colours change.
 */

/** @typedef {(pen: CanvasRenderingContext2D) => void} Painter */

export class Sprites {
  /** @type {Map<string, HTMLCanvasElement>} */ #kept = new Map();
  #pixelsPerCell = 0;

  /**
   * Forget everything when cells have another size.
   * @param {number} pixelsPerCell  device pixels
   */
  fit(pixelsPerCell) {
    if (pixelsPerCell === this.#pixelsPerCell) return;
    this.#pixelsPerCell = pixelsPerCell;
    this.clear();
  }

  clear() {
    this.#kept.clear();
  }

  /**
   * Stamp a drawing centred on the pen's origin, whose unit is one cell.
   * @param {CanvasRenderingContext2D} pen
   * @param {string} key  names the drawing
   * @param {number} cells  side of the square it needs
   * @param {Painter} paint
   */
  stamp(pen, key, cells, paint) {
    let sprite = this.#kept.get(key);
    if (!sprite) {
      sprite = document.createElement("canvas");
      sprite.width = sprite.height = Math.max(1, Math.ceil(cells * this.#pixelsPerCell));
      const brush = sprite.getContext("2d");
      if (brush) {
        brush.translate(sprite.width / 2, sprite.height / 2);
        brush.scale(this.#pixelsPerCell, this.#pixelsPerCell);
        paint(brush);
      }
      this.#kept.set(key, sprite);
    }
    pen.drawImage(sprite, -cells / 2, -cells / 2, cells, cells);
  }
}
