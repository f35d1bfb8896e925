// @ts-check
/** Who drives: the planner, chosen from all there are, or the person at the page. */

import { html, live } from "../../vendor/lit-html.js";
import { t } from "../core/texts.js";
import { PLANNERS, plannerName } from "../core/words.js";

/** @import { Command } from "../core/commands.js" */
/** @import { Page } from "../core/page.js" */
/** @import { Action } from "../core/protocol.js" */
/** @import { State } from "../core/state.js" */
/** @import { World } from "../road/world.js" */

/** A person, as planners are named on the wire. */
const PERSON = "manual";
const DRIVERS = [...PLANNERS, PERSON];

/** @param {World} world */
const driverOf = (world) => (world.mode === PERSON ? PERSON : world.planner);

/** @param {string} name */
const nameOf = (name) => (name === PERSON ? t("driver.person") : plannerName(name));

/** The choice of the driver. @param {State} state @param {Page} page */
export function driverChoice({ connection, past, world }, page) {
  const driver = world && driverOf(world);
  // A planner of another package is in no table.
  const all = driver === null || DRIVERS.includes(driver) ? DRIVERS : [...DRIVERS, driver];
  const off = connection.phase !== "live" || past !== null || world === null;
  const choose = (/** @type {{target: HTMLSelectElement}} */ { target }) => chooseDriver(target.value, page);
  return html`<select class="figure-value driver" aria-label=${t("driver.label")} title=${t("driver.title")} ?disabled=${off} @change=${choose}>
    ${all.map((name) => html`<option value=${name} .selected=${live(name === driver)}>${nameOf(name)}</option>`)}
  </select>`;
}

/** The same from the palette. @returns {Command[]} */
export function driverCommands() {
  return DRIVERS.map((name) => ({
    name: `driver-${name}`,
    group: t("groups.driver"),
    now: ({ past, world }) =>
      world === null || past || driverOf(world) === name ? null : { label: t("driver.chosen", { name: nameOf(name) }), turns: [handOver(name, world)] },
  }));
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
function chooseDriver(name, page) {
  const { world } = page.state();
  if (world) page.act(handOver(name, world), t("driver.chosen", { name: nameOf(name) }), true);
}
