import assert from "node:assert/strict";
import { test } from "node:test";

import { marksOf, Sensed } from "../../web/src/road/sensed.js";

const thing = (id, cell) => [id, { id, cell }];
const WORLD = { tick: 4, rows: 30, sensor: "camera", things: new Map([thing("av-1", [3, 20]), thing("pothole-1", [3, 18]), thing("pothole-2", [3, 25])]) };
const PERCEPT = { tick: 4, missed: ["pothole-1", "pothole-2"], seen: [{ cell: [5, 17], real: false }, { cell: [5, 22], real: false }, { cell: [1, 12], real: true }] };
const LIVE = { phase: "live" };
const answering = (asked) => async (path) => {
  asked.push(String(path));
  return new Response(JSON.stringify(PERCEPT), { headers: { "content-type": "application/json" } });
};
const settled = () => new Promise((done) => setTimeout(done, 5));

test("only what lies ahead is marked", () => {
  assert.deepEqual(marksOf(PERCEPT, WORLD), { missed: new Set(["pothole-1"]), madeUp: [[5, 17]] });
});

test("a sensor that may err is asked about once a tick, and its marks hold for that tick alone", async () => {
  const asked = [];
  const sensed = new Sensed(answering(asked));
  const state = { world: WORLD, session: "s1", connection: LIVE };
  sensed.update(state);
  assert.ok(sensed.waiting);
  await settled();
  assert.equal(asked.length, 1);
  assert.match(asked[0], /percept\?tick=4$/);
  sensed.update(state);
  await settled();
  assert.equal(asked.length, 1);
  assert.ok(!sensed.waiting);
  assert.deepEqual(sensed.of(WORLD)?.madeUp, [[5, 17]]);
  assert.equal(sensed.of({ ...WORLD }), null);
});

test("the perfect sensor is not asked about", async () => {
  const asked = [];
  const sensed = new Sensed(answering(asked));
  sensed.update({ world: { ...WORLD, sensor: "perfect" }, session: "s1", connection: LIVE });
  await settled();
  assert.deepEqual([asked, sensed.waiting], [[], false]);
});
