// @ts-check
/** The page's few icons, as SVG made here: nothing is fetched for them. */

const PATHS = /** @type {Record<string, string>} */ ({
  play: "M7 5.2v13.6L18.5 12z",
  pause: "M7 5h3.4v14H7zM13.6 5H17v14h-3.4z",
  step: "M6 5.2v13.6L14.5 12zM15.6 5H18v14h-2.4z",
  undo: "M9.5 5 5 9.5 9.5 14v-3.2h4.2a3.6 3.6 0 0 1 0 7.2H8v2h5.7a5.6 5.6 0 0 0 0-11.2H9.5z",
  reset: "M12 5a7 7 0 1 0 7 7h-2a5 5 0 1 1-5-5v3l5-4-5-4z",
  send: "M12 4.5 5.5 11l1.4 1.4 4.1-4.1V19.5h2V8.3l4.1 4.1 1.4-1.4z",
  microphone: "M12 3.5a2.8 2.8 0 0 1 2.8 2.8v5a2.8 2.8 0 0 1-5.6 0v-5A2.8 2.8 0 0 1 12 3.5zM6 11h1.8a4.2 4.2 0 0 0 8.4 0H18a6 6 0 0 1-5.1 5.9v3.6h-1.8v-3.6A6 6 0 0 1 6 11z",
  proof: "M10 16.6 5.4 12l1.5-1.5 3.1 3.1 7.1-7.1L18.6 8z",
});

const SVG = "http://www.w3.org/2000/svg";

/** @param {string} name @returns {SVGSVGElement} */
export function icon(name) {
  const picture = document.createElementNS(SVG, "svg");
  picture.setAttribute("viewBox", "0 0 24 24");
  picture.setAttribute("aria-hidden", "true");
  picture.classList.add("icon");
  const path = document.createElementNS(SVG, "path");
  path.setAttribute("d", PATHS[name] ?? "");
  picture.append(path);
  return picture;
}
