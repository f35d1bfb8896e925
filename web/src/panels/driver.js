// @ts-check
/** Who drives: the planner, chosen from all there are, or the person at the page. */

import { make } from "../ui/dom.js";
import { PLANNERS, plannerName } from "../core/words.js";

/** @import { Act } from "../core/commands.js" */
/** @import { Page } from "../main.js" */
/** @import { Action } from "../core/protocol.js" */
/** @import { World } from "../road/world.js" */
/** @import { Panel } from "./index.js" */

/** A person, as planners are named on the wire. */
const PERSON = "manual";

/** @param {World} world */
const driverOf = (world) => (world.mode === PERSON ? PERSON : world.planner);

/** @param {string} name */
const nameOf = (name) => (name === PERSON ? "You" : plannerName(name));

/**
 * @param {HTMLElement} host  a definition list
 * @param {Page} page
 * @returns {Panel}
 */
export function createDriver(host, page) {
  const choice = make("select", { class: "figure-value driver", "aria-label": "Driver", title: "Who drives", onchange: () => choose(choice.value, page) });
  choice.append(...[...Object.keys(PLANNERS), PERSON].map(optionOf));
  const row = make("div", { class: "figure", "data-figure": "driver" });
  row.append(make("dt", {}, "Driver"), make("dd", {}, choice));
  host.append(row);

  return {
    acts: [...Object.keys(PLANNERS), PERSON].map(actOf),

    update({ connection, past, world }) {
      choice.disabled = connection.phase !== "live" || past !== null || world === null;
      if (world === null) return;
      const driver = driverOf(world);
      if (choice.value === driver) return;
      // A planner of another package is in no table.
      if (![...choice.options].some(({ value }) => value === driver)) choice.append(optionOf(driver));
      choice.value = driver;
    },
  };
}

/** @param {string} name */
function optionOf(name) {
  return make("option", { value: name }, nameOf(name));
}

/**
 * What makes somebody the driver: a planner that is chosen while a person drives takes the wheel as well.
 * @param {string} name
 * @param {World} world
 * @returns {Action[]}
 */
export function handOver(name, world) {
  if (name === PERSON) return [{ do: "mode", mode: PERSON }];
  /** @type {Action[]} */
  const actions = world.planner === name ? [] : [{ do: "set", parameter: "planner", value: name }];
  return world.mode === PERSON ? [...actions, { do: "mode", mode: "auto" }] : actions;
}

/** @param {string} name @param {Page} page */
function choose(name, page) {
  const { world } = page.state();
  if (world) page.act(handOver(name, world), `Driver: ${nameOf(name)}`, true);
}

/** @param {string} name @returns {Act} */
function actOf(name) {
  return {
    name: `driver-${name}`,
    group: "Driver",
    now: ({ past, world }) => (world === null || past || driverOf(world) === name ? null : { label: `Driver: ${nameOf(name)}`, turns: [handOver(name, world)] }),
  };
}
