// @ts-check
/** What the reader prefers, and the canvas's colours, which live in `style/tokens.css` like all others. */

import { prefer } from "./preferences.js";

/** @type {Set<() => void>} */
const calls = new Set();

/**
 * @typedef {object} Palette  CSS colours
 * @property {string} sky
 * @property {string} haze  at the horizon
 * @property {string} verge
 * @property {string} vergeDeep
 * @property {string} asphalt
 * @property {string} asphaltDeep
 * @property {string} grain
 * @property {string} marking
 * @property {string} edge
 * @property {string} ink
 * @property {string} accent
 * @property {string} danger
 * @property {string} goal
 * @property {string} shadow
 * @property {string} crack
 * @property {string} hole
 * @property {string} cause
 * @property {string} next  what is about to be done
 * @property {string} surface
 * @property {string} cell  of a plain grid
 * @property {string} grid  its lines
 * @property {string} text
 * @property {string} faint
 * @property {string} good
 * @property {string} focus
 * @property {Record<string, string>} kinds  of things, by kind, for signs
 * @property {Record<string, string>} roadKinds  the same on asphalt
 * @property {Record<string, string>} veils  over the road, by weather and time of day; `drops` of rain and snow
 * @property {number} lamps  how much lamps shine, 0–1
 */

const COLOURS = {
  sky: "--road-sky",
  haze: "--road-haze",
  verge: "--road-verge",
  vergeDeep: "--road-verge-deep",
  asphalt: "--road-asphalt",
  asphaltDeep: "--road-asphalt-deep",
  grain: "--road-grain",
  marking: "--road-marking",
  edge: "--road-edge",
  ink: "--road-ink",
  accent: "--road-accent",
  danger: "--danger",
  goal: "--goal",
  shadow: "--road-shadow",
  crack: "--road-crack",
  hole: "--road-hole",
  cause: "--road-cause",
  next: "--road-next",
  surface: "--surface",
  cell: "--cell",
  grid: "--line",
  text: "--ink",
  faint: "--ink-3",
  good: "--good",
  focus: "--accent",
};

const VEILS = ["rain", "fog", "snow", "dusk", "dawn", "night", "drops"];
const KINDS = ["av", "vehicle", "pedestrian", "pothole", "barrier"];

/**
 * The palette in force.
 * @param {Element} root
 * @returns {Palette}
 */
export function readPalette(root) {
  const style = getComputedStyle(root);
  const read = (/** @type {string} */ name) => style.getPropertyValue(name).trim();
  const colours = Object.fromEntries(Object.entries(COLOURS).map(([key, name]) => [key, read(name)]));
  const [kinds, roadKinds] = ["--kind-", "--road-kind-"].map((prefix) =>
    Object.fromEntries(KINDS.map((kind) => [kind, read(prefix + kind)])),
  );
  const veils = Object.fromEntries(VEILS.map((name) => [name, read(`--road-veil-${name}`)]));
  return /** @type {Palette} */ ({ ...colours, kinds, roadKinds, veils, lamps: Number(read("--road-lamps")) });
}

/**
 * Whether the reader asked for little motion, now.
 * @returns {boolean}
 */
export function wantsStillness() {
  return matchMedia("(prefers-reduced-motion: reduce)").matches;
}

/** @typedef {"" | "light" | "dark"} Theme  chosen; empty for the system's */

/** @returns {Theme} */
export function theme() {
  const chosen = document.documentElement.dataset.theme;
  return chosen === "light" || chosen === "dark" ? chosen : "";
}

/** Choose one, now and for later visits (`early.js`). @param {string} chosen */
export function chooseTheme(chosen) {
  prefer("theme", chosen);
  document.documentElement.dataset.theme = chosen;
  const dark = darkStyle();
  if (dark) dark.media = { light: "not all", dark: "all" }[chosen] ?? "(prefers-color-scheme: dark)";
  for (const call of calls) call();
}

/**
 * Calls back when colours or motion are preferred otherwise.
 * @param {() => void} changed
 */
export function watchPreferences(changed) {
  for (const query of ["(prefers-color-scheme: dark)", "(prefers-reduced-motion: reduce)", "(prefers-contrast: more)"]) {
    matchMedia(query).addEventListener("change", changed);
  }
  // What the system does not want is fetched last, and may come after it was chosen.
  darkStyle()?.addEventListener("load", changed);
  calls.add(changed);
}

function darkStyle() {
  return /** @type {HTMLLinkElement | null} */ (document.getElementById("dark"));
}

/** The colours that are seen: those chosen, else the system's. @returns {"light" | "dark"} */
export function themeSeen() {
  return theme() || (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
}
