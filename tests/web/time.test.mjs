import assert from "node:assert/strict";
import { test } from "node:test";

import { byImportance, eventsIn, eventsNear, eventText, nextEvent, spanOf } from "../../web/src/timeline/timelineEvents.js";
import { INITIAL, reduce } from "../../web/src/core/state.js";
import { allEvents, gapOf, NO_TIMELINE, nowOf, timelineAfter } from "../../web/src/timeline/timelineState.js";
import { hello, logEvent, tick, wireState } from "./fakes.mjs";

const opened = () => reduce(INITIAL, hello());
const after = (state, ...messages) => messages.reduce(reduce, state);
const changed = (changes = {}) => ({
  type: "changed", sequence: 101, text: null, reply: "Done.", changes: [], events: [], state: wireState({ sequence: 101 }), ...changes,
});

test("each tick heard is a letter, and missed ones are known to be missing", () => {
  const stay = { tick: 11, move: "stay" };
  const state = after(opened(), tick(), tick({ tick: 12, decision: stay }), { type: "state", missed: [13, 14], state: wireState({ tick: 14 }) });
  assert.equal(state.timeline.letters, `${"?".repeat(10)}Fs??`);
  const held = after(state, tick({ tick: 15, decision: null, status: "crash" }));
  assert.equal(held.timeline.letters.slice(10), "Fs??-");
});

test("what comes into the cell just left is a near miss, what passes elsewhere is none", () => {
  const near = after(opened(), tick({ moved: { "vehicle-1": [4, 20] } }));
  assert.deepEqual(near.timeline.events, [{ tick: 11, kind: "near_miss", ids: ["vehicle-1"] }]);
  assert.deepEqual(after(opened(), tick({ moved: { "vehicle-1": [5, 20] } })).timeline.events, []);
  const stayed = tick({ vehicles: { "av-1": [4, 20] }, moved: { "vehicle-1": [4, 20] }, decision: { tick: 10, move: "stay" } });
  assert.deepEqual(after(opened(), stayed).timeline.events, []);
});

test("ends and beginnings are marked once", () => {
  const crash = tick({ status: "crash", moved: {}, events: [logEvent(1, { ids: ["vehicle-1"] })] });
  const held = tick({ tick: 12, status: "crash", decision: null, moved: {} });
  const next = tick({ tick: 13, episode: 2, decision: null, state: wireState({ tick: 13, episode: 2 }) });
  const { events } = after(opened(), crash, held, next).timeline;
  assert.deepEqual(events, [{ tick: 11, kind: "crash", ids: ["vehicle-1"] }, { tick: 13, kind: "episode" }]);
});

test("only what may have rewritten the past raises the maybeChanged", () => {
  const state = after(opened(), tick());
  const { maybeChanged } = state.timeline;
  const paused = changed({ changes: [{ path: "paused", before: false, after: true }], state: wireState({ tick: 11 }) });
  assert.equal(after(state, paused).timeline.maybeChanged, maybeChanged);
  assert.equal(after(state, changed({ sequence: 100, state: wireState({ tick: 11 }) })).timeline.maybeChanged, maybeChanged);
  const more = changed({ sequence: 102, changes: [{ path: "potholes", before: 1, after: 2 }], state: wireState({ tick: 11 }) });
  assert.equal(after(state, more).timeline.maybeChanged, maybeChanged + 1);
});

test("going back takes away what came after, and before the stream began there is nothing to keep", () => {
  const state = after(opened(), tick({ moved: { "vehicle-1": [4, 20] } }), tick({ tick: 12, decision: { tick: 11, move: "left" } }));
  const back = after(state, changed({ sequence: 102, changes: [{ path: "tick", before: 12, after: 10 }], state: wireState({ tick: 10 }) }));
  assert.deepEqual([back.timeline.letters, back.timeline.events], ["?".repeat(10), []]);
  assert.equal(back.timeline.maybeChanged, state.timeline.maybeChanged + 1);
  const further = after(state, changed({ sequence: 102, changes: [{ path: "tick", before: 12, after: 4 }], state: wireState({ tick: 4 }) }));
  assert.equal(further.timeline.letters, "????");
});

const filled = (letters, events = []) => ({ ...NO_TIMELINE, letters, events });
const page = (timeline, from, moves, marks = []) => timelineAfter(timeline, { type: "timeline-page", version: timeline.version, from, moves, marks }, opened().world);

test("a timeline is filled from both ends and knows what is missing", () => {
  let timeline = page(filled("?".repeat(1_200)), 1_198, "F");
  assert.deepEqual(gapOf(timeline, 500), { from: 1_199, limit: 1 });
  timeline = page(timeline, 1_199, "F");
  assert.deepEqual(gapOf(timeline, 500), { from: 698, limit: 500 });
  timeline = page(page(timeline, 698, "F".repeat(500)), 198, "F".repeat(500));
  assert.deepEqual(gapOf(timeline, 500), { from: 0, limit: 198 });
  timeline = page(timeline, 0, "F".repeat(198));
  assert.equal(gapOf(timeline, 500), null);
  const items = [{ tick: 600, sequence: 1, text: "add a pothole" }];
  const other = timelineAfter(timeline, { type: "timeline-changes", items, more: false, forks: [] }, opened().world);
  assert.deepEqual(gapOf(other, 1_000), { from: 600, limit: 600 });
});

test("a page tells nothing of what has not come yet, or of a run that is no more", () => {
  const timeline = filled("FF??");
  assert.equal(page(timeline, 2, "sssss").letters, "FFss");
  const late = { type: "timeline-page", version: timeline.version - 1, from: 2, moves: "ss", marks: [] };
  assert.equal(timelineAfter(timeline, late, opened().world), timeline);
});

test("waits and detours are stretches, and a jump finds the nearest on either side", () => {
  const events = allEvents(filled("FFsssFlLFs-", [{ tick: 10, kind: "success" }, { tick: 0, kind: "episode" }]));
  assert.deepEqual(
    events.map(({ tick, kind, ticks }) => [tick, kind, ticks]),
    [[0, "episode", undefined], [2, "wait", 3], [6, "detour", 2], [9, "wait", 1], [10, "success", undefined]],
  );
  assert.equal(nextEvent(events, ["wait"], 9, -1)?.tick, 2);
  assert.equal(nextEvent(events, ["wait"], 2, 1)?.tick, 9);
  assert.equal(nextEvent(events, ["crash"], 0, 1), null);
  assert.deepEqual(eventsIn(events, 4, 4).map(({ tick }) => tick), [2]);
  assert.deepEqual(byImportance(eventsIn(events, 9, 10)).map(({ kind }) => kind), ["success", "wait"]);
  assert.deepEqual(eventsNear(events, 4, 5), ["Waits for 3 ticks · 2 near here", "Detour of 2 ticks (tick 6)"]);
});

test("the present going back takes events along, but not what was forked from there", () => {
  const events = [{ tick: 80, kind: "crash" }, { tick: 90, kind: "fork", session: "b" }, { tick: 20, kind: "near_miss" }];
  const back = timelineAfter(filled("F".repeat(100), events), { type: "state", missed: null, state: wireState({ tick: 50 }) }, opened().world);
  assert.equal(nowOf(back), 50);
  assert.deepEqual(allEvents(back).map(({ tick }) => tick), [20, 90]);
  assert.equal(page(back, 50, "ss").letters, "F".repeat(50));
});

test("events in words; a near miss says what is meant", () => {
  assert.equal(eventText({ tick: 1, kind: "crash", ids: ["vehicle-3"] }), "Crash with a car");
  assert.match(eventText({ tick: 1, kind: "near_miss", ids: ["pedestrian-2"] }), /a pedestrian moved into the cell just left/);
  assert.equal(eventText({ tick: 1, kind: "wait", ticks: 4 }), "Waits for 4 ticks");
  assert.equal(eventText({ tick: 1, kind: "command", text: "add a cone" }), "“add a cone”");
});

test("the line grows in steps, so that it does not crawl", () => {
  assert.deepEqual([0, 64, 65, 100, 101, 1_000, 9_999].map(spanOf), [64, 64, 80, 100, 125, 1_000, 10_000]);
  let changes = 0;
  for (let now = 1; now < 5_000; now += 1) changes += spanOf(now) === spanOf(now - 1) ? 0 : 1;
  assert.ok(changes < 25);
});
