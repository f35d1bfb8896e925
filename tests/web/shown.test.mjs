import assert from "node:assert/strict";
import { test } from "node:test";

import { INITIAL, reduce } from "../../web/src/core/state.js";
import { shownBy } from "../../web/src/talk/shown.js";
import { hello } from "./fakes.mjs";

const CAUSE = { id: "vehicle-1", kind: "vehicle", cell: [2, 19], role: "blocks" };

/** @param {object} answer */
const told = (answer) => ({ type: "result", id: "1", result: { text: "why", actions: [], changes: [], reply: "So.", answer, source: "grammar", sequence: 3, corrections: [], dry_run: false } });

const after = (...events) => events.reduce(reduce, INITIAL);

test("an answer points at its causes, and at all that it says is to be shown", () => {
  assert.deepEqual(shownBy({ causes: [CAUSE] }), { ids: ["vehicle-1"], cells: [[2, 19]] });
  assert.deepEqual(shownBy({ causes: [CAUSE], shown: { ids: ["a", "b"], cells: [] } }), { ids: ["a", "b"], cells: [] });
  assert.equal(shownBy({ causes: [] }), null);
  assert.equal(shownBy(null), null);
});

test("what an answer points at is highlighted when it comes, until something else is said", () => {
  const answered = after(hello(), told({ about: "why", text: "So.", tick: 9, causes: [CAUSE] }));
  assert.deepEqual(answered.highlight, { ids: ["vehicle-1"], cells: [[2, 19]] });
  const said = reduce(answered, { type: "said", id: "2", text: "what do you see" });
  assert.equal(said.highlight, null);
});

test("an answer without causes leaves the highlight as it is", () => {
  const pointing = after(hello(), { type: "highlight", highlight: { ids: ["pothole-1"], cells: [] } });
  const answered = reduce(pointing, told({ about: "status", text: "Here.", tick: 9, causes: [] }));
  assert.deepEqual(answered.highlight, { ids: ["pothole-1"], cells: [] });
});
