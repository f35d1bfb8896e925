// What is told of cells and things, what is touched, which keys drive, and what would have been.

import assert from "node:assert/strict";
import { test } from "node:test";

import { fetchComparison, nameOfOther, partOf, titleOf } from "../../web/src/why/counterfactual.js";
import { isDriving, moveOf } from "../../web/src/road/drivingKeys.js";
import { hindrance, isLoose, moving, placing, removing } from "../../web/src/road/edit.js";
import { onRoad, thingAt, thingIn } from "../../web/src/road/hitTest.js";
import { cellWords, headingWords, placeWords } from "../../web/src/road/placeTexts.js";
import { fetchDecision, labelOf } from "../../web/src/why/alternatives.js";
import { servedView } from "../../web/src/road/serverCamera.js";
import { INITIAL } from "../../web/src/core/state.js";
import { linesAbout, optionTo, tellOf } from "../../web/src/why/why.js";
import { worldOf } from "../../web/src/road/world.js";
import { wireState } from "./fakes.mjs";

const world = worldOf(wireState());
const decision = {
  tick: 9,
  move: "forward_left",
  reason: "pothole",
  causes: ["pothole-1"],
  narration: "Forward left, since a pothole is ahead.",
  options: [
    { move: "forward", cell: [4, 20], verdict: "blocked", cost: null, reason: "pothole", causes: ["pothole-1"], text: "a pothole in the way" },
    { move: "forward_left", cell: [3, 20], verdict: "free", cost: 1, reason: "free", causes: [] },
    { move: "left", cell: [3, 21], verdict: "free", cost: 2, reason: "free", causes: [], text: "free, less preferred" },
    { move: "right", cell: null, verdict: "off_road", cost: null, reason: "off_road", causes: [] },
  ],
};

test("a place is told as seen from the vehicle", () => {
  assert.equal(placeWords(world, [4, 17]), "lane 5, its own, 3 rows ahead");
  assert.equal(placeWords(world, [2, 21]), "lane 3, 1 row behind");
  assert.equal(placeWords(world, [1, 20]), "lane 2, beside it on the left");
  assert.equal(placeWords(world, [4, 20]), "lane 5, 20 rows to go");
});

test("a cell is said with what is in it, for those who do not see it", () => {
  assert.equal(cellWords(world, [3, 15]), "lane 4, 5 rows ahead: a pothole");
  assert.equal(cellWords(world, [2, 19]), "lane 3, 1 row ahead: a car, heading right");
  assert.equal(cellWords(world, [0, 0]), "lane 1, 20 rows ahead: free");
});

test("heading is told of what moves by itself", () => {
  assert.equal(headingWords({ kind: "pedestrian", heading: "left", disabled: false }), "walking left");
  assert.equal(headingWords({ kind: "vehicle", heading: "left", disabled: true }), "held by a pothole");
  assert.equal(headingWords({ kind: "pothole", heading: null, disabled: false }), "");
});

test("of two in a cell the one on top is meant", () => {
  const both = worldOf(
    wireState({ hazards: [{ id: "pothole-9", kind: "pothole", cell: [2, 19] }] }),
  );
  assert.equal(thingIn(both, [2, 19]).id, "vehicle-1");
  assert.equal(thingIn(both, [7, 7]), null);
});

test("what is seen between two cells is pointed at where it is seen", () => {
  const thing = world.things.get("vehicle-1");
  const places = {
    cellAt: (x, y) => [Math.floor(x / 10), Math.floor(y / 10)],
    placeOf: ([column, row]) => ({ left: column * 10, top: row * 10, width: 10, height: 10 }),
    poses: () => [{ thing, column: 1.5, row: 19 }],
  };
  assert.equal(thingAt(places, world, 20, 195)?.id, "vehicle-1");
  assert.equal(thingAt(places, world, 29, 195), null);
  assert.equal(thingAt({ ...places, poses: undefined }, world, 29, 195)?.id, "vehicle-1");
});

test("what was decided about a thing comes from the trace, in the service's words, and from less where there is less", () => {
  const why = "Forward left, since a pothole is ahead.";
  assert.deepEqual(linesAbout(decision, "pothole-1"), ["Forward: a pothole in the way", why]);
  const brief = { ...decision, options: undefined };
  assert.deepEqual(linesAbout(brief, "pothole-1"), [why]);
  assert.deepEqual(linesAbout(decision, "vehicle-1"), []);
  assert.deepEqual(linesAbout(null, "pothole-1"), []);
});

test("a cell that a move led to is told with that move", () => {
  const lines = (cell) => tellOf({ kind: "cell", cell, id: null }, { ...INITIAL, world, decision }, decision).lines.slice(1);
  assert.deepEqual(lines([3, 21]), ["Left: free, less preferred"]);
  assert.deepEqual(lines([0, 0]), []);
  assert.equal(optionTo(decision, [3, 20]).move, "forward_left");
  assert.equal(optionTo(decision, [0, 0]), null);
});

test("a thing is offered away, and to be imagined away, by its id", () => {
  const told = tellOf({ kind: "cell", cell: [3, 15], id: "pothole-1" }, { ...INITIAL, world, decision }, decision);
  assert.equal(told.title, "Pothole");
  assert.equal(told.note, "pothole-1");
  const [why, whatIf, remove] = told.offers;
  assert.deepEqual(why.act.actions, [{ do: "ask", about: "why", tick: 9 }]);
  assert.deepEqual(whatIf.pick, {
    kind: "change",
    tick: null,
    actions: removing({ kind: "pothole", id: "pothole-1" }),
    label: "Without the pothole",
  });
  assert.deepEqual(remove.act.actions, [{ do: "remove", kind: "pothole", count: 1, where: { id: "pothole-1" } }]);
});

test("free road is offered for what fits, and the move that led there can be asked about", () => {
  const state = { ...INITIAL, world, decision };
  const told = tellOf({ kind: "cell", cell: [3, 21], id: null }, state, decision);
  assert.deepEqual(told.offers.map(({ text }) => text), ["What if it had gone here?", "Ask why not", "Pothole", "Barrier", "Car", "Pedestrian"]);
  assert.deepEqual(told.offers[0].pick, { kind: "move", tick: 9, move: "left" });
  assert.deepEqual(told.offers[1].act.actions, [{ do: "ask", about: "why_not", tick: 9, move: "left" }]);
});

test("what is past is imagined otherwise there, and not changed", () => {
  const past = { world, decision, narration: null };
  const state = { ...INITIAL, world, decision, past };
  const thing = tellOf({ kind: "cell", cell: [3, 15], id: "pothole-1" }, state, decision);
  assert.deepEqual(thing.offers.map(({ text }) => text), ["Ask why", "What if it weren't there?"]);
  assert.equal(thing.offers[1].pick.tick, world.tick);
  assert.equal(thing.offers[1].act, undefined);
  assert.deepEqual(tellOf({ kind: "cell", cell: [0, 0], id: null }, state, decision).offers, []);
  const ego = tellOf({ kind: "cell", cell: [4, 20], id: "av-1" }, state, decision);
  assert.deepEqual(ego.offers.map(({ text }) => text), ["Ask why"]);
});

test("who drives can be changed at the vehicle", () => {
  const offers = (mode) => tellOf({ kind: "cell", cell: [4, 20], id: "av-1" }, { ...INITIAL, world: { ...world, mode } }, null).offers;
  assert.deepEqual(offers("auto")[0].act.actions, [{ do: "mode", mode: "manual" }]);
  assert.deepEqual(offers("manual")[0].act.actions, [{ do: "mode", mode: "auto" }]);
});

test("of a decision the moves that could have been driven can be watched", () => {
  const told = tellOf({ kind: "decision", tick: 9 }, { ...INITIAL, world }, decision);
  assert.deepEqual(told.moves.map(({ move }) => move), ["forward", "left"]);
  assert.deepEqual(told.lines, [decision.narration]);
  assert.equal(tellOf({ kind: "decision", tick: 9 }, INITIAL, null), null);
});

test("a thing is moved in one utterance", () => {
  const thing = world.things.get("pothole-1");
  assert.deepEqual(moving(thing, [1, 2]), [...removing(thing), ...placing("pothole", [1, 2])]);
  assert.equal(isLoose(thing), true);
  assert.equal(isLoose(world.things.get("av-1")), false);
  assert.equal(isLoose(null), false);
});

test("what is in the way is told before the service is asked", () => {
  assert.equal(hindrance(world, "barrier", [0, 0]), null);
  assert.equal(hindrance(world, "barrier", [8, 0]), "That is off the road.");
  assert.equal(hindrance(world, "barrier", [4, 20]), "There is the vehicle already.");
  assert.equal(hindrance(world, "barrier", [2, 19]), "There is a car already.");
  assert.equal(hindrance(world, "pothole", [2, 19]), null, "a pothole may open under one that moves");
  assert.equal(hindrance(world, "pothole", [3, 15], "pothole-1"), null, "a thing is not in its own way");
  assert.equal(onRoad(world, [-1, 3]), false);
});

test("arrows held together are a diagonal, left and right together nothing", () => {
  assert.equal(moveOf(["ArrowUp"]), "forward");
  assert.equal(moveOf(["ArrowUp", "ArrowLeft"]), "forward_left");
  assert.equal(moveOf(["ArrowRight", "ArrowUp"]), "forward_right");
  assert.equal(moveOf(["ArrowLeft"]), "left");
  assert.equal(moveOf(["ArrowLeft", "ArrowRight"]), null);
  assert.equal(moveOf(["9"]), "forward_right");
  assert.equal(moveOf(["s"]), moveOf(["ArrowDown"]));
  assert.equal(moveOf([]), null);
  assert.equal(isDriving("toString"), false);
});

const SIDE = (moves, end) => ({
  state: wireState({ tick: 9 }),
  ticks: moves.map((move, at) => ({
    tick: 10 + at,
    episode: 1,
    status: at === moves.length - 1 ? end.outcome : "running",
    vehicles: { "av-1": [4, 19 - at] },
    moved: {},
    turned: {},
    decision: { tick: 9 + at, move, reason: "free", causes: [], planner: "priority", weight: 0 },
    cause: at === moves.length - 1 ? end.cause : null,
  })),
  end: { text: end.outcome, by_hand: false, waited: 0, digest: "d", tick: 9 + moves.length, driven: moves.length, cause: null, ...end },
});
const CRASH = { outcome: "crash", cause: { kind: "pothole", how: "hit", ids: ["pothole-1"], cell: [4, 18] } };
const TOLD = {
  at_tick: 9,
  instead_of: "left",
  said_since: 0,
  text: "At tick 9 I go forward instead of moving left.",
  real: SIDE(["left", "forward", "forward"], { outcome: "success" }),
  changed: SIDE(["forward", "forward"], CRASH),
};
const answering = (value, ok = true) => {
  const asked = [];
  const http = async (path, more) => {
    asked.push([path, more?.body && JSON.parse(more.body)]);
    return { ok, status: ok ? 200 : 422, json: async () => value };
  };
  return { http, asked };
};

test("cells are found on a picture that the service has drawn", () => {
  const road = { columns: 8, rows: 30, visibleRows: 8 };
  // 8 cells of 70 pixels and 17 of verge on either side.
  const view = servedView({ width: 300, height: 400 }, { width: 594, height: 560 }, road, 25);
  const scale = 300 / 594;
  assert.ok(Math.abs(view.cell - 70 * scale) < 1e-9);
  assert.ok(Math.abs(view.left - 17 * scale) < 1e-9);
  assert.ok(Math.abs(view.top - (400 - 560 * scale) / 2) < 1e-9);
  assert.ok(Math.abs(view.row - 19.9) < 1e-9);
  assert.equal(servedView({ width: 300, height: 400 }, { width: 594, height: 560 }, road, 29).row, 22);
  assert.equal(servedView({ width: 300, height: 400 }, { width: 594, height: 560 }, road, 1).row, 0);
});

test("both runs come as worlds in step", async () => {
  const { http, asked } = answering(TOLD);
  const found = await fetchComparison("s 1", { kind: "move", tick: 9, move: "forward" }, http);
  assert.deepEqual(asked, [["/api/v1/sessions/s%201/counterfactual", { move: "forward", at_tick: 9 }]]);
  assert.deepEqual(found.real.frames.map(({ world }) => world.tick), [9, 10, 11, 12]);
  assert.deepEqual(found.changed.frames.at(-1).world.things.get("av-1").cell, [4, 18]);
  assert.equal(found.changed.frames.at(-1).world.status, "crash");
  assert.deepEqual(found.changed.frames.at(-1).world.cause.ids, ["pothole-1"]);
  assert.deepEqual(partOf(found), { at: 1, tick: 9, real: "left", changed: "forward" });
  assert.equal(found.text, TOLD.text);
  assert.deepEqual([found.real.end.text, found.changed.end.text], ["success", "crash"]);
});

test("a change now is sent without a tick", async () => {
  const { http, asked } = answering({ ...TOLD, changed: TOLD.real });
  const actions = [{ do: "reset" }];
  const found = await fetchComparison("s1", { kind: "change", tick: null, actions, label: "x" }, http);
  assert.deepEqual(asked[0][1], { actions });
  assert.equal(partOf(found), null);
});

test("a refusal is told with its reason, and a service that is not there too", async () => {
  const { http } = answering({ detail: "no", errors: [{ field: "move", message: "That move leads off the road." }] }, false);
  await assert.rejects(fetchComparison("s1", { kind: "move", tick: 1, move: "left" }, http), /leads off the road/);
  const gone = async () => {
    throw new TypeError("network");
  };
  await assert.rejects(fetchDecision("s1", 3, undefined, gone), /cannot be reached/);
});

test("titles and names of what is imagined", () => {
  const move = { kind: "move", tick: 4, move: "stay" };
  assert.equal(titleOf(move), "Instead: stay");
  assert.equal(titleOf({ ...move, move: "left" }, 4), "Instead: left, at tick 4");
  assert.equal(nameOfOther(move), "If stay");
  const remove = (kind, where) => ({ do: "remove", kind, count: where ? 1 : "all", where });
  assert.equal(labelOf([remove("pothole")]), "Without potholes");
  assert.equal(labelOf([remove("everything")]), "With an empty road");
  assert.equal(labelOf([remove("pothole", { id: "pothole-1" }), remove("vehicle", { id: "vehicle-2" })]), "Without the pothole and the car");
  assert.equal(labelOf([remove("pothole", { id: "pothole-1" }), remove("pothole", { id: "pothole-2" })]), "Without pothole-1 and pothole-2");
  assert.equal(labelOf([{ do: "add", kind: "pothole", count: 1 }]), "With that change");
});
