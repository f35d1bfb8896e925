// @ts-check
/**
 * A run as a line: a band with its waits and detours, symbols of events above it, figures beneath it.
 *
 * Many ticks may share a pixel: a bar then tells by its strength how many of them it stands for, and of
 * events that share a place the most important is drawn. In CSS pixels; no state, no network.
 */

/** @import { Kind, TimelineEvent } from "../timelineState.js" */

/**
 * @typedef {object} Line
 * @property {number} width
 * @property {number} span  ticks that fill the width
 * @property {number} now
 * @property {number | null} at  the tick looked at
 * @property {number | null} over  the tick pointed at
 * @property {TimelineEvent[]} events  by tick
 */

/**
 * @typedef {object} Inks  CSS colours
 * @property {string} band
 * @property {string} ahead
 * @property {string} text
 * @property {string} ink
 * @property {string} surface
 * @property {string} accent
 * @property {string} danger
 * @property {string} warn
 * @property {string} good
 */

export const HEIGHT = 46;
const EDGE = 7;
const EVENTS_Y = 9;
const BAND = { top: 18, height: 12 };
const FIGURES_Y = 43;
const SYMBOL = 11;
/** What has a symbol, the most important first. @type {Kind[]} */
const SHOWN = ["crash", "stuck", "fork", "command", "success"];

/** Where a tick is. @param {{width: number, span: number}} line @param {number} tick */
export function xOf({ width, span }, tick) {
  return EDGE + (tick / span) * (width - 2 * EDGE);
}

/** Which tick is at a place. @param {{width: number, span: number}} line @param {number} x */
export function tickAt({ width, span }, x) {
  return Math.round(((x - EDGE) / (width - 2 * EDGE)) * span);
}

/** @param {CanvasRenderingContext2D} pen @param {Line} line @param {Inks} inks */
export function drawLine(pen, line, inks) {
  pen.clearRect(0, 0, line.width, HEIGHT);
  drawBand(pen, line, inks);
  drawSpans(pen, line, inks);
  drawFigures(pen, line, inks);
  drawEvents(pen, line, inks);
  if (line.over !== null) {
    pen.fillStyle = inks.text;
    pen.fillRect(Math.round(xOf(line, line.over)), BAND.top - 3, 1, BAND.height + 6);
  }
  drawHead(pen, line, inks);
}

/** @param {CanvasRenderingContext2D} pen @param {Line} line @param {Inks} inks */
function drawBand(pen, line, inks) {
  const end = xOf(line, line.now);
  const right = xOf(line, line.span);
  pen.fillStyle = inks.ahead;
  pen.fillRect(end, BAND.top + BAND.height / 2 - 0.5, right - end, 1);
  pen.fillStyle = inks.band;
  pen.beginPath();
  pen.roundRect(EDGE, BAND.top, Math.max(2, end - EDGE), BAND.height, 3);
  pen.fill();
  pen.fillStyle = inks.surface;
  let last = -Infinity;
  for (const { kind, tick } of line.events) {
    const x = Math.round(xOf(line, tick));
    if (kind !== "episode" || tick === 0 || x - last < 4) continue;
    pen.fillRect(x - 1, BAND.top, 2, BAND.height);
    last = x;
  }
}

/** Waits as high bars, detours as low ones, near misses as dots. @param {CanvasRenderingContext2D} pen @param {Line} line @param {Inks} inks */
function drawSpans(pen, line, inks) {
  const scale = (line.width - 2 * EDGE) / line.span;
  for (const { kind, tick, ticks = 1 } of line.events) {
    if (kind !== "wait" && kind !== "detour") continue;
    const tall = kind === "wait";
    pen.fillStyle = tall ? inks.warn : inks.accent;
    pen.globalAlpha = Math.max(0.3, Math.min(1, scale * ticks));
    const height = tall ? BAND.height : BAND.height / 2;
    pen.fillRect(xOf(line, tick), BAND.top + BAND.height - height, Math.max(1, ticks * scale - (scale > 3 ? 1 : 0)), height);
  }
  pen.globalAlpha = Math.max(0.35, Math.min(1, scale * 2));
  pen.fillStyle = inks.danger;
  let last = -Infinity;
  for (const { kind, tick } of line.events) {
    const x = xOf(line, tick);
    if (kind !== "near_miss" || x - last < 3) continue;
    pen.beginPath();
    pen.arc(x, BAND.top + 2.5, 1.5, 0, 2 * Math.PI);
    pen.fill();
    last = x;
  }
  pen.globalAlpha = 1;
}

/** @param {CanvasRenderingContext2D} pen @param {Line} line @param {Inks} inks */
function drawFigures(pen, line, inks) {
  const least = (line.span * 64) / line.width;
  const step = [10, 20, 25, 50, 100, 200, 250, 500, 1_000, 2_000, 5_000, 10_000, 20_000, 50_000, 100_000].find((each) => each >= least) ?? least;
  pen.fillStyle = inks.text;
  pen.font = "10px system-ui, sans-serif";
  for (let tick = 0; tick <= line.span; tick += step) {
    const x = xOf(line, tick);
    const told = tick.toLocaleString("en");
    pen.textAlign = tick === 0 ? "left" : x > line.width - 16 ? "right" : "center";
    pen.fillText(told, tick === 0 ? EDGE : Math.min(x, line.width - 2), FIGURES_Y);
  }
}

/** @param {CanvasRenderingContext2D} pen @param {Line} line @param {Inks} inks */
function drawEvents(pen, line, inks) {
  const placed = /** @type {number[]} */ ([]);
  for (const sort of SHOWN) {
    // Where all went well again and again, a few ticks say so; what stands alone is always seen.
    const room = sort === "success" ? SYMBOL * 2.5 : SYMBOL;
    for (const { kind, tick } of line.events) {
      const x = xOf(line, tick);
      if (kind !== sort || placed.some((there) => Math.abs(there - x) < room)) continue;
      placed.push(x);
      drawAt(pen, x, line, () => symbol(pen, kind, inks));
    }
  }
}

/** @param {CanvasRenderingContext2D} pen @param {number} x @param {Line} line @param {() => void} draw */
function drawAt(pen, x, line, draw) {
  pen.save();
  pen.translate(Math.max(EDGE, Math.min(line.width - EDGE, x)), EVENTS_Y);
  draw();
  pen.restore();
}

/**
 * Told apart by shape as well as by colour.
 * @param {CanvasRenderingContext2D} pen
 * @param {Kind} kind
 * @param {Inks} inks
 */
export function symbol(pen, kind, inks) {
  pen.lineWidth = 2;
  pen.lineCap = "round";
  pen.lineJoin = "round";
  pen.beginPath();
  pen.strokeStyle = pen.fillStyle = { crash: inks.danger, stuck: inks.danger, success: inks.good, near_miss: inks.danger, wait: inks.warn }[String(kind)] ?? inks.accent;
  if (kind === "crash") {
    pen.moveTo(-3.5, -3.5);
    pen.lineTo(3.5, 3.5);
    pen.moveTo(3.5, -3.5);
    pen.lineTo(-3.5, 3.5);
    pen.stroke();
  } else if (kind === "stuck") {
    pen.rect(-3.5, -3.5, 7, 7);
    pen.fill();
  } else if (kind === "success") {
    pen.moveTo(-4, 0.5);
    pen.lineTo(-1, 3.5);
    pen.lineTo(4, -3);
    pen.stroke();
  } else if (kind === "fork") {
    pen.moveTo(-3, -4);
    pen.lineTo(0, 0);
    pen.lineTo(3, -4);
    pen.moveTo(0, 0);
    pen.lineTo(0, 4);
    pen.stroke();
  } else if (kind === "command") {
    pen.moveTo(0, -4.2);
    pen.lineTo(4.2, 0);
    pen.lineTo(0, 4.2);
    pen.lineTo(-4.2, 0);
    pen.fill();
  } else {
    pen.arc(0, 0, 2, 0, 2 * Math.PI);
    pen.fill();
  }
}

/** @param {CanvasRenderingContext2D} pen @param {Line} line @param {Inks} inks */
function drawHead(pen, line, inks) {
  const looking = line.at !== null;
  const x = xOf(line, line.at ?? line.now);
  pen.fillStyle = looking ? inks.accent : inks.ink;
  pen.fillRect(x - 1, BAND.top - 4, 2, BAND.height + 8);
  pen.beginPath();
  pen.arc(x, BAND.top + BAND.height / 2, looking ? 7 : 5, 0, 2 * Math.PI);
  pen.fill();
  pen.beginPath();
  pen.fillStyle = inks.surface;
  pen.arc(x, BAND.top + BAND.height / 2, looking ? 3 : 2, 0, 2 * Math.PI);
  pen.fill();
}
