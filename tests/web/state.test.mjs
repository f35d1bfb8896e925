import assert from "node:assert/strict";
import { test } from "node:test";

import { INITIAL, reduce, sceneOf } from "../../web/src/core/state.js";
import { shown } from "../../web/src/talk/exchanges.js";
import { countTexts, describe, egoOf, toGo } from "../../web/src/road/world.js";
import { hello, logEvent, tick, wireState } from "./fakes.mjs";

const after = (...events) => events.reduce(reduce, INITIAL);

/** Freeze deeply, so that a reducer that changes its input throws. */
function frozen(value) {
  if (value && typeof value === "object" && !Object.isFrozen(value)) {
    Object.freeze(value);
    Object.values(value).forEach(frozen);
  }
  return value;
}

test("hello brings the whole road", () => {
  const { world, session } = after(hello());
  assert.equal(session, "s1");
  assert.equal(world.things.size, 4);
  assert.deepEqual(egoOf(world).cell, [4, 20]);
  assert.deepEqual(toGo(world), { rows: 20, metres: 100 });
  assert.deepEqual(countTexts(world), ["1 pothole", "1 car", "1 pedestrian"]);
  assert.match(describe(world), /8 lanes and 30 rows.*1 pothole.*lane 5, 20 rows from/);
});

test("a tick moves what it names and nothing else", () => {
  const before = after(hello());
  const { world, decision, narration } = reduce(before, tick({ turned: { "pedestrian-1": "right" } }));
  assert.deepEqual(world.things.get("vehicle-1").cell, [3, 19]);
  assert.deepEqual(world.things.get("av-1").cell, [4, 19]);
  assert.deepEqual(world.things.get("pedestrian-1"), { ...before.world.things.get("pedestrian-1"), heading: "right" });
  assert.equal(world.things.get("pothole-1"), before.world.things.get("pothole-1"));
  assert.deepEqual([world.tick, world.timeS, world.metrics.steps], [11, 5.5, 11]);
  assert.equal(decision.move, "forward");
  assert.equal(narration, "Forward: the way is free.");
  assert.deepEqual(before.world.things.get("vehicle-1").cell, [2, 19], "the state before is untouched");
});

test("ticks applied one by one come to the state the service would send", () => {
  const { world } = after(hello(), tick());
  const told = after(
    hello({
      state: wireState({
        tick: 11,
        time_s: 5.5,
        vehicles: [{ id: "av-1", kind: "av", cell: [4, 19] }],
        movers: [{ ...wireState().movers[0], cell: [3, 19] }, wireState().movers[1]],
        metrics: tick().metrics,
      }),
    }),
  ).world;
  assert.deepEqual(world, told);
});

test("a crash keeps its cause until the next episode's road", () => {
  const crash = logEvent(5, { ids: ["av-1", "vehicle-1"], cell: [4, 19], text: "Crashed into vehicle-1." });
  const crashed = after(hello(), tick({ status: "crash", events: [crash] }));
  assert.deepEqual(crashed.world.cause, { ids: ["av-1", "vehicle-1"], cell: [4, 19] });
  assert.equal(crashed.announcement, "Crashed into vehicle-1.");
  const waiting = reduce(crashed, tick({ tick: 12, status: "crash", decision: null, narration: null }));
  assert.deepEqual(waiting.world.cause, crashed.world.cause);
  const next = reduce(waiting, tick({ tick: 15, episode: 2, state: wireState({ tick: 15, episode: 2 }) }));
  assert.equal(next.world.cause, null);
  assert.equal(next.world.episode, 2);
});

test("a mover that fell into a pothole is disabled", () => {
  const { world } = after(hello(), tick({ events: [logEvent(1, { type: "disabled", ids: ["vehicle-1"] })] }));
  assert.equal(world.things.get("vehicle-1").disabled, true);
});

test("ticks before a road, unknown types and things that are not there change nothing", () => {
  assert.equal(reduce(INITIAL, tick()), INITIAL);
  const state = after(hello());
  assert.equal(reduce(state, { type: "unknown" }), state);
  assert.equal(reduce(state, tick({ moved: { "vehicle-99": [0, 0] } })).world.things.size, 4);
});

test("no reducer changes what it is given", () => {
  let state = frozen({ ...INITIAL });
  const events = [
    { type: "session", id: "s1" },
    { type: "phase", phase: { phase: "live" } },
    hello(),
    { type: "said", id: "c1", text: "add five potholes", quiet: false },
    { type: "result", id: "c1", result: { reply: "Done.", changes: [] } },
    { type: "changed", sequence: 102, text: "x", reply: "y", changes: [], events: [], state: wireState() },
    tick(),
    { type: "said", id: "c2", text: "what", quiet: false },
    { type: "phase", phase: { phase: "lost", retryMs: 400 } },
    { type: "highlight", highlight: { ids: [], cells: [] } },
    { type: "trouble", text: "no" },
  ];
  for (const event of events) state = frozen({ ...reduce(state, frozen(event)) });
  assert.equal(state.talk.length, 2);
});

test("an exchange runs from said to answered, and only its own", () => {
  const said = (id, text) => ({ type: "said", id, text, quiet: false });
  const result = { reply: "Added 5 potholes.", changes: [{ path: "potholes", before: 4, after: 9 }] };
  const problem = { type: "/problems/not-understood", title: "?", status: 422, detail: "I did not understand “pizza”." };
  const { talk, announcement } = after(
    said("c1", "add five potholes"),
    said("c2", "order pizza"),
    { type: "result", id: "c1", result },
    { type: "problem", id: "c2", problem },
  );
  assert.deepEqual(talk.map(({ standing }) => standing), ["done", "refused"]);
  assert.equal(talk[0].result.reply, "Added 5 potholes.");
  assert.equal(talk[1].problem, problem);
  assert.equal(announcement, problem.detail);
});

test("a lost connection settles what was pending as unknown, an unsent command as refused", () => {
  const { talk } = after(
    { type: "said", id: "c1", text: "a", quiet: false },
    { type: "phase", phase: { phase: "lost", retryMs: 400 } },
    { type: "said", id: "c2", text: "b", quiet: false },
    { type: "unsent", id: "c2" },
  );
  assert.deepEqual(talk.map(({ standing }) => standing), ["unknown", "refused"]);
});

test("buttons are listed only when they changed something or were refused", () => {
  const quiet = (id, part) => [{ type: "said", id, text: id, quiet: true }, { id, ...part }];
  const { talk } = after(
    ...quiet("pause", { type: "result", result: { reply: "Paused.", changes: [{ path: "paused", before: false, after: true }] } }),
    ...quiet("undo", { type: "result", result: { reply: "Undone.", changes: [{ path: "potholes", before: 9, after: 4 }] } }),
    ...quiet("redo", { type: "problem", problem: { detail: "Nothing to redo." } }),
  );
  assert.deepEqual(shown(talk).map(({ id }) => id), ["undo", "redo"]);
});

test("another session starts from nothing", () => {
  const state = after(hello(), tick(), { type: "session", id: "s2" });
  assert.deepEqual(state, { ...INITIAL, session: "s2" });
});

test("an earlier tick is shown while the present goes on", () => {
  const first = after(hello());
  const past = { world: first.world, decision: null, narration: "then" };
  const later = frozen([tick(), tick({ tick: 12 })].reduce(reduce, reduce(first, { type: "past", past })));
  const scene = sceneOf(later);
  assert.equal(later.world.tick, 12);
  assert.deepEqual([scene.world.tick, scene.narration], [10, "then"]);
  assert.equal(sceneOf(reduce(later, { type: "highlight", highlight: null })).world, scene.world, "not drawn anew");
  assert.equal(sceneOf(reduce(later, { type: "past", past: null })).world, later.world);
});

test("a session of older rules is told of when it is opened, and not with each connection", () => {
  const note = "Made under rules 1: it replays as it did then.";
  const old = hello();
  old.session.rules_note = note;
  const state = after(old);
  assert.deepEqual([state.notice, state.announcement], [{ text: note }, note]);
  const later = [{ type: "notice", notice: null }, old].reduce(reduce, state);
  assert.equal(later.notice, null);
  assert.equal(after(hello()).notice, null);
});
