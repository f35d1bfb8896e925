import assert from "node:assert/strict";
import { test } from "node:test";

import { byLoudness, marksIn, markWords, nextMark, spanOf } from "../../web/src/timeline/timelineEvents.js";
import { INITIAL, reduce } from "../../web/src/core/state.js";
import { Chart } from "../../web/src/timeline/runChart.js";
import { hello, logEvent, metrics, tick, wireState } from "./fakes.mjs";

const opened = () => reduce(INITIAL, hello());
const after = (state, ...messages) => messages.reduce(reduce, state);
const changed = (changes = {}) => ({
  type: "changed", sequence: 101, text: null, reply: "Done.", changes: [], events: [], state: wireState({ sequence: 101 }), ...changes,
});

test("each tick heard is a letter, and missed ones are known to be missing", () => {
  const stay = { tick: 11, move: "stay" };
  const state = after(opened(), tick(), tick({ tick: 12, decision: stay }), { type: "state", missed: [13, 14], state: wireState({ tick: 14 }) });
  assert.deepEqual([state.course.from, state.course.letters], [10, "Fs??"]);
  const held = after(state, tick({ tick: 15, decision: null, status: "crash" }));
  assert.equal(held.course.letters, "Fs??-");
});

test("what comes into the cell just left is a near miss, what passes elsewhere is none", () => {
  const near = after(opened(), tick({ moved: { "vehicle-1": [4, 20] } }));
  assert.deepEqual(near.course.marks, [{ tick: 11, kind: "near_miss", ids: ["vehicle-1"] }]);
  assert.deepEqual(after(opened(), tick({ moved: { "vehicle-1": [5, 20] } })).course.marks, []);
  const stayed = tick({ vehicles: { "av-1": [4, 20] }, moved: { "vehicle-1": [4, 20] }, decision: { tick: 10, move: "stay" } });
  assert.deepEqual(after(opened(), stayed).course.marks, []);
});

test("ends and beginnings are marked once", () => {
  const crash = tick({ status: "crash", moved: {}, events: [logEvent(1, { ids: ["vehicle-1"] })] });
  const held = tick({ tick: 12, status: "crash", decision: null, moved: {} });
  const next = tick({ tick: 13, episode: 2, decision: null, state: wireState({ tick: 13, episode: 2 }) });
  const { marks } = after(opened(), crash, held, next).course;
  assert.deepEqual(marks, [{ tick: 11, kind: "crash", ids: ["vehicle-1"] }, { tick: 13, kind: "episode" }]);
});

test("only what may have rewritten the past raises the edition", () => {
  const state = after(opened(), tick());
  const { edition } = state.course;
  const paused = changed({ changes: [{ path: "paused", before: false, after: true }], state: wireState({ tick: 11 }) });
  assert.equal(after(state, paused).course.edition, edition);
  assert.equal(after(state, changed({ sequence: 100, state: wireState({ tick: 11 }) })).course.edition, edition);
  const more = changed({ sequence: 102, changes: [{ path: "potholes", before: 1, after: 2 }], state: wireState({ tick: 11 }) });
  assert.equal(after(state, more).course.edition, edition + 1);
});

test("going back takes away what came after, and before the stream began there is nothing to keep", () => {
  const state = after(opened(), tick({ moved: { "vehicle-1": [4, 20] } }), tick({ tick: 12, decision: { tick: 11, move: "left" } }));
  const back = after(state, changed({ sequence: 102, changes: [{ path: "tick", before: 12, after: 10 }], state: wireState({ tick: 10 }) }));
  assert.deepEqual([back.course.letters, back.course.marks], ["", []]);
  assert.equal(back.course.edition, state.course.edition + 1);
  const further = after(state, changed({ sequence: 102, changes: [{ path: "tick", before: 12, after: 4 }], state: wireState({ tick: 4 }) }));
  assert.deepEqual([further.course.from, further.course.letters], [4, ""]);
});

test("a chart is filled from both ends and knows what is missing", () => {
  const chart = new Chart();
  chart.arrive(1_200);
  chart.write(1_198, "F?");
  assert.deepEqual(chart.gap(500), { from: 1_199, limit: 1 });
  chart.write(1_199, "F");
  assert.deepEqual(chart.gap(500), { from: 698, limit: 500 });
  chart.write(698, "F".repeat(500));
  chart.write(198, "F".repeat(500));
  assert.deepEqual(chart.gap(500), { from: 0, limit: 198 });
  chart.write(0, "F".repeat(198));
  assert.equal(chart.gap(500), null);
  chart.forget(600);
  assert.deepEqual(chart.gap(1_000), { from: 600, limit: 600 });
});

test("waits and detours are stretches, and a jump finds the nearest on either side", () => {
  const chart = new Chart();
  chart.write(0, "FFsssFlLFs-");
  chart.mark([{ tick: 10, kind: "success" }, { tick: 0, kind: "episode" }]);
  const marks = chart.marks();
  assert.deepEqual(
    marks.map(({ tick, kind, ticks }) => [tick, kind, ticks]),
    [[0, "episode", undefined], [2, "wait", 3], [6, "detour", 2], [9, "wait", 1], [10, "success", undefined]],
  );
  assert.equal(nextMark(marks, ["wait"], 9, -1)?.tick, 2);
  assert.equal(nextMark(marks, ["wait"], 2, 1)?.tick, 9);
  assert.equal(nextMark(marks, ["crash"], 0, 1), null);
  assert.deepEqual(marksIn(marks, 4, 4).map(({ tick }) => tick), [2]);
  assert.deepEqual(byLoudness(marksIn(marks, 9, 10)).map(({ kind }) => kind), ["success", "wait"]);
});

test("the present going back takes marks along, but not what was forked from there", () => {
  const chart = new Chart();
  chart.write(0, "F".repeat(100));
  chart.mark([{ tick: 80, kind: "crash" }, { tick: 90, kind: "fork", session: "b" }, { tick: 20, kind: "near_miss" }]);
  chart.arrive(50);
  assert.equal(chart.now, 50);
  assert.deepEqual(chart.marks().map(({ tick }) => tick), [20, 90]);
  chart.write(50, "ss");
  assert.deepEqual([chart.letter(49), chart.letter(51), chart.letter(60)], ["F", "s", ""]);
});

test("marks in words; a near miss says what is meant", () => {
  assert.equal(markWords({ tick: 1, kind: "crash", ids: ["vehicle-3"] }), "Crash with vehicle 3");
  assert.match(markWords({ tick: 1, kind: "near_miss", ids: ["pedestrian-2"] }), /pedestrian 2 moved into the cell just left/);
  assert.equal(markWords({ tick: 1, kind: "wait", ticks: 4 }), "Waits for 4 ticks");
  assert.equal(markWords({ tick: 1, kind: "command", text: "add a cone" }), "“add a cone”");
});

test("the line grows in steps, so that it does not crawl", () => {
  assert.deepEqual([0, 64, 65, 100, 101, 1_000, 9_999].map(spanOf), [64, 64, 80, 100, 125, 1_000, 10_000]);
  let changes = 0;
  for (let now = 1; now < 5_000; now += 1) changes += spanOf(now) === spanOf(now - 1) ? 0 : 1;
  assert.ok(changes < 25);
});

test("ten thousand ticks are read in a blink", () => {
  const chart = new Chart();
  const began = performance.now();
  for (let from = 0; from < 10_000; from += 500) chart.write(from, "FFFFslFFFs".repeat(50));
  for (let round = 0; round < 20; round += 1) {
    chart.write(10_000 + round, "F");
    chart.marks();
  }
  assert.ok(performance.now() - began < 500);
  assert.deepEqual(metrics().steps, 10);
});
