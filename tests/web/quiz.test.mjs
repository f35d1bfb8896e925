// The scores of a quiz and the file of them.
import assert from "node:assert/strict";
import { test } from "node:test";

import { resultText, scaleMean, scoreOf } from "../../web/src/talk/quizResult.js";

const situation = (phase, move, reason) => ({ phase, picture: [], reasons: [], right: { move, reason }, explanation: "" });
const GIVEN = [
  { situation: situation("before", "left", "vehicle-1"), move: "left", reason: "nothing" },
  { situation: situation("before", "stay", "nothing"), move: "left", reason: "nothing" },
  { situation: situation("after", "left", "pothole-1"), move: "left", reason: "pothole-1" },
];
const QUIZ = {
  version: 1, planner: "rules", seed: 3, signs: "", phases: {}, moves: [], situations: [],
  scales: { satisfaction: [{ id: "detail", text: "", reversed: false }], trust: [{ id: "reliable", text: "", reversed: false }, { id: "wary", text: "", reversed: true }] },
  scale: { least: 1, most: 5 },
};

test("moves and reasons are counted apart, before and after", () => {
  assert.deepEqual(scoreOf(GIVEN, "before"), { count: 2, moves: 0.5, reasons: 0.5, both: 0 });
  assert.deepEqual(scoreOf(GIVEN, "after"), { count: 1, moves: 1, reasons: 1, both: 1 });
});

test("who agrees to be wary trusts less", () => {
  assert.equal(scaleMean(QUIZ, "trust", { trust: { reliable: 5, wary: 5 } }), 3);
  assert.equal(scaleMean(QUIZ, "trust", { trust: { reliable: 5, wary: 1 } }), 5);
  assert.equal(scaleMean(QUIZ, "satisfaction", {}), null);
});

test("the file says what was asked, said and right", () => {
  const told = JSON.parse(resultText(QUIZ, GIVEN, { trust: { wary: 2 } }, "en"));
  assert.deepEqual(told.scores.gain, { moves: 0.5, reasons: 0.5 });
  assert.deepEqual(told.answers[0], { phase: "before", number: 1, move: "left", said_move: "left", move_right: true, reason: "vehicle-1", said_reason: "nothing", reason_right: false });
  assert.equal(told.scales.trust.mean, 4);
});
