// @ts-check
/** The whole run under the road: where it waited, turned aside, crashed, was changed; dragged or walked with keys. */

import { html, nothing, render } from "../../vendor/lit-html.js";
import { t } from "../core/texts.js";
import { clock } from "../core/words.js";
import { byId } from "../ui/dom.js";
import { icon } from "../ui/icons.js";
import { find, fitCanvas } from "../ui/slot.js";
import { createJumps } from "./jumps.js";
import { drawLine, HEIGHT, xOf } from "./paint/line.js";
import { byImportance, eventsIn, eventsNear, eventText, spanOf } from "./timelineEvents.js";
import { sliderInput, watchWheel } from "./timelineInput.js";
import { allEvents, nowOf } from "./timelineState.js";

/** @import { Page } from "../core/page.js" */
/** @import { Inks } from "./paint/line.js" */
/** @import { Timeline } from "./timelineState.js" */
/** @import { Panel } from "../panels/index.js" */

/** How near a finger or a pointer comes to what it means. */
const NEAR_PX = 5;
const MOST_TOLD = 4;

/** @param {HTMLElement} host @param {Page} page @returns {Panel} */
export function createTimeline(host, page) {
  /** @type {Inks | null} colours, as long as nothing but the run changes */ let inks = null;
  /** @type {number | null} the tick pointed at */ let over = null;
  let stale = true;
  let width = 0;
  const jumps = createJumps(page);
  const line = () => ({ width, span: spanOf(nowOf(page.state().timeline)) });
  const redraw = () => {
    stale = true;
    page.wake();
  };
  const input = sliderInput(page, line, (tick) => {
    over = tick;
    redraw();
  });

  /** @param {number | null} shown  the tick that is told of */
  function show(shown) {
    const { timeline, world } = page.state();
    const tip = shown === null ? nothing : tipOf(shown, world?.stepS ?? 0.5, near(timeline, shown, line()));
    render(frame(input, redraw, jumps.buttons(), tip, timeline.trouble, stripButton(page)), host);
    const box = /** @type {HTMLElement | null} */ (host.querySelector(".line-tip"));
    if (shown === null || box === null) return;
    box.style.insetInlineStart = `${Math.max(0, Math.min(width - box.offsetWidth, xOf(line(), shown) - box.offsetWidth / 2))}px`;
  }
  show(null);
  const slider = find(host, ".line");
  const canvas = /** @type {HTMLCanvasElement} */ (find(host, "canvas"));
  watchWheel(page, slider);
  watchWheel(page, byId("road"), () => page.state().large === "road");

  return {
    commands: jumps.commands,

    update() {
      stale = true;
    },

    repaint() {
      inks = null;
      stale = true;
    },

    draw() {
      if (!stale) return false;
      stale = false;
      if (inks === null) {
        width = slider.clientWidth;
        inks = readInks(host);
      }
      const { look, timeline } = page.state();
      const events = allEvents(timeline);
      drawLine(fitCanvas(canvas, width, HEIGHT), { ...line(), now: nowOf(timeline), at: look.tick, over, events }, inks);
      tellSlider(slider, timeline, look.tick);
      show(over ?? (look.tick !== null && slider.matches(":focus-visible") ? look.tick : null));
      return false;
    },
  };
}

/** What shows and hides the strip under the timeline. @param {Page} page */
function stripButton(page) {
  const on = page.state().views.strip;
  const label = t(on ? "views.hide" : "views.show", { name: t("views.the.strip") });
  return { on, label, press: () => page.arrange({ strip: !page.state().views.strip }) };
}

/**
 * @param {ReturnType<typeof sliderInput>} input
 * @param {() => void} redraw
 * @param {unknown} buttons
 * @param {unknown} tip
 * @param {string | null} trouble
 * @param {ReturnType<typeof stripButton>} strip
 */
function frame(input, redraw, buttons, tip, trouble, strip) {
  return html`<div class="line" role="slider" tabindex="0" aria-label=${t("timeline.label")} aria-valuemin="0" aria-valuenow="0" aria-valuemax="0"
      @pointerdown=${input.down} @pointermove=${input.move} @pointerup=${input.up} @pointercancel=${input.up} @pointerleave=${input.leave}
      @keydown=${input.key} @focus=${redraw} @blur=${redraw}>
      <canvas class="line-canvas"></canvas>
      ${tip}
    </div>
    ${buttons}
    <button class="button icon small" type="button" data-strip aria-pressed=${String(strip.on)} aria-label=${strip.label} title=${strip.label} @click=${strip.press}>${icon("chart")}</button>
    ${trouble === null ? nothing : html`<span class="line-note">${t("timeline.trouble", { reason: trouble })}</span>`}`;
}

/** What is near a tick where ticks are narrower than a finger. @param {Timeline} timeline @param {number} tick @param {{width: number, span: number}} line */
function near(timeline, tick, { width, span }) {
  return eventsNear(allEvents(timeline), tick, Math.floor((NEAR_PX / Math.max(1, width)) * span));
}

/** @param {number} tick @param {number} stepS @param {string[]} events */
function tipOf(tick, stepS, events) {
  return html`<div class="line-tip" aria-hidden="true">
    <b>${t("timeline.tick", { tick })}</b><span class="line-tip-time">${clock(tick * stepS)}</span>
    ${events.slice(0, MOST_TOLD).map((event) => html`<span class="line-tip-mark">${event}</span>`)}
  </div>`;
}

/**
 * The slider's value, for those who hear it. While it runs, the one who has the focus there is not told each tick.
 * @param {HTMLElement} slider
 * @param {Timeline} timeline
 * @param {number | null} looked
 */
function tellSlider(slider, timeline, looked) {
  const now = nowOf(timeline);
  const live = looked === null;
  const quiet = live && document.activeElement === slider && slider.dataset.live === "yes";
  slider.dataset.live = live ? "yes" : "no";
  if (quiet) return;
  const tick = looked ?? now;
  const here = live ? [] : byImportance(eventsIn(allEvents(timeline), tick, tick)).map(eventText);
  const text = live ? t("timeline.live") : [t("timeline.at", { tick, now }), ...here].join(", ");
  for (const [name, value] of Object.entries({ max: now, now: tick, text })) slider.setAttribute(`aria-value${name}`, String(value));
}

/** @param {Element} host @returns {Inks} */
function readInks(host) {
  const style = getComputedStyle(host);
  const read = (/** @type {string} */ name) => style.getPropertyValue(`--${name}`).trim();
  return {
    band: read("time-band"), ahead: read("line"), text: read("ink-3"), ink: read("ink"), surface: read("surface"),
    accent: read("accent"), danger: read("danger"), warn: read("time-wait"), good: read("good"),
  };
}
