// The small modules: history, seeded chance and the looks drawn from it, the loop, the commands.
import assert from "node:assert/strict";
import { test } from "node:test";

import { COMMANDS } from "../../web/src/core/commands.js";
import { History } from "../../web/src/talk/history.js";
import { createLoop } from "../../web/src/core/renderLoop.js";
import { cracksOf, rimOf } from "../../web/src/road/paint/hazards.js";
import { lookOf } from "../../web/src/road/paint/vehicle.js";
import { seeded } from "../../web/src/road/random.js";

function storage(kept = {}) {
  return { getItem: (key) => kept[key] ?? null, setItem: (key, value) => (kept[key] = value), kept };
}

test("history walks back and forth and keeps the draft", () => {
  const history = new History(storage());
  history.add("one");
  history.add("two");
  assert.equal(history.back("dra"), "two");
  assert.equal(history.back("two"), "one");
  assert.equal(history.back("one"), null);
  assert.equal(history.forth(), "two");
  assert.equal(history.forth(), "dra");
  assert.equal(history.forth(), null);
});

test("history outlives the page, without repeats and not without end", () => {
  const kept = storage();
  const first = new History(kept);
  for (let n = 0; n < 150; n++) first.add(`say ${n}`);
  first.add("say 60");
  const second = new History(kept);
  assert.equal(second.said.length, 100);
  assert.equal(second.back(""), "say 60");
  assert.equal(second.said.filter((text) => text === "say 60").length, 1);
});

test("history does without storage that is forbidden, full or spoilt", () => {
  const forbidden = {
    getItem() {
      throw new Error("denied");
    },
    setItem() {
      throw new Error("denied");
    },
  };
  for (const store of [null, forbidden, storage({ "roadtalk.history": "{" }), storage({ "roadtalk.history": '{"a":1}' })]) {
    const history = new History(store);
    history.add("one");
    assert.equal(history.back(""), "one");
  }
});

test("chance depends on the name alone and is spread evenly", () => {
  const draw = (name) => Array.from({ length: 5 }, seeded(name));
  assert.deepEqual(draw("pothole-1"), draw("pothole-1"));
  assert.notDeepEqual(draw("pothole-1"), draw("pothole-2"));
  const random = seeded("spread");
  const tenths = new Array(10).fill(0);
  for (let n = 0; n < 20_000; n++) tenths[Math.floor(random() * 10)] += 1;
  for (const count of tenths) assert.ok(Math.abs(count - 2_000) < 250, String(count));
});

test("a pothole looks the same every time, unlike the next, and stays in its cell", () => {
  assert.deepEqual(rimOf("pothole-1"), rimOf("pothole-1"));
  assert.deepEqual(cracksOf("pothole-1"), cracksOf("pothole-1"));
  assert.notDeepEqual(rimOf("pothole-1"), rimOf("pothole-2"));
  for (let n = 0; n < 500; n++) {
    const points = [...rimOf(`pothole-${n}`), ...cracksOf(`pothole-${n}`).flat()];
    for (const [x, y] of points) assert.ok(Math.abs(x) < 0.65 && Math.abs(y) < 0.65, `pothole-${n}: ${x}, ${y}`);
  }
});

test("vehicles come in many looks, keep theirs, and show that they are disabled", () => {
  const looks = new Set(Array.from({ length: 200 }, (_, n) => lookOf(`vehicle-${n}`, false).key));
  assert.ok(looks.size >= 15, String(looks.size));
  assert.equal(lookOf("vehicle-3", false).key, lookOf("vehicle-3", false).key);
  assert.equal(lookOf("vehicle-3", true).body, lookOf("vehicle-3", false).body);
  assert.notEqual(lookOf("vehicle-3", true).key, lookOf("vehicle-3", false).key);
});

test("the loop draws once a frame however often it is woken, and rests when nothing moves", () => {
  const frames = [];
  const done = [];
  let moving = 2;
  const loop = createLoop({
    update: () => done.push("update"),
    draw: () => (done.push("draw"), --moving > 0),
    request: (frame) => frames.push(frame),
  });
  loop.wake(true);
  loop.wake(true);
  loop.wake();
  assert.equal(frames.length, 1);
  frames.shift()(0);
  frames.shift()(16);
  assert.deepEqual(done, ["update", "draw", "draw"]);
  assert.equal(frames.length, 0);
});

test("each act says what it will do now, and has a key of its own", () => {
  const act = (name) => COMMANDS.find((one) => one.name === name);
  const running = { world: { paused: false } };
  const paused = { world: { paused: true } };
  assert.deepEqual(act("clock").now(running).turns, [[{ do: "pause" }]]);
  assert.deepEqual(act("clock").now(paused).turns, [[{ do: "resume" }]]);
  assert.deepEqual(act("step").now(paused).turns, [[{ do: "step", ticks: 1 }]]);
  assert.deepEqual(act("step").now(running).turns, [[{ do: "pause" }], [{ do: "step", ticks: 1 }]]);
  assert.equal(new Set(COMMANDS.map(({ key }) => key)).size, COMMANDS.length);
});
