// What is shown, what it will do, how it was judged, what is read in words, what the service draws.
import assert from "node:assert/strict";
import { test } from "node:test";

import { foreseen, foresee, underWay } from "../../web/src/why/forecast.js";
import { createStore } from "../../web/src/core/store.js";
import { missingFrom, sumOf, WINDOW } from "../../web/src/why/regret.js";
import { RegretLoader } from "../../web/src/why/regretLoader.js";
import { roadWords } from "../../web/src/road/laneSentences.js";
import { drawPlan } from "../../web/src/road/paint/plan.js";
import { pictureOf } from "../../web/src/road/serverVideo.js";
import { sightOf } from "../../web/src/panels/plan.js";
import { INITIAL, reduce } from "../../web/src/core/state.js";
import { INITIAL_VIEWS, viewsAfter } from "../../web/src/ui/views.js";
import { moveOptions } from "../../web/src/why/moveOptions.js";
import { worldOf } from "../../web/src/road/world.js";
import { hello, settle, tick, wireState } from "./fakes.mjs";

const begun = () => reduce(INITIAL, hello());
const changed = (more) => ({ type: "changed", sequence: 100, text: null, reply: "", changes: [], events: [], state: wireState(), ...more });

/** A pen that notes what is drawn with it. */
function recorder() {
  const calls = [];
  const handler = { get: (target, name) => (name in target ? target[name] : (...args) => calls.push([name, ...args])) };
  return { pen: new Proxy({ globalAlpha: 1 }, handler), calls };
}

test("views are changed by name, and what the page does not know is left out", () => {
  assert.equal(viewsAfter(INITIAL_VIEWS, { plan: true, sensors: true, path: "no" }), INITIAL_VIEWS);
  assert.deepEqual(viewsAfter(INITIAL_VIEWS, { plan: false, potholes: true }), { ...INITIAL_VIEWS, plan: false, potholes: true });
});

test("what is said of views leaves road, log and decision as they are", () => {
  const before = reduce(begun(), tick());
  const after = reduce(before, changed({ views: { log: false, sensors: true } }));
  assert.deepEqual([after.views.log, after.views.sensors], [false, undefined]);
  assert.deepEqual([after.world, after.log, after.prior], [before.world, before.log, before.prior]);
  const both = reduce(before, changed({ views: { log: false }, changes: [{ path: "potholes", before: 1, after: 2 }] }));
  assert.equal(both.views.log, false);
  assert.equal(both.log.length, before.log.length + 1);
});

test("what is enlarged goes back when something else is to be seen, or when it is hidden", () => {
  const large = reduce(begun(), { type: "views", large: "plan" });
  assert.equal(large.large, "plan");
  assert.equal(reduce(large, { type: "views", views: { log: true } }).large, null);
  assert.equal(reduce(large, { type: "views", views: { plan: false } }).large, null);
  assert.equal(reduce(large, { type: "session", id: "other" }).large, "plan");
});

test("the move under way is known while nothing but its tick has changed the road", () => {
  const after = reduce(begun(), tick());
  const moving = underWay(after);
  assert.equal(moving.world.tick, 10);
  assert.deepEqual(moving.next["vehicle-1"], [3, 19]);
  assert.equal(underWay(reduce(after, changed({ state: wireState({ tick: 11 }) }))), null);
  assert.equal(underWay(begun()), null);
});

test("what is about to happen is asked for, and holds for that road only", async () => {
  const state = begun();
  const asked = [];
  const decision = { tick: 10, move: "forward", options: [] };
  const http = async (path) => {
    asked.push(path);
    return Response.json({ tick: 10, decision, exact: true, ahead: [{ tick: 11, movers: { "vehicle-1": [3, 19] } }] });
  };
  const known = reduce(state, { type: "foresight", foresight: await foresee("s1", state.world, false, { http }) });
  assert.deepEqual(foreseen(known).decision, decision);
  assert.equal(foreseen({ ...known, world: worldOf(wireState()) }), null);
  await foresee("s1", state.world, true, { http });
  assert.deepEqual(asked, ["/api/v1/sessions/s1/forecast?ticks=3", "/api/v1/sessions/s1/forecast?ticks=3&tick=10"]);
  assert.deepEqual(sightOf(known).centre, [4, 20]);
  assert.deepEqual(sightOf(known).decision, decision);
  assert.equal(sightOf(state), null);
});

test("each of the six moves has the service's words, and where the stream tells only a code, those for it", () => {
  const blocked = [
    { move: "right", reason: "mover_enters", causes: ["vehicle-1"] },
    { move: "left", reason: "off_road", causes: [] },
  ];
  const brief = moveOptions({ tick: 10, move: "forward", blocked }, [4, 20]);
  const told = Object.fromEntries(brief.map(({ move, standing, reason }) => [move, `${standing}: ${reason}`]));
  assert.equal(told.forward, "taken: free");
  assert.equal(told.right, "blocked: a car moves in");
  assert.equal(told.left, "off_road: off the road");
  assert.equal(told.stay, "free: free");
  assert.deepEqual(brief.find(({ move }) => move === "forward_right").cell, [5, 19]);
  const options = ["forward", "left", "right", "forward_left", "forward_right", "stay"].map((move) => {
    const held = blocked.find((each) => each.move === move);
    const verdict = held ? (held.reason === "off_road" ? "off_road" : "blocked") : "free";
    return { move, verdict, cost: held ? null : 1, reason: held?.reason ?? "free", causes: held?.causes ?? [], text: `words for ${move}` };
  });
  const whole = moveOptions({ tick: 10, move: "forward", options }, [4, 20]);
  const wordless = (/** @type {any[]} */ ways) => ways.map((way) => ({ ...way, reason: "" }));
  assert.deepEqual(wordless(whole), wordless(brief));
  assert.ok(whole.every(({ move, reason }) => reason === `words for ${move}`));
});

test("the plan draws an arrow to the intended cell and marks what is rejected", () => {
  const world = worldOf(wireState({ hazards: [{ id: "barrier-1", kind: "barrier", cell: [4, 19] }] }));
  const palette = { kinds: {}, good: "green", danger: "red", focus: "blue", cell: "grey", goal: "green", faint: "grey" };
  const decision = { tick: 10, move: "left", blocked: [{ move: "forward", reason: "barrier", causes: ["barrier-1"] }] };
  const { pen, calls } = recorder();
  drawPlan(pen, 90, { world, centre: [4, 20], next: {}, ways: moveOptions(decision, [4, 20]), pointed: [4, 19] }, palette);
  const turns = calls.filter(([name]) => name === "rotate").map(([, angle]) => angle);
  assert.ok(turns.includes(Math.PI), "the arrow points to the left");
  assert.ok(calls.some(([name, x, y]) => name === "fillRect" && x === 40.5 && y === 30.5), "the cell ahead is marked");
  assert.ok(calls.some(([name, x, y]) => name === "roundRect" && x === 41 && y === 31), "the cell spoken of is framed");
});

/** A session whose metrics are seen, with a service that answers what it is given. */
function judging(answers, { tick: at = 0, paused = false } = {}) {
  const asked = [];
  const clock = { now: 0 };
  const http = async (path) => {
    asked.push(path);
    return Response.json(answers.shift());
  };
  const store = createStore(reduce, INITIAL);
  const loader = new RegretLoader(store, { http, now: () => clock.now, seen: () => true });
  store.dispatch({ type: "session", id: "s1" });
  store.dispatch(hello({ state: wireState({ tick: at, paused }) }));
  const live = async () => {
    store.dispatch({ type: "phase", phase: { phase: "live" } });
    for (let turn = 0; turn < 6; turn += 1) await settle();
  };
  const ticks = (from, to) => {
    for (let each = from; each <= to; each += 1) store.dispatch(tick({ tick: each, decision: { tick: each - 1, move: "forward", blocked: [{}] } }));
  };
  return { store, loader, asked, clock, live, ticks, regret: () => store.state().regret };
}

test("losses are asked for in stretches while the clock runs, and at once when it stands", async () => {
  const item = (at) => ({ tick: at, blocked: 1, ticks: 1, lost: false });
  const first = { from: 0, now: 8, items: [0, 1, 2].map(item), more: false };
  const { loader, asked, clock, live, ticks, regret } = judging([first, { from: 8, now: 16, items: [8, 9].map(item), more: false }]);
  ticks(1, 7);
  await live();
  assert.deepEqual(asked, [], "not for so few");
  ticks(8, 8);
  for (let turn = 0; turn < 6; turn += 1) await settle();
  assert.deepEqual(asked, ["/api/v1/sessions/s1/regret?from=0&limit=60"]);
  assert.deepEqual(sumOf(regret(), 8), { ticks: 3, known: 3, lost: false });
  assert.equal(regret().items.get(3), null);
  assert.equal(missingFrom(regret(), 8), null);
  ticks(9, 16);
  await settle();
  assert.equal(asked.length, 1, "too soon after the last");
  clock.now = 5_000;
  await loader.fill();
  assert.match(asked[1], /from=8/);
  const stands = judging([{ from: 0, now: 4, items: [], more: false }], { tick: 4, paused: true });
  await stands.live();
  assert.equal(stands.asked.length, 1);
});

test("what a run was is forgotten when it becomes another", async () => {
  const { store, live, regret } = judging(
    [{ from: 0, now: 2, items: [{ tick: 0, blocked: 0, ticks: 5, lost: false }], more: false }, { from: 0, now: 2, items: [], more: false }],
    { tick: 2, paused: true },
  );
  const going = live();
  const changes = [{ path: "potholes", before: 1, after: 2 }];
  store.dispatch({ type: "changed", sequence: 101, text: null, reply: "Done.", changes, events: [], state: wireState({ tick: 2, paused: true, undo: 1 }) });
  assert.equal(regret().age, 1);
  await going;
  assert.deepEqual([...regret().items], [[0, null], [1, null]], "what was told of the run that is no more is asked for again");
});

test("of a long run the latest is kept", () => {
  const { ticks, regret } = judging([]);
  ticks(1, 3_000);
  assert.ok(regret().items.size <= 1_000);
  assert.ok(regret().items.has(2_999 - WINDOW));
});

test("the road is told a lane a sentence, the nearest first", () => {
  const world = worldOf(wireState({ hazards: [{ id: "pothole-1", kind: "pothole", cell: [4, 17] }, { id: "barrier-1", kind: "barrier", cell: [4, 19] }, { id: "pothole-2", kind: "pothole", cell: [4, 2] }] }));
  const lines = roadWords(world, { tick: 9, move: "left" });
  assert.equal(lines.length, 9);
  assert.equal(lines[0], "Tick 10. The vehicle is in lane 5 of 8, 20 rows from the destination. Its last move: left.");
  assert.equal(lines[5], "Lane 5, its own: a barrier 1 row ahead; a pothole 3 rows ahead.");
  assert.equal(lines[3], "Lane 3: a car 1 row ahead, heading right.");
  assert.equal(lines[1], "Lane 1: free as far as is seen.");
});

test("a picture of the service's has its tick; what is none is told from it", async () => {
  const data = new Uint8Array([0x52, 0x54, 1, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 44, 9, 8, 7]);
  new DataView(data.buffer).setFloat32(4, 0.5);
  const { tick: at, phase, picture } = pictureOf(data.buffer);
  assert.deepEqual([at, phase, picture.type, picture.size], [300, 0.5, "image/webp", 3]);
  assert.equal(pictureOf(data.buffer.slice(0, 16)), null);
  data[2] = 9;
  assert.equal(pictureOf(data.buffer), null);
});
