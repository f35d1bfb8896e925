// @ts-check
/** Roads worth looking at: what each is made from, and its first rows in the signs of the service's notation. */

/**
 * @typedef {object} Scenario
 * @property {string} name  its texts are `gallery.names`, `gallery.about` and `gallery.why`
 * @property {number} seed
 * @property {Record<string, unknown>} config
 * @property {string[]} rows
 */

/** @type {Scenario[]} */
export const SCENARIOS = [
  {
    name: "crossing",
    seed: 2,
    config: { layout: "crossing" },
    rows: [".<<..>>.", "><..>..>", "........", ">.<..>..", ">>>>...<", "><.>.<>.", "><..<.>>", ".>....<.", "........", "<..<<.<>", "<.<><.>.", "....A..."],
  },
  {
    name: "rush_hour",
    seed: 8,
    config: { vehicles: 40, potholes: 4 },
    rows: ["......<.", "...>....", "..>.....", "......>.", ".>......", ">.>.....", ".>...>.o", ">.....<>", ".>....<.", "....<.<.", ">.>..<..", "....A..."],
  },
  {
    name: "on_foot",
    seed: 9,
    config: { vehicles: 6, pedestrians: 16 },
    rows: ["........", "(.......", ".(.<....", "........", "........", ").).(...", "........", "........", "......(.", ".......(", "........", "....A..."],
  },
  {
    name: "rough",
    seed: 11,
    config: { potholes: 40, vehicles: 6 },
    rows: ["...oo...", ".oo....o", "........", "..o.....", "oo..oo..", "<..o.o..", "....o...", "...o...o", ".....>.o", "o..ooo..", ".o......", "....A..."],
  },
  {
    name: "walls",
    seed: 5,
    config: { layout: "walls" },
    rows: ["##.#####", "........", "........", "####.###", "........", "#####.##", "o.......", "......<.", "##.#####", "........", "........", "....A..."],
  },
  {
    name: "narrows",
    seed: 3,
    config: { layout: "narrows" },
    rows: ["#####..#", "#####..#", "#####.>#", "........", "...>....", ".#######", ".#######", ".#######", ".#######", ".#######", "........", "....A..."],
  },
  {
    name: "dead_ends",
    seed: 4,
    config: { layout: "dead_ends", planner: "priority" },
    rows: [".#.#..#.", ".#.#..#.", ".#.#.>#.", "........", "........", "..######", "..#..#.<", "..#..#..", "..#..#<.", "........", "........", "....A..."],
  },
  {
    name: "maze",
    seed: 6,
    config: { layout: "maze", planner: "astar" },
    rows: ["...<....", "#####.##", "..#.>...", "##.#.##.", ".....<#.", "###.####", "........", "######.#", ".......>", "#####.##", "##......", "....A..."],
  },
  {
    name: "nobody_brakes",
    seed: 16,
    config: { vehicles: 24, potholes: 4, pedestrians: 4, attentive: 0 },
    rows: ["..).....", ".......>", "........", ".>...<>.", "......>.", "..<.....", ".o......", ".....>..", "........", ".<.)....", "....<...", "....A..."],
  },
];

/** @param {string} name @returns {Scenario | undefined} */
export function scenarioNamed(name) {
  return SCENARIOS.find((each) => each.name === name);
}
