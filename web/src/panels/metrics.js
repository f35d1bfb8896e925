// @ts-check
/** How well it drives: results of the episodes, and along the run how tight it was and what was lost. */

import { html, render } from "../../vendor/lit-html.js";
import { words } from "../core/http.js";
import { decimalText, t } from "../core/texts.js";
import { readPalette } from "../core/theme.js";
import { percent } from "../core/words.js";
import { drawChart } from "../timeline/paint/chart.js";
import { find, fitCanvas } from "../ui/slot.js";
import { Book, WINDOW } from "../why/regret.js";

/** @import { Page } from "../main.js" */
/** @import { Metrics } from "../core/protocol.js" */
/** @import { State } from "../core/state.js" */
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
  const book = new Book();
  let palette = readPalette(document.documentElement);
  let stale = true;
  let failed = "";
  let pointed = -1;
  /** @type {State | null} */ let newest = null;

  function show() {
    if (newest) render(template({ state: newest, book, failed, pointed, point, look }), host);
    stale = true;
  }

  /** The tick under the pointer. @param {MouseEvent} event */
  function tickAt({ clientX, currentTarget }) {
    const { left, width } = /** @type {HTMLElement} */ (currentTarget).getBoundingClientRect();
    return (newest?.world?.tick ?? 0) - WINDOW + Math.floor(((clientX - left) / width) * WINDOW);
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
    if (book.items.get(tick)) void page.looking?.at(tick);
  }

  /** Ask for what is missing, as long as the panel is seen. @param {State} state */
  async function fill(state) {
    if (!state.world || !state.views.metrics || state.connection.phase !== "live" || document.hidden) return;
    const { world, past } = state;
    const age = book.age;
    try {
      if (!(await book.fill(world.tick, past === null && !world.paused && world.status === "running"))) return;
      failed = "";
    } catch (error) {
      failed = words(error);
    }
    show();
    page.wake();
    // What came meanwhile was not asked for, and what was told of a run that is no more is not kept.
    if (newest && (newest.world?.tick !== world.tick || book.age !== age)) void fill(newest);
  }

  return {
    update(state, before) {
      const { world, decision, session } = state;
      if (world === null || (world === before.world && state.views === before.views && state.connection === before.connection)) return;
      if (session !== book.session) {
        book.session = session;
        book.forget();
      } else if (state.past === null && before.past === null && before.world && rewritten(state, before)) book.forget();
      if (state.past === null && decision?.tick === world.tick - 1) book.note(decision.tick, decision.blocked?.length ?? null);
      newest = state;
      show();
      void fill(state);
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
        drawChart(fitCanvas(canvas, width, height), { width, height }, figure, newest.world.tick, (each) => book.items.get(each), palette);
      }
      return false;
    },
  };
}

/**
 * @param {object} shown
 * @param {State} shown.state
 * @param {Book} shown.book
 * @param {string} shown.failed  why nothing was answered, in words
 * @param {number} shown.pointed  the tick under the pointer
 * @param {(event: MouseEvent) => void} shown.point
 * @param {(event: MouseEvent) => void} shown.look
 */
function template({ state, book, failed, pointed, point, look }) {
  const world = /** @type {NonNullable<State["world"]>} */ (state.world);
  const { metrics } = world;
  const ends = t("metrics.ends", { ...metrics });
  // A lost connection is told once, at the top of the page; what was known stays.
  const values = { blocked: blockedText(book, world.tick), ticks: (state.connection.phase === "live" && failed) || lostText(book, world.tick) };
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
        <canvas class="chart-canvas" role="img" aria-label=${labels[figure]} title=${titleOf(book, pointed)} data-chart=${figure} @pointermove=${point} @click=${look}></canvas>
      </figure>`,
    )}`;
}

/** @param {Metrics} metrics */
function rateText({ success_rate, episodes, successes }) {
  return episodes ? t("metrics.rate_value", { percent: percent(success_rate), part: successes, whole: episodes }) : t("metrics.no_end");
}

/** @param {number} metres */
function distanceText(metres) {
  return metres < 1000 ? t("units.metres", { value: Math.round(metres) }) : t("units.kilometres", { value: decimalText(metres / 1000, 2) });
}

/** @param {Book} book @param {number} tick */
function blockedText(book, tick) {
  const latest = book.items.get(tick - 1);
  return latest ? t("metrics.blocked", { blocked: latest.blocked }) : t("units.none");
}

/** @param {Book} book @param {number} tick */
function lostText(book, tick) {
  const { ticks, known, lost } = book.sum(tick);
  if (known === 0) return t("units.none");
  return lost ? t("metrics.road_lost") : t("metrics.lost", { count: ticks, known });
}

/** What is known of a tick of the charts. @param {Book} book @param {number} tick */
function titleOf(book, tick) {
  const item = book.items.get(tick);
  if (!item) return "";
  const text = t("metrics.at_tick", { tick, blocked: item.blocked });
  if (item.ticks === undefined) return text;
  return item.lost ? t("metrics.at_tick_road_lost", { text }) : t("metrics.at_tick_lost", { text, count: item.ticks ?? 0 });
}

/**
 * Whether the run may have become another: time has gone back, or a change was made, taken back or made again.
 * @param {State} state
 * @param {State} before
 */
function rewritten({ world, prior, steps }, { world: old, steps: earlier }) {
  return !!world && !!old && prior === null && (world.tick < old.tick || steps !== earlier);
}
