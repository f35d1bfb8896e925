// @ts-check
/** The instruments: figures of the drive and of the session so far. */

import { make, setText } from "../ui/dom.js";
import { clock, counted, percent } from "../core/words.js";
import { speedKmh, toGo } from "../road/world.js";

/** @import { State } from "../core/state.js" */
/** @import { World } from "../road/world.js" */
/** @import { Panel } from "./index.js" */

/** @type {{key: string, label: string, value: (world: World, state: State) => string, note?: (world: World) => string}[]} */
const FIGURES = [
  {
    key: "to-go",
    label: "To go",
    value: (world) => metres(toGo(world)?.metres),
    note: (world) => rows(toGo(world)?.rows),
  },
  {
    key: "speed",
    label: "Speed",
    value: (world, state) => `${Math.round(speedNow(world, state))} km/h`,
  },
  { key: "tick", label: "Tick", value: (world) => String(world.tick), note: (world) => clock(world.timeS) },
  { key: "episode", label: "Episode", value: (world) => String(world.episode) },
  {
    key: "success",
    label: "Success",
    value: ({ metrics }) => percent(metrics.success_rate),
    note: ({ metrics }) => (metrics.episodes === 0 ? "" : `${metrics.successes} of ${metrics.episodes}`),
  },
];

/** @param {HTMLElement} host  a definition list @returns {Panel} */
export function createStatus(host) {
  const cells = FIGURES.map(({ key, label }) => {
    const value = make("span", { class: "figure-value" }, "–");
    const note = make("span", { class: "figure-note" });
    const row = make("div", { class: "figure", "data-figure": key });
    row.append(make("dt", {}, label), make("dd", {}, value, note));
    host.append(row);
    return { value, note };
  });

  return {
    update(state, before) {
      const { world } = state;
      if (world === null || (world === before.world && state.decision === before.decision)) return;
      FIGURES.forEach(({ value, note }, at) => {
        setText(cells[at].value, value(world, state));
        setText(cells[at].note, note?.(world) ?? "");
      });
    },
  };
}

/** @param {number | undefined} value */
function metres(value) {
  return value === undefined ? "–" : `${value} m`;
}

/** @param {number | undefined} count */
function rows(count) {
  return count === undefined ? "" : counted(count, "row");
}

/** @param {World} world @param {State} state */
function speedNow(world, state) {
  if (world.paused || world.status !== "running" || state.decision === null) return 0;
  return speedKmh(world, state.decision.move);
}
