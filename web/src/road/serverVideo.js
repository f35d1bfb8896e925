// @ts-check
/**
 * The road as the service draws it, in place of the page's own drawing: the same tick, the same look.
 *
 * The pictures come over the stream for as long as they are wished for. Of an earlier tick there are none: the past
 * is drawn here.
 */

import { html } from "../../vendor/lit-html.js";
import { t } from "../core/texts.js";
import { themeSeen } from "../core/theme.js";
import { createSlot, find } from "../ui/slot.js";

/** @import { Page } from "../core/page.js" */
/** @import { Panel } from "../panels/index.js" */

const HEADER_BYTES = 16;
const FORMS = ["", "image/jpeg", "image/webp"];
const PATIENCE_MS = 15_000;
const FPS = 30;
const SIDES = { least: 160, most: 1_080, step: 40 };

/**
 * A picture with the tick it shows; null for what is none.
 * @param {ArrayBuffer} data
 * @returns {{tick: number, phase: number, picture: Blob} | null}
 */
export function pictureOf(data) {
  if (data.byteLength <= HEADER_BYTES) return null;
  const head = new DataView(data, 0, HEADER_BYTES);
  const form = FORMS[head.getUint8(3)];
  if (head.getUint16(0) !== 0x5254 || head.getUint8(2) !== 1 || !form) return null;
  return {
    tick: Number(head.getBigUint64(8)),
    phase: head.getFloat32(4),
    picture: new Blob([new Uint8Array(data, HEADER_BYTES)], { type: form }),
  };
}

/** @param {HTMLElement} host  of the road @param {Page} page @returns {Panel} */
export function createServerVideo(host, page) {
  createSlot(host, find(host, ".road-canvas").nextSibling)(html`<canvas class="service-canvas" hidden aria-hidden="true"></canvas>`);
  const canvas = /** @type {HTMLCanvasElement} */ (find(host, ".service-canvas"));
  const pen = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
  let wanted = 0;
  let come = false;
  let decoding = false;
  /** The colours that were asked for. */ let drawnIn = themeSeen();
  /** @type {any} */ let patience = null;

  page.onPicture(async (data) => {
    const told = wanted ? pictureOf(data) : null;
    if (!told || decoding) return; // a page that is too slow sees fewer, never old ones
    decoding = true;
    try {
      const bitmap = await createImageBitmap(told.picture);
      if (!wanted) return;
      clearTimeout(patience);
      come = true;
      if (canvas.width !== bitmap.width) canvas.width = canvas.height = bitmap.width;
      pen.drawImage(bitmap, 0, 0);
      bitmap.close();
      canvas.dataset.tick = String(told.tick);
      canvas.hidden = page.state().past !== null;
    } catch {
      if (wanted) giveUp(t("road.no_picture"));
    } finally {
      decoding = false;
    }
  });

  /** @param {string} why */
  function giveUp(why) {
    page.arrange({ service: false });
    page.tell({ text: t("road.drawn_here_again", { reason: why }), tone: "bad" });
  }

  /** As sharp as the room there is. */
  function side() {
    const room = Math.min(host.clientWidth, host.clientHeight) * Math.min(2, devicePixelRatio || 1);
    return Math.max(SIDES.least, Math.min(SIDES.most, Math.round(room / SIDES.step) * SIDES.step));
  }

  return {
    update(state, before) {
      const { views, connection, past, fault } = state;
      const live = connection.phase === "live";
      const want = views.service && views.road && live ? side() : 0;
      if (wanted && !come && fault !== null && fault !== before.fault) return giveUp(fault);
      const otherwise = connection !== before.connection || ["boxes", "path", "forecast"].some((name) => views[name] !== before.views[name]) || themeSeen() !== drawnIn;
      if (want !== wanted || (want && otherwise)) {
        drawnIn = themeSeen();
        clearTimeout(patience);
        wanted = want;
        come = false;
        if (want) {
          const { boxes, path, forecast } = views;
          page.send({ type: "subscribe", frames: "webp", view: "road", fps: FPS, side: want, theme: themeSeen(), boxes, figures: false, path, forecast });
          patience = setTimeout(() => giveUp(t("road.no_pictures")), PATIENCE_MS);
        } else if (live) page.send({ type: "unsubscribe" });
      }
      if (!views.service) delete canvas.dataset.tick;
      canvas.hidden = !views.service || past !== null || canvas.dataset.tick === undefined;
    },
  };
}
