// @ts-check
/** How well it drives: results of the episodes, and along the run how tight it was and what was lost. */

import { make, setText } from "../ui/dom.js";
import { words } from "../core/http.js";
import { Book, WINDOW } from "../why/regret.js";
import { drawChart } from "../timeline/paint/chart.js";
import { readPalette } from "../core/theme.js";
import { counted, percent } from "../core/words.js";

/** @import { Page } from "../main.js" */
/** @import { Metrics } from "../core/protocol.js" */
/** @import { State } from "../core/state.js" */
/** @import { Figure } from "../timeline/paint/chart.js" */
/** @import { Panel } from "./index.js" */

/** @type {{name: string, label: string, value: (metrics: Metrics) => string}[]} */
const FIGURES = [
  { name: "rate", label: "Success", value: ({ success_rate, episodes, successes }) => (episodes ? `${percent(success_rate)} · ${successes} of ${episodes}` : "no end yet") },
  { name: "distance", label: "Driven", value: ({ distance_m }) => (distance_m < 1000 ? `${Math.round(distance_m)} m` : `${(distance_m / 1000).toFixed(2)} km`) },
  { name: "moves", label: "Ahead · aside · wait", value: ({ moves }) => `${moves.forward} · ${moves.lateral + moves.diagonal} · ${moves.stay}` },
];

const ENDS = /** @type {const} */ (["successes", "crashes", "stuck"]);

/** @param {HTMLElement} host @param {Page} page @returns {Panel} */
export function createMetrics(host, page) {
  const bar = make("div", { class: "ends", role: "img" }, ...ENDS.map((end) => make("span", { class: "end", "data-end": end })));
  const values = FIGURES.map(({ name, label }) => {
    const value = make("dd", { "data-metric": name }, "–");
    return { value, row: make("div", { class: "metric" }, make("dt", {}, label), value) };
  });
  const charts = /** @type {[Figure, string][]} */ ([["blocked", "Risk"], ["ticks", "Regret"]]).map(([figure, title]) => chart(figure, title));
  host.append(bar, make("dl", { class: "metric-rows" }, ...values.map(({ row }) => row)), ...charts.map(({ element }) => element));

  const book = new Book();
  let palette = readPalette(document.documentElement);
  let tick = 0;
  let stale = true;
  let failed = "";
  /** @type {State | null} */ let newest = null;

  /** @param {Figure} figure @param {string} title */
  function chart(figure, title) {
    const told = make("span", { class: "chart-told" });
    const canvas = make("canvas", { class: "chart-canvas", role: "img", "data-chart": figure });
    const pen = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
    /** @param {MouseEvent} event */
    const at = (event) => tick - WINDOW + Math.floor(((event.clientX - canvas.getBoundingClientRect().left) / canvas.clientWidth) * WINDOW);
    canvas.addEventListener("pointermove", (event) => (canvas.title = titleOf(at(event))));
    canvas.addEventListener("click", (event) => {
      if (book.items.get(at(event))) void page.looking?.at(at(event));
    });
    return { figure, canvas, pen, told, element: make("figure", { class: "chart" }, make("figcaption", {}, make("span", { class: "chart-title" }, title), told), canvas) };
  }

  /** @param {number} at */
  function titleOf(at) {
    const item = book.items.get(at);
    if (!item) return "";
    const lost = item.ticks === undefined ? "" : item.lost ? ", the road was lost" : `, ${counted(item.ticks ?? 0, "tick")} lost`;
    return `Tick ${at}: ${item.blocked} of 6 moves blocked${lost}`;
  }

  /** Ask for what is missing, as long as the panel is seen. @param {State} state */
  async function fill(state) {
    if (!state.views.metrics || state.connection.phase !== "live" || document.hidden) return;
    const [asked, age] = [tick, book.age];
    try {
      const running = state.past === null && state.world?.paused === false && state.world.status === "running";
      if (!(await book.fill(tick, running))) return;
      failed = "";
    } catch (error) {
      failed = words(error);
    }
    tell();
    stale = true;
    page.wake();
    // What came meanwhile was not asked for, and what was told of a run that is no more is not kept.
    if ((tick !== asked || book.age !== age) && newest) void fill(newest);
  }

  function tell() {
    const { ticks, known, lost } = book.sum(tick);
    const latest = book.items.get(tick - 1);
    const [risk, regret] = charts;
    setText(risk.told, latest ? `${latest.blocked} of 6 blocked` : "–");
    // A lost connection is told once, at the top of the page; what was known stays.
    const trouble = newest?.connection.phase === "live" ? failed : "";
    setText(regret.told, trouble || (known === 0 ? "–" : lost ? "the road was lost" : `${counted(ticks, "tick")} lost in ${known}`));
    risk.canvas.setAttribute("aria-label", `Moves blocked, of six, at each of the last ${WINDOW} ticks; at the latest ${risk.told.textContent}`);
    regret.canvas.setAttribute("aria-label", `Ticks lost against the best possible drive; ${regret.told.textContent}`);
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
      tick = world.tick;
      newest = state;
      stale = true;
      const { metrics } = world;
      FIGURES.forEach(({ value }, at) => setText(values[at].value, value(metrics)));
      ENDS.forEach((end, at) => (/** @type {HTMLElement} */ (bar.children[at]).style.flexGrow = String(metrics[end])));
      bar.hidden = metrics.episodes === 0;
      bar.setAttribute("aria-label", `${metrics.successes} arrived, ${metrics.crashes} crashed, ${metrics.stuck} stuck`);
      bar.title = bar.getAttribute("aria-label") ?? "";
      tell();
      void fill(state);
    },

    repaint() {
      palette = readPalette(document.documentElement);
      stale = true;
    },

    draw() {
      if (!stale || host.clientWidth === 0) return false;
      stale = false;
      const ratio = Math.min(2, devicePixelRatio || 1);
      for (const { figure, canvas, pen } of charts) {
        const [width, height] = [canvas.clientWidth, canvas.clientHeight];
        if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
          canvas.width = Math.round(width * ratio);
          canvas.height = Math.round(height * ratio);
        }
        pen.setTransform(ratio, 0, 0, ratio, 0, 0);
        drawChart(pen, { width, height }, figure, tick, (each) => book.items.get(each), palette);
      }
      return false;
    },
  };
}

/**
 * Whether the run may have become another: time has gone back, or a change was made, taken back or made again.
 * @param {State} state
 * @param {State} before
 */
function rewritten({ world, prior, steps }, { world: old, steps: earlier }) {
  return !!world && !!old && prior === null && (world.tick < old.tick || steps !== earlier);
}
