import assert from "node:assert/strict";
import { test } from "node:test";

import { handOver } from "../../web/src/panels/driver.js";
import { roadCommands } from "../../web/src/talk/conversation.js";
import { changeWords } from "../../web/src/core/words.js";

const SET_ASTAR = { do: "set", parameter: "planner", value: "astar" };
const world = { mode: "auto", planner: "rules" };

test("whoever is chosen drives, and one who already does changes nothing", () => {
  assert.deepEqual(handOver("astar", world), [SET_ASTAR]);
  assert.deepEqual(handOver("rules", world), []);
  assert.deepEqual(handOver("manual", world), [{ do: "mode", mode: "manual" }]);
});

test("a planner that is chosen while a person drives takes the wheel", () => {
  const byHand = { mode: "manual", planner: "rules" };
  assert.deepEqual(handOver("astar", byHand), [SET_ASTAR, { do: "mode", mode: "auto" }]);
  assert.deepEqual(handOver("rules", byHand), [{ do: "mode", mode: "auto" }]);
});

test("a new road of each family can be chosen, in the present", () => {
  const commands = roadCommands();
  const offered = commands.map((act) => act.now({ world, past: null }));
  assert.deepEqual(offered.map(({ label }) => label), [
    "New road: walls with gaps", "New road: narrow streets", "New road: dead ends", "New road: crossing traffic", "New road: a maze",
  ]);
  assert.deepEqual(offered.map(({ turns }) => turns[0][0].layout), ["walls", "narrows", "dead_ends", "crossing", "maze"]);
  assert.ok(commands.every((act) => act.now({ world, past: { world } }) === null && act.now({ world: null, past: null }) === null));
});

test("a family of roads is told in words", () => {
  assert.deepEqual(changeWords({ path: "config.layout", before: null, after: "maze" }), { name: "layout", before: "not set", after: "a maze" });
  assert.equal(changeWords({ path: "config.layout", before: "dead_ends", after: "spiral_road" }).after, "spiral road");
});
