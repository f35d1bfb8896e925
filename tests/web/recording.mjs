// A canvas, a palette and poses for tests of painters.

/** A canvas that writes down every call, with the colour in force, and knows no colours but the palette's. */
export function recording() {
  const drawn = [];
  const gradient = { addColorStop() {} };
  const plain = {
    globalAlpha: 1,
    getTransform: () => ({ a: 40 }),
    measureText: (text) => ({ width: 6 * text.length }),
    createLinearGradient: () => gradient,
    createRadialGradient: () => gradient,
  };
  const pen = new Proxy(plain, {
    get(target, name) {
      if (name in target || typeof name === "symbol") return target[name];
      return (...values) => void drawn.push({ what: name, values, fill: target.fillStyle, stroke: target.strokeStyle, alpha: target.globalAlpha });
    },
  });
  const count = (what) => drawn.filter((each) => each.what === what).length;
  return { pen, drawn, count };
}

export const KINDS = ["av", "vehicle", "pedestrian", "pothole", "barrier"];
const colours = (prefix) => Object.fromEntries(KINDS.map((kind) => [kind, `${prefix}-${kind}`]));
export const PALETTE = new Proxy({ kinds: colours("kind"), roadKinds: colours("road"), lamps: 0.5 }, { get: (target, name) => target[name] ?? String(name) });

export const pose = (kind, column, row, changes = {}) => ({ thing: { id: `${kind}-1`, kind, cell: [column, row] }, column, row, facing: 0, scale: 1, alpha: 1, stride: 0.5, ...changes });
