// @ts-check
/** The instruments: figures of the drive and of the session so far, and the planner. */

import { html, render } from "../../vendor/lit-html.js";
import { t } from "../core/texts.js";
import { clock, percent } from "../core/words.js";
import { speedKmh, toGo } from "../road/world.js";
import { createPlannerPicker, driverCommands } from "./driver.js";

/** @import { Page } from "../core/page.js" */
/** @import { State } from "../core/state.js" */
/** @import { World } from "../road/world.js" */
/** @import { Panel } from "./index.js" */

/** @type {{key: string, label: string, value: (world: World, state: State) => string, note?: (world: World) => string}[]} */
const FIGURES = [
  {
    key: "to-go",
    label: t("status.to_go"),
    value: (world) => metres(toGo(world)?.metres),
    note: (world) => rows(toGo(world)?.rows),
  },
  {
    key: "speed",
    label: t("status.speed"),
    value: (world, state) => t("units.speed", { value: Math.round(speedNow(world, state)) }),
  },
  { key: "tick", label: t("status.tick"), value: (world) => String(world.tick), note: (world) => clock(world.timeS) },
  { key: "episode", label: t("status.episode"), value: (world) => String(world.episode) },
  {
    key: "success",
    label: t("status.success"),
    value: ({ metrics }) => percent(metrics.success_rate),
    note: ({ metrics }) => (metrics.episodes === 0 ? "" : t("status.share", { part: metrics.successes, whole: metrics.episodes })),
  },
];

/** @param {HTMLElement} host  a definition list @param {Page} page @returns {Panel} */
export function createStatus(host, page) {
  const planner = createPlannerPicker(page);
  return {
    commands: driverCommands(),

    update(state) {
      planner.update(state);
      render(
        html`${FIGURES.map((figure) => figureRow(figure, state))}
          <div class="figure" data-figure="driver"><dt>${t("driver.label")}</dt><dd>${planner.host}</dd></div>`,
        host,
      );
    },
  };
}

/** @param {typeof FIGURES[number]} figure @param {State} state */
function figureRow({ key, label, value, note }, state) {
  const { world } = state;
  return html`<div class="figure" data-figure=${key}>
    <dt>${label}</dt>
    <dd><span class="figure-value">${world ? value(world, state) : t("units.none")}</span><span class="figure-note">${(world && note?.(world)) ?? ""}</span></dd>
  </div>`;
}

/** @param {number | undefined} value */
function metres(value) {
  return value === undefined ? t("units.none") : t("units.metres", { value });
}

/** @param {number | undefined} count */
function rows(count) {
  return count === undefined ? "" : t("units.rows", { count });
}

/** @param {World} world @param {State} state */
function speedNow(world, state) {
  if (world.paused || world.status !== "running" || state.decision === null) return 0;
  return speedKmh(world, state.decision.move);
}
