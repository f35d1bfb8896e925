import assert from "node:assert/strict";
import { test } from "node:test";

import { rulesShown } from "../../web/src/panels/rules.js";
import { worldOf } from "../../web/src/road/world.js";

const RULE = { number: 1, text: "Every 10 ticks: add 1 car", since: 0, fired: 2, action: {} };
const STATE = { hazards: [], movers: [], vehicles: [], metrics: {} };

test("the rules of the present are shown, and those of no past tick", () => {
  const world = worldOf({ ...STATE, rules: [RULE] });
  assert.deepEqual(rulesShown(world, null), [RULE]);
  assert.deepEqual(rulesShown(world, { world }), []);
  assert.deepEqual(rulesShown(null, null), []);
});

test("a service that knows no rules has none", () => {
  assert.deepEqual(rulesShown(worldOf(STATE), null), []);
});
