// @ts-check
/** How well it drives: results of the episodes, and along the run how tight it was and what was lost. */

import { html, nothing, render } from "../../vendor/lit-html.js";
import { decimalText, t } from "../core/texts.js";
import { readPalette } from "../core/theme.js";
import { percent } from "../core/words.js";
import { chartTick, drawChart } from "../timeline/paint/chart.js";
import { find, fitCanvas } from "../ui/slot.js";
import { sumOf, WINDOW, worstMoments } from "../why/regret.js";

/** @import { Page } from "../core/page.js" */
/** @import { Metrics } from "../core/protocol.js" */
/** @import { State } from "../core/state.js" */
/** @import { Regret } from "../why/regret.js" */
/** @import { Figure } from "../timeline/paint/chart.js" */
/** @import { Panel } from "./index.js" */

/** @type {{name: string, value: (metrics: Metrics) => string}[]} */
const FIGURES = [
  { name: "rate", value: rateText },
  { name: "distance", value: ({ distance_m }) => distanceText(distance_m) },
  { name: "moves", value: ({ moves }) => `${moves.forward} · ${moves.lateral + moves.diagonal} · ${moves.stay}` },
];
const ENDS = /** @type {const} */ (["successes", "crashes", "stuck"]);
const CHARTS = /** @type {Figure[]} */ (["blocked", "ticks"]);

/** @param {HTMLElement} host @param {Page} page @returns {Panel} */
export function createMetrics(host, page) {
  let palette = readPalette(document.documentElement);
  let stale = true;
  let pointed = -1;
  /** @type {State | null} */ let newest = null;

  function show() {
    if (newest) render(template({ state: newest, pointed, point, look, go: (tick) => void page.timeTravel.at(tick) }), host);
    stale = true;
  }

  /** The tick under the pointer. @param {MouseEvent} event */
  function tickAt({ clientX, currentTarget }) {
    const { left, width, height } = /** @type {HTMLElement} */ (currentTarget).getBoundingClientRect();
    return chartTick({ width, height }, clientX - left, newest?.world?.tick ?? 0);
  }

  /** @param {MouseEvent} event */
  function point(event) {
    const next = tickAt(event);
    if (next === pointed) return;
    pointed = next;
    show();
  }

  /** @param {MouseEvent} event */
  function look(event) {
    const tick = tickAt(event);
    if (newest?.regret.items.get(tick)) void page.timeTravel.at(tick);
  }

  new ResizeObserver(() => {
    stale = true;
    page.wake();
  }).observe(host);

  return {
    update(state, before) {
      const same = state.world === before.world && state.regret === before.regret && state.connection === before.connection;
      if (state.world === null || same) return;
      newest = state;
      show();
    },

    repaint() {
      palette = readPalette(document.documentElement);
      stale = true;
    },

    draw() {
      if (!stale || !newest?.world || host.clientWidth === 0) return false;
      stale = false;
      for (const figure of CHARTS) {
        const canvas = /** @type {HTMLCanvasElement} */ (find(host, `[data-chart=${figure}]`));
        const { clientWidth: width, clientHeight: height } = canvas;
        drawChart(fitCanvas(canvas, width, height), { width, height }, figure, newest.world.tick, (each) => newest?.regret.items.get(each), palette);
      }
      return false;
    },
  };
}

/**
 * @param {object} shown
 * @param {State} shown.state
 * @param {number} shown.pointed  the tick under the pointer
 * @param {(event: MouseEvent) => void} shown.point
 * @param {(event: MouseEvent) => void} shown.look
 * @param {(tick: number) => void} shown.go
 */
function template({ state, pointed, point, look, go }) {
  const world = /** @type {NonNullable<State["world"]>} */ (state.world);
  const { metrics } = world;
  const { regret } = state;
  const ends = t("metrics.ends", { ...metrics });
  // A lost connection is told once, at the top of the page; what was known stays.
  const values = { blocked: blockedText(regret, state.past ? world.tick : world.tick - 1), ticks: (state.connection.phase === "live" && regret.trouble) || lostText(regret, world.tick) };
  const titles = { blocked: t("metrics.risk"), ticks: t("metrics.regret") };
  const labels = {
    blocked: t("metrics.risk_label", { window: WINDOW, value: values.blocked }),
    ticks: t("metrics.regret_label", { value: values.ticks }),
  };
  return html`<div class="ends" role="img" aria-label=${ends} title=${ends} ?hidden=${metrics.episodes === 0}>
      ${ENDS.map((end) => html`<span class="end" data-end=${end} .style=${`flex-grow: ${metrics[end]}`}></span>`)}
    </div>
    <dl class="metric-rows">
      ${FIGURES.map(({ name, value }) => html`<div class="metric"><dt>${t(`metrics.${name}`)}</dt><dd data-metric=${name}>${value(metrics)}</dd></div>`)}
    </dl>
    ${CHARTS.map(
      (figure) => html`<figure class="chart">
        <figcaption><span class="chart-title">${titles[figure]}</span><span class="chart-told">${values[figure]}</span></figcaption>
        <canvas class="chart-canvas" role="img" aria-label=${labels[figure]} title=${titleOf(regret, pointed)} data-chart=${figure} @pointermove=${point} @click=${look}></canvas>
      </figure>`,
    )}
    ${worst(regret, go)}`;
}

/** The worst moments, as chess sites list blunders; a press goes there. @param {Regret} regret @param {(tick: number) => void} go */
function worst(regret, go) {
  const moments = worstMoments(regret);
  if (moments.length === 0) return nothing;
  return html`<div class="worst">
    <h3 class="chart-title">${t("metrics.worst")}</h3>
    <ol>
      ${moments.map(({ tick }) => html`<li><button class="worst-moment" type="button" data-worst=${tick} @click=${() => go(tick)}>${titleOf(regret, tick)}</button></li>`)}
    </ol>
  </div>`;
}

/** @param {Metrics} metrics */
function rateText({ success_rate, episodes, successes }) {
  return episodes ? t("metrics.rate_value", { percent: percent(success_rate), part: successes, whole: episodes }) : t("metrics.no_end");
}

/** @param {number} metres */
function distanceText(metres) {
  return metres < 1000 ? t("units.metres", { value: Math.round(metres) }) : t("units.kilometres", { value: decimalText(metres / 1000, 2) });
}

/** @param {Regret} regret @param {number} tick  of the decision: the latest, or that of the tick that is looked at */
function blockedText(regret, tick) {
  const latest = regret.items.get(tick);
  return latest ? t("metrics.blocked", { blocked: latest.blocked }) : t("units.none");
}

/** @param {Regret} regret @param {number} tick */
function lostText(regret, tick) {
  const { ticks, known, lost } = sumOf(regret, tick);
  if (known === 0) return t("units.none");
  return lost ? t("metrics.road_lost") : t("metrics.lost", { count: ticks, known });
}

/** What is known of a tick of the charts. @param {Regret} regret @param {number} tick */
function titleOf(regret, tick) {
  const item = regret.items.get(tick);
  if (!item) return "";
  const text = t("metrics.at_tick", { tick, blocked: item.blocked });
  if (item.ticks === undefined) return text;
  return item.lost ? t("metrics.at_tick_road_lost", { text }) : t("metrics.at_tick_lost", { text, count: item.ticks ?? 0 });
}
