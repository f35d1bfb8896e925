import assert from "node:assert/strict";
import { test } from "node:test";

import { foresee, guide, previewWords } from "../../web/src/talk/language.js";
import { Latest, newestOnly } from "../../web/src/core/latest.js";
import { rank } from "../../web/src/talk/palette.js";

/** A clock that is moved by hand, and answers that come when they are told to. */
function asking() {
  const timers = new Map();
  const answers = new Map();
  const told = [];
  let next = 1;
  let most = 0;
  const latest = new Latest({
    pauseMs: 100,
    ask: (text) =>
      new Promise((done, fail) => {
        answers.set(text, { done, fail });
        most = Math.max(most, answers.size);
      }),
    tell: (answer, text) => told.push([text, answer]),
    later: (run) => (timers.set(next, run), next++),
    never: (timer) => timers.delete(timer),
  });
  const turn = () => new Promise((done) => setImmediate(done));
  return {
    latest,
    told,
    asked: () => [...answers.keys()],
    most: () => most,
    async rest() {
      const due = [...timers.values()];
      timers.clear();
      for (const run of due) run();
      await turn();
    },
    async answer(text, value) {
      const { done, fail } = answers.get(text);
      answers.delete(text);
      if (value instanceof Error) fail(value);
      else done(value);
      await turn();
    },
  };
}

test("of questions that overtake one another only the newest is answered", () => {
  const asking = newestOnly();
  const first = asking();
  assert.ok(first());
  const second = asking();
  assert.ok(!first());
  assert.ok(second());
});

test("only what stands when the typing rests is asked", async () => {
  const { latest, asked, rest } = asking();
  for (const text of ["a", "ad", "add"]) latest.want(text);
  assert.deepEqual(asked(), []);
  await rest();
  assert.deepEqual(asked(), ["add"]);
});

test("one question at a time, and only the newest answer is told", async () => {
  const { latest, asked, rest, answer, told, most } = asking();
  latest.want("add");
  await rest();
  latest.want("add f");
  await rest();
  latest.want("add five");
  await rest();
  assert.deepEqual(asked(), ["add"], "the first is still being answered");
  await answer("add", 1);
  assert.deepEqual([asked(), told], [["add five"], []]);
  await answer("add five", 2);
  assert.deepEqual(told, [["add five", 2]]);
  assert.equal(most(), 1);
});

test("nothing is told once it is dropped, or where the answer fails, and asking goes on", async () => {
  const { latest, rest, answer, told } = asking();
  latest.want("a");
  await rest();
  latest.drop();
  await answer("a", 1);
  latest.want("b");
  await rest();
  await answer("b", new Error("no connection"));
  assert.deepEqual(told, []);
  latest.want("c");
  await rest();
  await answer("c", 3);
  assert.deepEqual(told, [["c", 3]]);
});

test("what has been typed is asked about in its session, safely written", async () => {
  const urls = [];
  const http = async (url) => (urls.push(url), Response.json({ completions: [], preview: null }));
  await foresee("add 5 & more?", "s/1", http);
  await guide(http);
  assert.deepEqual(urls, [
    "/api/v1/language?prefix=add+5+%26+more%3F&session=s%2F1&language=en",
    "/api/v1/language?language=en",
  ]);
  await assert.rejects(foresee("x", "s", async () => new Response("", { status: 503 })), /503/);
});

test("what is longer than the service reads is not asked about, and told", async () => {
  let asked = 0;
  const http = async () => (asked++, Response.json({ completions: [], preview: null }));
  assert.equal((await foresee("x".repeat(500), "s", http)).preview, null);
  assert.equal((await foresee("\u{1f697}".repeat(500), "s", http)).preview, null);
  assert.equal(asked, 2);
  const { completions, preview } = await foresee("x".repeat(501), "s", http);
  assert.equal(asked, 2);
  assert.deepEqual(completions, []);
  assert.equal(previewWords(preview), "Too long: at most 500 letters are read");
});

const preview = (part) => ({ standing: "does", actions: [], changes: [], detail: null, unparsed: [], ...part });
const change = (path, before, after) => ({ path, before, after });

test("a preview says what would change, and never more than it knows", () => {
  assert.equal(previewWords(null), "");
  assert.equal(previewWords(preview({ changes: [change("potholes", 5, 10)] })), "potholes 5 → 10");
  assert.equal(previewWords(preview({ changes: [change("paused", false, true)] })), "pauses");
  assert.equal(previewWords(preview({})), "Understood");
  assert.equal(previewWords(preview({ changes: [change("config.planner", "priority", "astar")] })), "planner Priority rules → A*");
  const many = ["potholes", "barriers", "vehicles", "pedestrians"].map((path) => change(path, 0, 1));
  assert.equal(
    previewWords(preview({ changes: [...many, change("config.columns", 8, 9)] })),
    "potholes 0 → 1 · barriers 0 → 1 · vehicles 0 → 1 · 1 more · 1 setting",
  );
  assert.equal(previewWords(preview({ standing: "asks" })), "A question: changes nothing");
  assert.equal(previewWords(preview({ standing: "not_understood", unparsed: ["fizz", "buzz"] })), "Not understood so far: “fizz buzz”");
  assert.equal(previewWords(preview({ standing: "refused", detail: "No room." })), "No room.");
});

test("the palette finds by beginnings, words and letters, in that order", () => {
  const labels = (typed) => rank(["Pause", "Step", "Show the plan", "Undo", "Use pauses"].map((label) => ({ label })), typed).map(({ label }) => label);
  assert.deepEqual(labels("pau"), ["Pause", "Use pauses"]);
  assert.deepEqual(labels("stp"), ["Step", "Show the plan"]);
  assert.deepEqual(labels("STEP")[0], "Step");
  assert.equal(labels(" ").length, 5);
  assert.deepEqual(labels("xyz"), []);
});
