// @ts-check
/** The dialog in which a video of a stretch of ticks is asked for; fetched when it is first opened. */

import { html, live, nothing } from "../../vendor/lit-html.js";
import { errorText } from "../core/http.js";
import { decimalText, t } from "../core/texts.js";
import { themeSeen } from "../core/theme.js";
import { dialogSlot, makeDialog } from "../ui/dialog.js";
import { fetchedLater, fileName, save, sizeText, stretch, videoPath } from "./downloads.js";

/** @import { Page } from "../core/page.js" */
/** @import { VideoWish } from "./downloads.js" */

/**
 * @typedef {object} Shown
 * @property {VideoWish} wish
 * @property {number} now  the latest tick
 * @property {number} stepS  seconds of a tick
 * @property {{text: string, bad: boolean}} note
 * @property {boolean} busy
 * @property {number | null} share  of the video that is made, where that is known
 */

const CHOICES = {
  view: [["road", "video.road"], ["schematic", "video.schematic"]],
  format: [["gif", "GIF"], ["mp4", "MP4"]],
  side: [["320", "video.small"], ["480", "video.middle"], ["720", "video.large"]],
};

/** @param {Page} page @returns {() => void} opens it */
export function createVideoDialog(page) {
  const dialog = makeDialog(t("video.title"));
  const body = dialogSlot(dialog);
  /** @type {Shown} */
  let shown = { wish: { from: 0, to: 0, format: "gif", view: "road", side: 480, theme: themeSeen(), boxes: false, path: true, forecast: false }, now: 0, stepS: 0.5, note: { text: "", bad: false }, busy: false, share: null };
  /** @type {AbortController | null} */ let making = null;
  dialog.addEventListener("close", () => making?.abort());

  /** @param {Partial<Shown>} change */
  function show(change) {
    shown = { ...shown, ...change };
    body(form(shown, { choose, start: () => void start(), cancel: () => making?.abort() }));
  }

  /** @param {string} text */
  const tell = (text, bad = false) => show({ note: { text, bad } });

  /** @param {Partial<VideoWish>} part */
  function choose(part) {
    const wish = { ...shown.wish, ...part };
    show({ wish, note: { text: lengthText(wish, shown.stepS), bad: false } });
  }

  async function start() {
    const { session } = page.state();
    if (!session || making) return;
    const { wish, stepS } = shown;
    const own = (making = new AbortController());
    const began = performance.now();
    const drawing = () => tell(t("video.drawing", { count: wish.to - wish.from, seconds: Math.round((performance.now() - began) / 1000) }));
    drawing();
    const clock = setInterval(drawing, 1_000);
    show({ busy: true, share: null });
    try {
      const { boxes, path, forecast } = page.state().views;
      const address = videoPath(session, { ...wish, theme: themeSeen(), boxes, path, forecast }, stepS);
      const data = await fetchedLater(address, own.signal, (share) => show({ share }));
      save(data, fileName(session, `${wish.from}-${wish.to}`, wish.format));
      tell(t("video.saved", { size: sizeText(data.size) }));
    } catch (error) {
      if (own.signal.aborted) tell(t("video.cancelled"));
      else tell(errorText(error), true);
    } finally {
      clearInterval(clock);
      making = null;
      show({ busy: false });
    }
  }

  return () => {
    const { look, world } = page.state();
    const now = world?.tick ?? 0;
    show({ now, stepS: world?.stepS ?? 0.5 });
    choose(stretch(now, look.tick));
    dialog.showModal();
    /** @type {HTMLElement | null} */ (dialog.querySelector("[type=submit]"))?.focus();
  };
}

/** @param {VideoWish} wish @param {number} stepS */
function lengthText({ from, to }, stepS) {
  const count = to - from;
  return count > 0 ? t("video.length", { count, seconds: decimalText(count * stepS, 1) }) : "";
}

/**
 * @param {Shown} shown
 * @param {{choose: (part: Partial<VideoWish>) => void, start: () => void, cancel: () => void}} does
 */
function form({ wish, now, note, busy, share }, { choose, start, cancel }) {
  /** @param {SubmitEvent} event */
  const submit = (event) => {
    event.preventDefault();
    start();
  };
  const number = (/** @type {"from" | "to"} */ name) =>
    row(t(`video.${name}`), html`<input class="field" type="number" min="0" max=${now} required .value=${live(String(wish[name]))}
      @input=${(/** @type {Event} */ { target }) => choose({ [name]: /** @type {HTMLInputElement} */ (target).valueAsNumber })}>`);
  const select = (/** @type {"view" | "format" | "side"} */ name, /** @type {string} */ label) =>
    row(label, html`<select class="field" name=${name} @change=${(/** @type {Event} */ { target }) => choose(chosen(name, target))}>
      ${CHOICES[name].map(([value, key]) => html`<option value=${value} ?selected=${value === String(wish[name])}>${t(key)}</option>`)}
    </select>`);
  return html`<form class="form" @submit=${submit}>
    <div class="form-pair">${number("from")}${number("to")}</div>
    ${select("view", t("video.view"))}
    <div class="form-pair">${select("format", t("video.format"))}${select("side", t("video.size"))}</div>
    <p class="dialog-note" role="status" data-tone=${note.bad ? "bad" : "plain"}>${note.text}</p>
    ${busy ? html`<progress class="progress" aria-label=${t("video.making")} value=${share ?? nothing}></progress>` : nothing}
    <div class="form-end">
      ${busy ? html`<button class="button" type="button" @click=${cancel}>${t("video.cancel")}</button>` : nothing}
      <button class="button strong" type="submit" ?disabled=${busy}>${t("video.start")}</button>
    </div>
  </form>`;
}

/** @param {"view" | "format" | "side"} name @param {EventTarget | null} target @returns {Partial<VideoWish>} */
function chosen(name, target) {
  const { value } = /** @type {HTMLSelectElement} */ (target);
  return { [name]: name === "side" ? Number(value) : value };
}

/** @param {string} label @param {unknown} control */
function row(label, control) {
  return html`<label class="form-row"><span>${label}</span>${control}</label>`;
}
