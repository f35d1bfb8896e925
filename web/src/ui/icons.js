// @ts-check
/** The page's few icons, as SVG made here: nothing is fetched for them. */

import { html } from "../../vendor/lit-html.js";

const PATHS = /** @type {Record<string, string>} */ ({
  play: "M7 5.2v13.6L18.5 12z",
  pause: "M7 5h3.4v14H7zM13.6 5H17v14h-3.4z",
  step: "M6 5.2v13.6L14.5 12zM15.6 5H18v14h-2.4z",
  back: "M18 5.2v13.6L9.5 12zM8.4 5H6v14h2.4z",
  previous: "M14.6 5.6 8.2 12l6.4 6.4 1.4-1.4-5-5 5-5z",
  next: "M9.4 5.6 15.8 12l-6.4 6.4L8 17l5-5-5-5z",
  down: "M7.4 9 12 13.6 16.6 9 18 10.4l-6 6-6-6z",
  fork: "M7 4a2.5 2.5 0 0 1 1 4.8v1.4l4 2.3 4-2.3V8.8a2.5 2.5 0 1 1 2 0v2.6l-5 2.9v1a2.5 2.5 0 1 1-2 0v-1l-5-2.9V8.8A2.5 2.5 0 0 1 7 4z",
  rewind: "M11.5 6v12L4 12zM20 6v12l-7.5-6z",
  share: "M13 4h7v7h-2V7.4l-7.3 7.3-1.4-1.4L16.6 6H13zM5 6h5v2H6v10h10v-4h2v6H4V6z",
  undo: "M9.5 5 5 9.5 9.5 14v-3.2h4.2a3.6 3.6 0 0 1 0 7.2H8v2h5.7a5.6 5.6 0 0 0 0-11.2H9.5z",
  reset: "M12 5a7 7 0 1 0 7 7h-2a5 5 0 1 1-5-5v3l5-4-5-4z",
  send: "M12 4.5 5.5 11l1.4 1.4 4.1-4.1V19.5h2V8.3l4.1 4.1 1.4-1.4z",
  microphone: "M12 3.5a2.8 2.8 0 0 1 2.8 2.8v5a2.8 2.8 0 0 1-5.6 0v-5A2.8 2.8 0 0 1 12 3.5zM6 11h1.8a4.2 4.2 0 0 0 8.4 0H18a6 6 0 0 1-5.1 5.9v3.6h-1.8v-3.6A6 6 0 0 1 6 11z",
  grow: "M13 5h6v6h-2V8.4l-3.8 3.8-1.4-1.4L15.6 7H13zM11 19H5v-6h2v2.6l3.8-3.8 1.4 1.4L8.4 17H11z",
  shrink: "M12 12V6h2v2.6l4-4L19.4 6l-4 4H18v2zM12 12v6h-2v-2.6l-4 4L4.6 18l4-4H6v-2z",
  close: "M6.4 5 5 6.4 10.6 12 5 17.6 6.4 19 12 13.4 17.6 19 19 17.6 13.4 12 19 6.4 17.6 5 12 10.6z",
  minus: "M5 11h14v2H5z",
  plus: "M11 5h2v6h6v2h-6v6h-2v-6H5v-2h6z",
  wheel: "M12 4a8 8 0 1 0 0 16 8 8 0 0 0 0-16zm0 2a6 6 0 0 1 5.7 4.1L14.2 11a2.5 2.5 0 0 0-4.4 0l-3.5-.9A6 6 0 0 1 12 6zm-6 6.2 3.6.9A2.5 2.5 0 0 0 11 14.3v3.6a6 6 0 0 1-5-5.7zm7 5.7v-3.6a2.5 2.5 0 0 0 1.4-1.2l3.6-.9a6 6 0 0 1-5 5.7z",
  chart: "M5 19V5h2v12h12v2zM9 15v-4h2v4zM12.5 15V7h2v8zM16 15V9.5h2V15z",
  proof: "M10 16.6 5.4 12l1.5-1.5 3.1 3.1 7.1-7.1L18.6 8z",
});

/** An icon as a template. @param {string} name */
export function icon(name) {
  return html`<svg class="icon" viewBox="0 0 24 24" aria-hidden="true"><path d=${PATHS[name] ?? ""}></path></svg>`;
}
