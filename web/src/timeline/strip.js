// @ts-check
/** Under the timeline: risk, regret and clearance of the whole run; a press goes there, and so does one on a worst moment. */

import { html, nothing, render } from "../../vendor/lit-html.js";
import { decimalText, t } from "../core/texts.js";
import { readPalette } from "../core/theme.js";
import { fitCanvas } from "../ui/slot.js";
import { spanOf } from "./timelineEvents.js";
import { nowOf } from "./timelineState.js";
import { tickAt } from "./paint/line.js";
import { drawMeasure, MOST, ROW_HEIGHT, valueOf } from "./paint/strip.js";
import { StripData } from "./stripData.js";

/** @import { Page } from "../core/page.js" */
/** @import { Measure } from "./paint/strip.js" */
/** @import { RunJudgement } from "./stripData.js" */
/** @import { Panel } from "../panels/index.js" */

const MEASURES = /** @type {Measure[]} */ (["risk", "regret", "clearance"]);

/** @param {HTMLElement} host @param {Page} page @returns {Panel} */
export function createStrip(host, page) {
  let palette = readPalette(document.documentElement);
  let stale = true;
  const redraw = () => {
    stale = true;
    page.wake();
  };
  const data = new StripData(page, redraw);
  /** The timeline above, on whose axis of ticks this is drawn. */
  const line = /** @type {HTMLElement} */ (document.querySelector("#timeline .line"));

  /** @param {MouseEvent} event */
  function go({ clientX, currentTarget }) {
    const { left, width } = /** @type {HTMLElement} */ (currentTarget).getBoundingClientRect();
    const now = nowOf(page.state().timeline);
    void page.timeTravel.at(Math.max(0, Math.min(now, tickAt({ width, span: spanOf(now) }, clientX - left))));
  }

  function show() {
    const { look, timeline } = page.state();
    const now = nowOf(timeline);
    const at = look.tick ?? Math.max(0, now - 1);
    host.style.setProperty("--strip-start", `${line.offsetLeft}px`);
    host.style.setProperty("--strip-width", `${line.clientWidth}px`);
    render(
      html`${MEASURES.map((measure) => row(measure, data.items.get(at), go))}
        <ol class="strip-worst" aria-label=${t("strip.worst")}>
          ${worst(data, now, (tick) => void page.timeTravel.at(tick))}
        </ol>`,
      host,
    );
    const span = spanOf(now);
    for (const canvas of host.querySelectorAll("canvas")) {
      const width = canvas.clientWidth;
      const pen = fitCanvas(canvas, width, ROW_HEIGHT);
      drawMeasure(pen, { width, span, at: look.tick ?? now }, /** @type {Measure} */ (canvas.dataset.measure), data.items, palette);
    }
  }

  return {
    update(state) {
      host.hidden = !state.views.strip;
      if (host.hidden) return;
      data.follow(page.state());
      stale = true;
    },

    repaint() {
      palette = readPalette(document.documentElement);
      stale = true;
    },

    draw() {
      if (!stale || host.hidden) return false;
      stale = false;
      show();
      return false;
    },
  };
}

/** @param {Measure} measure @param {RunJudgement | null | undefined} item @param {(event: MouseEvent) => void} go */
function row(measure, item, go) {
  const value = valueOf(item, measure);
  const lost = measure === "regret" && item?.lost;
  const told = value === null || value === undefined ? t("units.none") : decimalText(value, value % 1 ? 1 : 0);
  const text = lost ? t("strip.lost") : `${told} ${t(`strip.${measure}_unit`)}`;
  return html`<div class="strip-row">
    <canvas class="strip-canvas" role="img" aria-label=${`${t(`strip.${measure}`)}, 0–${MOST[measure]}: ${text}`} data-measure=${measure} @click=${go}></canvas>
    <span class="strip-told"><b>${t(`strip.${measure}`)}</b>${text}</span>
  </div>`;
}

/** @param {StripData} data @param {number} now @param {(tick: number) => void} go */
function worst(data, now, go) {
  if (data.trouble !== null) return html`<li>${data.trouble}</li>`;
  const moments = data.worst();
  const more = data.next < now - 8 ? html`<li>${t("strip.loading", { from: data.next, now })}</li>` : nothing;
  if (moments.length === 0) return data.next < now - 8 ? more : html`<li>${t("strip.worst_none")}</li>`;
  return html`<li aria-hidden="true">${t("strip.worst")}</li>
    ${moments.map(({ tick, lost, ticks }) => {
      const text = lost ? t("strip.worst_lost", { tick }) : t("strip.worst_at", { tick, count: ticks ?? 0 });
      return html`<li><button class="button small" type="button" data-worst=${tick} @click=${() => go(tick)}>${text}</button></li>`;
    })}
    ${more}`;
}
