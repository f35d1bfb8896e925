import assert from "node:assert/strict";
import { test } from "node:test";

import { LOG_LINES, logChange, logEvents, logJump, logTick } from "../../web/src/talk/journal.js";
import { logEvent, tick, wireState } from "./fakes.mjs";

const at = (number, narration) =>
  tick({ tick: number + 1, sequence: number, decision: { tick: number, move: "forward" }, narration });

test("ticks that say the same share a line, until something else is said", () => {
  let log = [];
  for (const number of [4, 5, 6]) log = logTick(log, at(number, "Forward."));
  log = logTick(log, at(7, "Left."));
  log = logTick(log, at(8, "Forward."));
  assert.deepEqual(log.map(({ from, to, text }) => [from, to, text]), [[4, 6, "Forward."], [7, 7, "Left."], [8, 8, "Forward."]]);
});

test("ticks that were missed break the line", () => {
  const log = logTick(logTick([], at(4, "Forward.")), at(9, "Forward."));
  assert.deepEqual(log.map(({ from, to }) => [from, to]), [[4, 4], [9, 9]]);
});

test("keys are unique, also when ticks run again after an undo", () => {
  let log = [];
  for (const number of [4, 5]) log = logTick(log, at(number, `a${number}`));
  log = logTick(log, { ...at(4, "a4"), sequence: 90 });
  assert.equal(new Set(log.map(({ key }) => key)).size, log.length);
});

test("events are written once, however often they are sent", () => {
  const events = [logEvent(1), logEvent(2)];
  const log = logEvents(logEvents([], events), [...events, logEvent(3)]);
  assert.deepEqual(log.map(({ number }) => number), [1, 2, 3]);
});

test("a move is told by its tick, not twice", () => {
  const log = logTick([], { ...at(4, "Forward."), events: [logEvent(1, { type: "moved" })] });
  assert.equal(log.length, 1);
});

test("a change is one loud line and its own event is not repeated, now or after a reconnect", () => {
  const edited = logEvent(7, { type: "edited", text: "Added 5 potholes." });
  const disabled = logEvent(8, { type: "disabled", text: "vehicle-1 is disabled." });
  const message = {
    sequence: 120,
    text: "add five potholes",
    reply: "Added 5 potholes.",
    changes: [{ path: "potholes", before: 4, after: 9 }],
    events: [edited, disabled],
    state: wireState(),
  };
  const log = logChange([], message);
  assert.deepEqual(log.map(({ tone, said, text }) => [tone, said, text]), [
    ["change", "add five potholes", "Added 5 potholes."],
    ["event", undefined, "vehicle-1 is disabled."],
  ]);
  assert.equal(logEvents(log, [edited, disabled]), log);
});

test("what happened on the way of a long step is told before where it has led", () => {
  const arrived = logEvent(3, { tick: 4, type: "arrived", text: "Reached the goal." });
  const held = logEvent(4, { tick: 10, type: "disabled", text: "vehicle-1 is disabled." });
  const message = { sequence: 1, text: "advance 10 ticks", reply: "Advanced 10 ticks.", changes: [{ path: "tick", before: 0, after: 10 }], events: [arrived, held], state: wireState() };
  assert.deepEqual(logChange([], message).map(({ text }) => text), ["Reached the goal.", "Advanced 10 ticks.", "vehicle-1 is disabled."]);
});

test("what is found out about a road is one line, in the reply of a change or by itself", () => {
  const closed = logEvent(5, { type: "no_way", text: "There is no way through." });
  const message = {
    sequence: 3,
    text: "add a wall",
    reply: "Added 3 barriers. There is no way through.",
    changes: [{ path: "barriers", before: 0, after: 3 }],
    events: [closed],
    state: wireState(),
  };
  const log = logChange([], message);
  assert.deepEqual(log.map(({ text }) => text), [message.reply]);
  assert.equal(logEvents(log, [closed]), log);
  const later = logChange(log, { ...message, text: null, reply: closed.text, changes: [], events: [logEvent(6, { ...closed, number: 6 })] });
  assert.deepEqual(later.map(({ type, text }) => [type, text]), [["change", message.reply], ["no_way", closed.text]]);
});

test("pausing is a quiet note, stepping is told by its ticks alone", () => {
  const base = { text: null, events: [logEvent(9, { type: "changed" })], state: wireState() };
  const paused = [{ path: "paused", before: false, after: true }];
  const [note] = logChange([], { ...base, sequence: 1, reply: "Paused.", changes: paused });
  assert.deepEqual([note.tone, note.text], ["note", "Paused."]);
  const ticked = logTick([], at(4, "Forward."));
  const stepped = [{ path: "tick", before: 4, after: 5 }];
  const log = logChange(ticked, { ...base, sequence: 2, reply: "Advanced 1 tick.", changes: stepped });
  assert.deepEqual(log.map(({ text }) => text), ["Forward."]);
  assert.equal(logEvents(log, base.events), log);
});

test("the log does not grow for ever", () => {
  let log = [];
  for (let number = 0; number < LOG_LINES + 50; number++) log = logTick(log, at(number, `say ${number}`));
  assert.equal(log.length, LOG_LINES);
  assert.equal(log.at(-1).text, `say ${LOG_LINES + 49}`);
});

test("what a leap back has taken is marked, and counts again when that is undone", () => {
  let log = [];
  for (const number of [3, 4, 5, 6]) log = logTick(log, at(number, `say ${number}`));
  const driven = { log, world: { tick: 7 }, steps: { done: [1, 2], gone: [] } };
  const back = logJump(driven, { tick: 5, undo: 3 });
  assert.deepEqual(back.map(({ gone }) => gone ?? false), [false, false, true, true], "the decision of tick 5 is not taken any more");
  assert.equal(logJump({ ...driven, log: back, world: { tick: 5 } }, { tick: 40, undo: 3 }), back, "a long step brings nothing back");
  const again = logJump({ ...driven, log: back, world: { tick: 5 } }, { tick: 7, undo: 1 });
  assert.deepEqual(again.map(({ gone }) => gone ?? false), [false, false, false, false]);
});
