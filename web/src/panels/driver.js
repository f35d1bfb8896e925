// @ts-check
/** The planner, chosen from all there are by its name and a line about it; or the person at the page drives. */

import { hasText, t } from "../core/texts.js";
import { PLANNERS, plannerName } from "../core/words.js";
import { createMenu } from "../ui/menu.js";
import { driveAgain } from "./ending.js";

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

/** @param {string} name */
const chosenText = (name) => (name === PERSON ? t("driver.you") : t("driver.chosen", { name: nameOf(name) }));

/**
 * The picker, in an element of its own that stays while the figures around it are rendered anew.
 * @param {Page} page
 * @returns {{host: HTMLElement, update: (state: State) => void}}
 */
export function createPlannerPicker(page) {
  const host = document.createElement("div");
  host.id = "planner-menu";
  host.className = "menu planner";
  const relabel = createMenu(host, t("units.none"), () => plannerItems(page), t("driver.label"));
  return {
    host,
    update({ connection, past, world }) {
      relabel(world ? nameOf(driverOf(world)) : t("units.none"), connection.phase !== "live" || past !== null || world === null);
    },
  };
}

/** @param {Page} page */
function plannerItems(page) {
  const { world } = page.state();
  const driver = world && driverOf(world);
  // A planner of another package is in no table.
  const all = driver === null || DRIVERS.includes(driver) ? DRIVERS : [...DRIVERS, driver];
  const choices = all.map((name) => ({
    name: `planner-${name}`,
    label: nameOf(name),
    note: hasText(`planners_about.${name}`) ? t(`planners_about.${name}`) : "",
    checked: name === driver,
    choice: true,
    closes: true,
    run: () => chooseDriver(name, page),
  }));
  const compare = { name: "compare-planners", label: t("planner_race.open"), note: t("planner_race.about"), run: () => race(page) };
  return [...choices, null, compare];
}

/** Two planners on this road: the one that drives, and another. @param {Page} page @param {string} [other] */
function race(page, other) {
  const { world } = page.state();
  if (!world) return;
  const against = other ?? (world.planner === "astar" ? "rules" : "astar");
  page.pick({ kind: "planners", tick: null, planners: [world.planner, against] });
}

/** @returns {Command[]} */
function raceCommands() {
  const group = t("groups.driver");
  return [
    { name: "compare-planners", group, now: ({ world }) => world && { label: t("planner_race.open_long"), run: (page) => race(page) } },
    ...PLANNERS.map((name) => ({
      name: `compare-${name}`,
      group,
      now: (/** @type {State} */ { world }) =>
        world === null || world.planner === name ? null : { label: t("planner_race.with", { name: plannerName(name) }), run: (/** @type {Page} */ page) => race(page, name) },
    })),
  ];
}

/** The same from the palette. @returns {Command[]} */
export function driverCommands() {
  /** @type {Command[]} */
  const drivers = DRIVERS.map((name) => ({
    name: `driver-${name}`,
    group: t("groups.driver"),
    now: (state) => {
      const { past, world } = state;
      return world === null || past || driverOf(world) === name ? null : { label: chosenText(name), turns: [handedOver(name, state)] };
    },
  }));
  return [...drivers, ...raceCommands()];
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

/** The same, also where an episode has ended: there is nothing to drive but what was driven. @param {string} name @param {State} state @returns {Action[]} */
function handedOver(name, state) {
  const { world } = state;
  if (world === null) return [];
  return name === PERSON && world.status !== "running" ? driveAgain(state) : handOver(name, world);
}

/** @param {string} name @param {Page} page */
function chooseDriver(name, page) {
  page.act(handedOver(name, page.state()), chosenText(name), true);
}
