import assert from "node:assert/strict";
import { test } from "node:test";

import { changeWords, clock, markWords, percent, plain, reasonWords, valueWords } from "../../web/src/core/words.js";

const marked = (sentence, words) =>
  markWords(sentence, words)
    .map(({ text, marked }) => (marked ? `[${text}]` : text))
    .join("");

test("words not understood are marked where they stand", () => {
  assert.equal(marked("add five potholes and order pizza", ["order", "pizza"]), "add five potholes and [order] [pizza]");
  assert.equal(marked("Order PIZZA!", ["order", "pizza"]), "[Order] [PIZZA]!");
  assert.equal(marked("make me a sandwich", ["make me a sandwich"]), "[make me a sandwich]");
});

test("only whole words, and each at its own place", () => {
  assert.equal(marked("cart a car", ["car"]), "cart a [car]");
  assert.equal(marked("dig and dig", ["dig", "dig"]), "[dig] and [dig]");
  assert.equal(marked("b then a", ["a", "b"]), "[b] then [a]");
  assert.equal(marked("don't fly", ["don't"]), "[don't] fly");
});

test("words that are not there, or empty, mark nothing and nothing is lost", () => {
  assert.equal(marked("add five potholes", ["pizza", ""]), "add five potholes");
  assert.equal(marked("", ["a"]), "");
  for (const words of [["a", "a b"], ["b", "a b c"], ["c", "c"]]) {
    assert.equal(markWords("a b c", words).map(({ text }) => text).join(""), "a b c");
  }
});

test("figures and names", () => {
  assert.equal(clock(0), "0:00.0");
  assert.equal(clock(75.5), "1:15.5");
  assert.equal(clock(59.96), "1:00.0");
  assert.equal(percent(null), "–");
  assert.equal(percent(0.9784), "98 %");
  assert.equal(plain("success_rate"), "success rate");
  assert.equal(reasonWords("mover_enters"), "a car moves in");
  assert.equal(reasonWords("too_risky"), "too risky");
  assert.deepEqual([4, 0.15, true, null, "forward_left"].map(valueWords), ["4", "0.15", "on", "not set", "forward left"]);
});

test("changes are told in words, lists and names of the wire's own too", () => {
  const said = (path, before, after) => Object.values(changeWords({ path, before, after })).join(" | ");
  assert.equal(said("potholes", 2, 7), "potholes | 2 | 7");
  assert.equal(said("queue", [], ["right", "forward_left"]), "next moves | none | right, forward left");
  assert.equal(said("mode", "auto", "manual"), "driver | itself | you");
  assert.equal(said("playback_speed", 1, "max"), "playback speed | 1× | max");
  assert.equal(said("config.planner", "priority", "astar"), "planner | Priority rules | A*");
  assert.equal(said("config.preferences", ["avoid_potholes", "smooth_ride"], []), "preferences | avoid potholes, smooth ride | none");
  assert.equal(said("config.traffic", null, "none"), "traffic | not set | none");
  assert.equal(said("config.spawn_probability", 0.68, 0.9), "spawn probability | 0.68 | 0.9");
  assert.equal(said("config.solvable", false, true), "solvable | off | on");
  assert.equal(said("config.rows", 30, 400), "length | 30 rows | 400 rows");
  assert.equal(said("config.of_tomorrow", ["a_b"], null), "of tomorrow | a b | not set");
});
