import assert from "node:assert/strict";
import { test } from "node:test";

import { drawBeam, drawBody, drawBox, heightOf } from "../../web/src/road/perspective/bodies.js";
import { Backdrop, paintBackdrop } from "../../web/src/road/perspective/backdrop.js";
import { Eye, lensOf } from "../../web/src/road/perspective/eye.js";
import { drawPothole } from "../../web/src/road/perspective/figures.js";
import { drawGround, drawPosts } from "../../web/src/road/perspective/ground.js";
import { drawCell, drawNext, drawRibbon, drawRing, drawSensed, drawTouch, drawTrail } from "../../web/src/road/perspective/marks.js";
import { Perspective } from "../../web/src/road/perspective/perspective.js";
import { INITIAL } from "../../web/src/core/state.js";
import { pathOf } from "../../web/src/why/forecast.js";
import { KINDS, PALETTE, pose, recording } from "./recording.mjs";

const CANVAS = { width: 560, height: 610, ratio: 2 };
const WORLD = { columns: 8, rows: 40, visibleRows: 10, tick: 4, episode: 1, status: "running", mode: "auto", weather: "clear", light: "day", paused: true, things: new Map() };

function eyeAt(row = 20, column = 3, world = WORLD, canvas = CANVAS) {
  const eye = new Eye(lensOf(canvas, world));
  eye.follow({ column, row }, world, Infinity);
  return eye;
}

test("the vehicle's row is wholly seen, below the middle, and the horizon near the top", () => {
  for (const canvas of [CANVAS, { width: 390, height: 420, ratio: 3 }, { width: 1400, height: 600, ratio: 1 }]) {
    const eye = eyeAt(20, 3, WORLD, canvas);
    const [left, y] = eye.spot(-0.5, 20);
    const [right] = eye.spot(7.5, 20);
    assert.ok(left > 0 && right < canvas.width, `${left} to ${right}`);
    assert.ok(y > 0.7 * canvas.height && y < 0.85 * canvas.height);
    assert.ok(eye.lens.horizon < 0.2 * canvas.height);
  }
});

test("what is further is smaller and higher, what stands up is above its foot, and lines meet at the horizon", () => {
  const eye = eyeAt();
  const [near, far] = [eye.spot(3, 20), eye.spot(3, 10)];
  assert.ok(far[1] < near[1]);
  assert.ok(eye.scale(10) < eye.scale(20) / 1.5);
  assert.ok(eye.spot(3, 20, 0.3)[1] < near[1]);
  const [one, other] = [eye.spot(-0.5, -100_000), eye.spot(7.5, -100_000)];
  assert.ok(Math.abs(one[0] - other[0]) < 1 && Math.abs(one[1] - eye.lens.horizon) < 1);
});

test("a place on the canvas leads back to its place on the road; the sky leads nowhere", () => {
  const eye = eyeAt();
  for (const [column, row] of [[0, 20], [7, 12], [3.4, 1], [5, 20.7]]) {
    const back = eye.ground(...eye.spot(column, row));
    assert.ok(back && Math.hypot(back[0] - column, back[1] - row) < 1e-6, `${column}, ${row}: ${back}`);
  }
  assert.equal(eye.ground(100, eye.lens.horizon - 1), null);
  assert.equal(eye.ground(100, eye.lens.horizon + 0.01), null);
});

test("the eye stays over a road that is wholly seen, goes with the vehicle over a wide one, and stops at its edges", () => {
  assert.equal(eyeAt(20, 0).x, eyeAt(20, 7).x);
  const wide = { ...WORLD, columns: 40 };
  const [left, middle, right] = [0, 20, 39].map((column) => eyeAt(20, column, wide));
  assert.equal(middle.x, 20);
  assert.ok(left.x > 3 && right.x < 36);
  assert.ok(left.spot(-0.5, 20)[0] > 0);
});

test("the eye comes after the vehicle and rests there", () => {
  const eye = eyeAt(20);
  assert.equal(eye.follow({ column: 3, row: 19 }, WORLD, 0.05), true);
  assert.ok(eye.row < 20 && eye.row > 19);
  let moving = true;
  for (let frame = 0; moving && frame < 1000; frame++) moving = eye.follow({ column: 3, row: 19 }, WORLD, 0.05);
  assert.equal(eye.row, 19);
});

const seen = KINDS.flatMap((kind, at) => [pose(kind, at, 16, { facing: 0 }), pose(kind, at, 9, { facing: Math.PI })]);
const signal = { move: "left", blink: true };
const PAINTED = {
  backdrop: (pen, eye) => paintBackdrop(pen, eye, WORLD.columns, PALETTE),
  ground: (pen, eye) => drawGround(pen, eye, WORLD, PALETTE),
  "ground at the goal": (pen) => drawGround(pen, eyeAt(0), WORLD, PALETTE),
  "ground at the start": (pen) => drawGround(pen, eyeAt(39), WORLD, PALETTE),
  posts: (pen, eye) => drawPosts(pen, eye, WORLD, PALETTE, () => 0.5),
  bodies: (pen, eye) => seen.forEach((each) => drawBody(pen, eye, each, PALETTE, signal)),
  "disabled bodies": (pen, eye) => seen.forEach((each) => drawBody(pen, eye, { ...each, thing: { ...each.thing, disabled: true } }, PALETTE, { move: "stay", blink: false })),
  "something new": (pen, eye) => drawBody(pen, eye, pose("something new", 2, 18), PALETTE, signal),
  pothole: (pen, eye) => drawPothole(pen, eye, pose("pothole", 2, 18), PALETTE),
  beam: (pen, eye) => drawBeam(pen, eye, pose("av", 2, 18), 0.6),
  boxes: (pen, eye) => seen.forEach((each) => drawBox(pen, eye, each, { across: 0.6, along: 0.3 }, "red")),
  ribbon: (pen, eye) => drawRibbon(pen, eye, [[3, 20], [3, 19], [2, 18], [2, 18], [1, 18]], PALETTE),
  "a ribbon that stays": (pen, eye) => drawRibbon(pen, eye, [[3, 20], [3, 20]], PALETTE),
  trail: (pen, eye) => drawTrail(pen, eye, [[3, 24], [3, 21], [3, 20]], PALETTE),
  "next cells": (pen, eye) => drawNext(pen, eye, seen, [{ "vehicle-1": [4, 16] }, { "vehicle-1": [5, 16] }], PALETTE),
  ring: (pen, eye) => drawRing(pen, eye, [3, 18], "red", 0.5),
  cell: (pen, eye) => drawCell(pen, eye, [3, 18], "red", false),
  "a hazard's cell": (pen, eye) => drawCell(pen, eye, [3, 18], "red", true),
  sensed: (pen, eye) => drawSensed(pen, eye, seen, { missed: new Set(["vehicle-1"]), madeUp: [[3, 12], [3, 99]] }, PALETTE),
  touch: (pen, eye) => drawTouch(pen, eye, [3, 18], (brush) => brush.fill()),
};

for (const [name, paint] of Object.entries(PAINTED)) {
  test(`${name}: something is drawn, at numbers, and the pen is handed back as it came`, () => {
    const { pen, drawn, count } = recording();
    paint(pen, eyeAt());
    assert.ok(count("fill") + count("stroke") + count("fillRect") > 0);
    assert.equal(count("save"), count("restore"));
    for (const { what, values } of drawn) {
      for (const value of values.flat()) if (typeof value === "number") assert.ok(Number.isFinite(value), `${what}(${values})`);
    }
  });
}

test("bodies are as high as their kind: what lies in the road is flat, a pedestrian is the tallest but for a truck", () => {
  const height = (kind, id = `${kind}-1`) => heightOf({ kind, id, disabled: false });
  assert.equal(height("pothole"), 0);
  assert.ok(height("pedestrian") > height("av") && height("av") > height("barrier"));
});

/** A moment as the road's view makes it. */
function moment(pen, changes = {}) {
  const state = { ...INITIAL, world: WORLD, decision: { tick: 3, move: "left", causes: ["barrier-1"] }, highlight: { ids: ["pothole-1"], cells: [[2, 12]] } };
  return { pen, palette: PALETTE, progress: 0.5, now: 0, world: WORLD, seen, state: { ...state, views: { ...INITIAL.views, potholes: true, forecast: true, boxes: true, perspective: true } }, ...changes };
}

const GIVEN = { ego: pose("av", 3, 20), trail: [[3, 21]], path: [[3, 20], [3, 19]], ahead: [{ "vehicle-1": [2, 16] }], hit: [3, 19], sensed: null, elapsedS: 0.1 };

/** A backdrop on a canvas that writes down what is painted on it. */
function backdrop() {
  const painted = recording();
  const canvas = { getContext: () => painted.pen };
  return { laid: new Backdrop(() => canvas), painted };
}

test("what stands still is painted once, and again for another size, place or colour", () => {
  const { laid, painted } = backdrop();
  const { pen, count } = recording();
  const times = () => painted.count("setTransform");
  for (const row of [20, 19.5, 3]) laid.lay(pen, eyeAt(row), 8, PALETTE);
  assert.equal(times(), 1);
  assert.equal(count("drawImage"), 3);
  laid.lay(pen, eyeAt(20, 3, WORLD, { ...CANVAS, width: 400 }), 8, PALETTE);
  laid.lay(pen, eyeAt(20), 8, { ...PALETTE });
  laid.lay(pen, eyeAt(20, 30, { ...WORLD, columns: 40 }), 40, { ...PALETTE });
  assert.equal(times(), 4);
});

test("the whole road is drawn, the far before the near, and places are told as they are drawn", () => {
  const { pen, count } = recording();
  const view = new Perspective(backdrop().laid);
  assert.equal(view.placeOf([3, 20]), null, "nothing is drawn yet");
  assert.equal(view.draw(moment(pen), CANVAS, GIVEN), false, "the first picture is there at once");
  assert.ok(count("fill") > 100);
  assert.equal(count("save"), count("restore"));
  const place = view.placeOf([3, 20]);
  assert.ok(place.width > 40 && place.height > 20);
  const spot = view.spotAt(place.left + place.width / 2, place.top + place.height / 2);
  assert.deepEqual(spot.map(Math.round), [3, 20]);
  assert.equal(view.placeOf([3, 60]), null, "that is behind the eye");
  const [first, last] = view.window;
  assert.ok(first < 10 && last > 20 && last < 25);
  assert.ok(Math.abs(view.cell - place.width) < 1e-6);
});

test("another size keeps the eye where it was; another road begins anew", () => {
  const { pen } = recording();
  const view = new Perspective(backdrop().laid);
  view.draw(moment(pen), CANVAS, GIVEN);
  view.repaint();
  assert.equal(view.draw(moment(pen), { ...CANVAS, width: 300 }, { ...GIVEN, ego: pose("av", 3, 10) }), true, "it is on its way");
  const next = { ...WORLD, episode: 2 };
  assert.equal(view.draw(moment(pen, { world: next }), CANVAS, { ...GIVEN, ego: pose("av", 3, 39) }), false);
});

test("the path leads from where the vehicle is seen over the cells that were told, and none leads elsewhere", () => {
  const views = { ...INITIAL.views, perspective: true };
  const foresight = { of: WORLD.things, tick: 3, decision: null, ahead: [], path: [[3, 20], [3, 19], [2, 18]] };
  const ego = { thing: { cell: [3, 20] }, column: 3, row: 20.4 };
  const state = { ...INITIAL, views, world: WORLD, foresight };
  assert.deepEqual(pathOf(state, ego), [[3, 20.4], [3, 20], [3, 19], [2, 18]]);
  assert.deepEqual(pathOf(state, { ...ego, row: 20 }), [[3, 20], [3, 19], [2, 18]]);
  assert.deepEqual(pathOf({ ...state, foresight: { ...foresight, path: [[9, 9], [9, 8]] } }, ego), [[3, 20.4], [3, 20]]);
  assert.deepEqual(pathOf({ ...state, foresight: { ...foresight, tick: 9 } }, ego), [[3, 20.4], [3, 20]]);
  for (const other of [{ views: { ...views, path: false } }, { views: INITIAL.views }, { world: { ...WORLD, mode: "manual" } }, { world: { ...WORLD, status: "crash" } }]) {
    assert.deepEqual(pathOf({ ...state, ...other }, ego), []);
  }
});
