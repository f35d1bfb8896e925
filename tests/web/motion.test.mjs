import assert from "node:assert/strict";
import { test } from "node:test";

import { Camera, viewOf } from "../../web/src/road/camera.js";
import { ease, Stage } from "../../web/src/road/motion.js";
import { INITIAL, reduce } from "../../web/src/core/state.js";
import { hello, tick, wireState } from "./fakes.mjs";

const worlds = (...events) => {
  let state = INITIAL;
  return events.map((event) => (state = reduce(state, event)).world);
};

const seen = (stage, id, now) => {
  const { column, row } = stage.pose(id, now);
  return [column, row];
};

test("the easing starts and ends at rest, rises throughout and is its own mirror image", () => {
  assert.deepEqual([ease(-1), ease(0), ease(0.5), ease(1), ease(2)], [0, 0, 0.5, 1, 1]);
  for (let t = 0; t < 1; t += 0.01) {
    assert.ok(ease(t + 0.01) > ease(t));
    assert.ok(Math.abs(ease(t) + ease(1 - t) - 1) < 1e-12);
  }
  assert.ok(ease(0.01) < 0.001 && ease(0.99) > 0.999);
});

test("a thing glides from cell to cell within one step", () => {
  const [first, second] = worlds(hello(), tick());
  const stage = new Stage();
  stage.receive(first, 0, false);
  stage.receive(second, 1000, false);
  assert.deepEqual(seen(stage, "av-1", 1000), [4, 20]);
  assert.deepEqual(seen(stage, "av-1", 1250), [4, 19.5]);
  assert.deepEqual(seen(stage, "av-1", 1500), [4, 19]);
  assert.deepEqual(seen(stage, "av-1", 9000), [4, 19]);
  assert.ok(stage.moving(1200) && !stage.moving(1600));
});

test("a tick that comes early goes on from where things are seen", () => {
  const [first, second, third] = worlds(hello(), tick(), tick({ tick: 12, vehicles: { "av-1": [4, 18] } }));
  const stage = new Stage();
  stage.receive(first, 0, false);
  stage.receive(second, 1000, false);
  const before = seen(stage, "av-1", 1450);
  stage.receive(third, 1450, false);
  assert.deepEqual(seen(stage, "av-1", 1450), before);
  assert.deepEqual(seen(stage, "av-1", 1950), [4, 18]);
});

test("reduced motion cuts, and so does a new episode", () => {
  const [first, second, third] = worlds(
    hello(),
    tick(),
    tick({ tick: 12, episode: 2, state: wireState({ tick: 12, episode: 2, vehicles: [{ id: "av-1", kind: "av", cell: [4, 29] }] }) }),
  );
  const stage = new Stage();
  stage.receive(first, 0, true);
  stage.receive(second, 1000, true);
  assert.deepEqual(seen(stage, "av-1", 1000), [4, 19]);
  stage.receive(third, 1500, false);
  assert.deepEqual(seen(stage, "av-1", 1500), [4, 29]);
  assert.deepEqual(stage.trail, [[4, 29]]);
});

test("what is added grows in, what is removed fades and is then gone", () => {
  const added = wireState({ hazards: [...wireState().hazards, { id: "pothole-2", kind: "pothole", cell: [1, 18] }] });
  const changed = { type: "changed", sequence: 102, text: null, reply: "", changes: [], events: [] };
  const [first, second, third] = worlds(hello(), { ...changed, state: added }, { ...changed, state: wireState() });
  const stage = new Stage();
  stage.receive(first, 0, false);
  stage.receive(second, 1000, false);
  assert.ok(stage.pose("pothole-2", 1000).scale < 0.2);
  assert.equal(stage.pose("pothole-2", 2000).scale, 1);
  assert.ok(stage.moving(1010) && !stage.moving(2000), "drawn until it has grown, however long ago the tick was");
  assert.equal(stage.pose("pothole-1", 1000).scale, 1);
  stage.receive(third, 3000, false);
  assert.ok(stage.moving(3010) && !stage.moving(4000));
  assert.ok(stage.poses(3100).some(({ thing, alpha }) => thing.id === "pothole-2" && alpha < 1));
  assert.ok(!stage.poses(3500).some(({ thing }) => thing.id === "pothole-2"));
});

test("a mover turns round within the step and ends facing its heading", () => {
  const [first, second] = worlds(hello(), tick({ turned: { "vehicle-1": "left" } }));
  const stage = new Stage();
  stage.receive(first, 0, false);
  assert.equal(stage.pose("vehicle-1", 0).facing, 0);
  stage.receive(second, 1000, false);
  assert.equal(stage.pose("vehicle-1", 1000).facing, 0);
  assert.equal(stage.pose("vehicle-1", 1500).facing, Math.PI);
});

test("cells are as large as fit and the road is centred", () => {
  const road = { columns: 8, visibleRows: 8 };
  for (const [width, height] of [[936, 700], [360, 360], [300, 900]]) {
    const view = viewOf({ width, height, ratio: 1 }, road);
    assert.ok(view.cell * 8 <= height + 1e-9 && view.left - view.shoulder >= -1e-9);
    assert.ok(Math.abs(view.left * 2 + view.cell * 8 - width) < 1e-9);
  }
});

test("the camera keeps the vehicle in view from start to finish and comes to rest", () => {
  const view = viewOf({ width: 936, height: 720, ratio: 1 }, { columns: 8, visibleRows: 8 });
  const camera = new Camera();
  for (let row = 29; row >= 0; row -= 0.02) {
    camera.follow(row, { rows: 30 }, view, 1 / 60);
    const share = (row + 0.5 - camera.top) / view.visibleRows;
    assert.ok(share > 0.05 && share < 0.97, `row ${row}: ${share}`);
  }
  let frames = 0;
  while (camera.follow(0, { rows: 30 }, view, 1 / 60)) assert.ok(++frames < 300, "the camera never rests");
});
