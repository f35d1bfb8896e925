// @ts-check
/** The road as the page knows it: one table of things by id, made from a full state and kept up by ticks. */

import { hasText, listText, t } from "../core/texts.js";

/** @import { Kind, Rule } from "../core/wire.js" */
/** @import { WireState, TickMessage, Cell, Status, Metrics, Move } from "../core/protocol.js" */

/**
 * @typedef {object} Thing
 * @property {string} id
 * @property {Kind} kind  "av", "vehicle", "pedestrian", "pothole" or "barrier"
 * @property {Cell} cell
 * @property {"left" | "right" | null} heading  null for what does not move sideways
 * @property {boolean} disabled
 */

/**
 * @typedef {object} World
 * @property {number} tick
 * @property {number} timeS
 * @property {number} episode
 * @property {Status} status
 * @property {{ids: string[], cell: Cell | null} | null} cause  of a crash
 * @property {number} columns
 * @property {number} rows
 * @property {number} visibleRows
 * @property {number} stepS
 * @property {boolean} paused
 * @property {number | "max"} pace  how fast the clock plays
 * @property {string} mode
 * @property {string} planner
 * @property {string} sensor
 * @property {string} weather
 * @property {string} light  time of day
 * @property {Map<string, Thing>} things
 * @property {Metrics} metrics
 * @property {readonly Rule[]} rules  those that stand
 */

const CELL_M = 5;

/** @param {WireState} state @returns {World} */
export function worldOf(state) {
  const things = new Map();
  for (const thing of [...state.hazards, ...state.movers, ...state.vehicles]) {
    things.set(thing.id, { heading: null, disabled: false, ...thing });
  }
  return {
    tick: state.tick,
    timeS: state.time_s,
    episode: state.episode,
    status: state.status,
    cause: state.cause,
    columns: state.columns,
    rows: state.rows,
    visibleRows: state.visible_rows,
    stepS: state.step_seconds,
    paused: state.paused,
    pace: state.playback_speed ?? 1,
    mode: state.mode,
    planner: state.planner,
    sensor: state.sensor ?? "perfect",
    weather: state.weather ?? "clear",
    light: state.time_of_day ?? "day",
    things,
    metrics: state.metrics,
    rules: state.rules ?? [],
  };
}

/**
 * The world after one tick.
 * @param {World} world
 * @param {TickMessage} message
 * @returns {World}
 */
export function worldAfter(world, message) {
  if (message.state) return worldOf(message.state);
  const things = new Map(world.things);
  const change = (/** @type {string} */ id, /** @type {Partial<Thing>} */ part) => {
    const thing = things.get(id);
    if (thing) things.set(id, { ...thing, ...part });
  };
  for (const [id, cell] of Object.entries({ ...message.moved, ...message.vehicles })) change(id, { cell });
  for (const [id, heading] of Object.entries(message.turned ?? {})) change(id, { heading });
  let cause = message.status === "crash" ? world.cause : null;
  for (const event of message.events ?? []) {
    if (event.type === "disabled") for (const id of event.ids) change(id, { disabled: true });
    if (event.type === "crashed") cause = { ids: event.ids, cell: event.cell };
  }
  return {
    ...world,
    tick: message.tick,
    timeS: world.timeS + (message.tick - world.tick) * world.stepS,
    episode: message.episode,
    status: message.status,
    cause,
    things,
    metrics: message.metrics,
  };
}

/**
 * The first autonomous vehicle, when there is one.
 * @param {World} world
 * @returns {Thing | null}
 */
export function egoOf(world) {
  const first = world.things.get("av-1");
  if (first) return first;
  for (const thing of world.things.values()) if (thing.kind === "av") return thing;
  return null;
}

/**
 * How many things of each kind there are besides the vehicle, each as a text: "3 potholes".
 * @param {World} world
 * @returns {string[]}
 */
export function countTexts(world) {
  /** @type {Map<string, number>} */
  const counts = new Map();
  for (const { kind } of world.things.values()) if (kind !== "av") counts.set(kind, (counts.get(kind) ?? 0) + 1);
  return [...counts].map(([kind, count]) => (hasText(`counts.${kind}`) ? t(`counts.${kind}`, { count }) : `${count} ${kind}`));
}

/**
 * What is left to the destination edge.
 * @param {World} world
 * @returns {{rows: number, metres: number} | null}
 */
export function toGo(world) {
  const ego = egoOf(world);
  return ego && { rows: ego.cell[1], metres: ego.cell[1] * CELL_M };
}

/**
 * The speed a move amounts to, in km/h: one cell a tick is 36 km/h when a tick is half a second.
 * @param {World} world
 * @param {Move} move
 */
export function speedKmh(world, move) {
  const cells = move === "stay" ? 0 : move.startsWith("forward_") ? Math.SQRT2 : 1;
  return (cells * CELL_M * 3.6) / world.stepS;
}

/**
 * The road in a sentence or two, for those who do not see it.
 * @param {World} world
 */
export function describe(world) {
  const ego = egoOf(world);
  const things = listText(countTexts(world)) || t("road.nothing");
  const where = ego ? t("road.vehicle", { lane: ego.cell[0] + 1, count: ego.cell[1] }) : t("road.no_vehicle");
  return `${t("road.text", { columns: world.columns, rows: world.rows, things })} ${where}`;
}
