// @ts-check
/** Addresses and saving of downloads (pictures, videos, recordings); reads a recording from a file. */

import { ask, askJson } from "../core/http.js";
import { sessionPath } from "../core/protocol.js";
import { decimalText, t } from "../core/texts.js";

/** @import { LongAnswer } from "../core/wire.js" */

/**
 * @typedef {object} VideoWish
 * @property {number} from
 * @property {number} to
 * @property {"gif" | "mp4"} format
 * @property {"road" | "schematic"} view
 * @property {number} side
 * @property {"light" | "dark"} theme  the colours of the road
 * @property {boolean} boxes  whether bounding boxes are drawn
 * @property {boolean} path  whether the way of the vehicle is
 * @property {boolean} forecast  whether movers' next cells are
 */

/** Frames a second, so that a longer stretch stays within what the service makes. */
const FRAMES = { most: 240, fastest: 12, slowest: 2 };

/**
 * Where a video is made.
 * @param {string} session
 * @param {VideoWish} wish
 * @param {number} stepS  seconds of a tick
 */
export function videoPath(session, { from, to, format, view, side, theme, boxes, path, forecast }, stepS) {
  const seconds = Math.max(stepS, (to - from) * stepS);
  const fps = Math.max(FRAMES.slowest, Math.min(FRAMES.fastest, Math.floor(FRAMES.most / seconds)));
  const query = new URLSearchParams({ from: `${from}`, to: `${to}`, format, fps: `${fps}`, view, side: `${side}`, theme, boxes: `${boxes}`, path: `${path}`, forecast: `${forecast}` });
  return `${sessionPath(session)}/film?${query}`;
}

/** @param {string} session */
export function recordingPath(session) {
  return `${sessionPath(session)}/recording`;
}

/**
 * The stretch around a tick, or the latest ones.
 * @param {number} now
 * @param {number | null} tick
 * @param {number} [ticks]
 */
export function stretch(now, tick, ticks = 20) {
  if (tick === null) return { from: Math.max(0, now - ticks), to: now };
  const from = Math.max(0, Math.min(tick - ticks / 2, now - ticks));
  return { from, to: Math.min(now, from + ticks) };
}

/**
 * A name for a file: what it is, of which session, when.
 * @param {string} session
 * @param {string} part
 * @param {string} ending
 */
export function fileName(session, part, ending) {
  return `roadtalk-${session.slice(0, 8)}-${part}.${ending}`;
}

/** How large a file is. @param {number} bytes */
export function sizeText(bytes) {
  if (bytes >= 1_000_000) return t("session.megabytes", { value: decimalText(bytes / 1_000_000, 1) });
  return t("session.kilobytes", { value: Math.max(1, Math.round(bytes / 1000)) });
}

/**
 * What an address answers, as a file's content. Throws `Refused`, or what an abort throws.
 * @param {string} path
 * @param {AbortSignal} [signal]
 * @param {typeof fetch} [http]
 */
export async function fetched(path, signal, http) {
  return (await ask(path, { signal, http })).blob();
}

/** How long a long answer is waited for before it is looked at again. */
const LOOK_MS = 500;

/**
 * What an address answers, where that may take long: the service makes it in the background, says how far it is, and is
 * told when nobody wants it any more. Throws `Refused`, or what an abort throws.
 * @param {string} path
 * @param {AbortSignal} signal
 * @param {(share: number) => void} progress
 * @param {{http?: typeof fetch, lookMs?: number}} [around]
 */
export async function fetchedLater(path, signal, progress, { http, lookMs = LOOK_MS } = {}) {
  const answer = await ask(path, { signal, http, headers: { prefer: "respond-async" } });
  if (answer.status !== 202) return answer.blob();
  /** @type {LongAnswer} */
  let told = await answer.json();
  const { self, result } = told.links;
  try {
    while (told.state === "running") {
      progress(told.progress);
      await pause(lookMs, signal);
      told = await askJson(self, { signal, http });
    }
    return await (await ask(result, { signal, http })).blob();
  } finally {
    ask(self, { method: "DELETE", http }).catch(() => null); // nobody fetches it twice
  }
}

/** @param {number} ms @param {AbortSignal} signal @returns {Promise<void>} */
function pause(ms, signal) {
  return new Promise((resolve, reject) => {
    if (signal.aborted) return void reject(signal.reason);
    const timer = setTimeout(resolve, ms);
    signal.addEventListener("abort", () => {
      clearTimeout(timer);
      reject(signal.reason);
    }, { once: true });
  });
}

/** Hand a file over to the browser. @param {Blob} data @param {string} name */
export function save(data, name) {
  const url = URL.createObjectURL(data);
  const link = document.createElement("a");
  link.href = url;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

/**
 * A recording out of a file's text. Throws an `Error` that says what it is instead.
 * @param {string} text
 * @param {string} name
 */
export function recordingIn(text, name) {
  let found;
  try {
    found = JSON.parse(text);
  } catch {
    throw new Error(t("session.no_json", { name }));
  }
  if (found?.format !== "roadtalk-recording") {
    throw new Error(t("session.no_format", { name }));
  }
  return found;
}
