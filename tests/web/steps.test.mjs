import assert from "node:assert/strict";
import { test } from "node:test";

import { INITIAL, reduce } from "../../web/src/core/state.js";
import { NO_STEPS, standingOf, stepsAfter } from "../../web/src/core/undoStack.js";
import { hello, wireState } from "./fakes.mjs";

const changed = (sequence, undo) => ({
  type: "changed", sequence, text: null, reply: "", changes: [], events: [], state: wireState({ undo }),
});
const after = (...events) => events.reduce(reduce, reduce(INITIAL, hello())).steps;

test("each change knows how many undos take it back", () => {
  const steps = after(changed(1, 1), changed(2, 1), changed(3, 2)); // the second was a pause: no step
  assert.deepEqual(standingOf(steps, 3), { undos: 1, taken: false });
  assert.deepEqual(standingOf(steps, 1), { undos: 2, taken: false });
  assert.deepEqual(standingOf(steps, 2), { undos: 0, taken: false });
  assert.deepEqual(standingOf(steps, undefined), { undos: 0, taken: false });
});

test("what was taken back says so, and what comes instead is another change", () => {
  const steps = after(changed(1, 1), changed(2, 2), changed(3, 0), changed(4, 1));
  assert.deepEqual([1, 2, 4].map((each) => standingOf(steps, each)), [
    { undos: 0, taken: true },
    { undos: 0, taken: true },
    { undos: 1, taken: false },
  ]);
});

test("changes from before the page came are counted, though not known", () => {
  const first = reduce(INITIAL, hello({ state: wireState({ undo: 5 }) }));
  const steps = reduce(first, changed(9, 6)).steps;
  assert.deepEqual(standingOf(steps, 9), { undos: 1, taken: false });
  assert.equal(stepsAfter(steps, 2, 10).done.length, 2);
});

test("a state after missed messages brings the count, and names no change wrongly", () => {
  const steps = stepsAfter(stepsAfter(NO_STEPS, 1, 1), 3, null);
  assert.deepEqual(standingOf(steps, 1), { undos: 3, taken: false });
});
