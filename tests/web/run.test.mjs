import assert from "node:assert/strict";
import { test } from "node:test";

import { noteFork } from "../../web/src/timeline/links.js";
import { Run } from "../../web/src/timeline/runStore.js";
import { NO_COURSE } from "../../web/src/timeline/runChart.js";
import { FakeClock, settle } from "./fakes.mjs";

function stage({ now = 1_200, changes = [], failing = false } = {}) {
  const clock = new FakeClock();
  const told = { asked: [], changed: 0, rewritten: 0, failures: [] };
  const service = { changes, failing };
  const kept = new Map();
  const storage = { getItem: (key) => kept.get(key) ?? null, setItem: (key, value) => kept.set(key, value) };
  const run = new Run({
    storage,
    changed: () => (told.changed += 1),
    rewritten: () => (told.rewritten += 1),
    failed: (error) => told.failures.push(error && error.message),
    later: clock.later,
    async http(path) {
      told.asked.push(path.replace("/api/v1/sessions/", ""));
      if (service.failing) return new Response(JSON.stringify({ detail: "Not now." }), { status: 503 });
      if (path.includes("/changes")) return new Response(JSON.stringify({ items: service.changes, more: false }));
      const [, from, limit] = /from=(\d+)&limit=(\d+)/.exec(path).map(Number);
      return new Response(JSON.stringify({ from, now, moves: "F".repeat(limit), marks: [{ tick: from, kind: "near_miss", ids: [] }], more: false }));
    },
  });
  const pass = async (ms) => {
    for (let spent = 0; spent < ms; spent += 60) {
      clock.pass(60);
      for (let turn = 0; turn < 4; turn += 1) await settle();
    }
  };
  return { run, told, service, storage, pass };
}

const course = (changes = {}) => ({ ...NO_COURSE, from: 1_200, edition: 1, ...changes });

test("the older part comes in pages, the newest first, one after the other", async () => {
  const { run, told, pass } = stage();
  run.takeIn("s1", 1_200, course());
  await pass(1_000);
  assert.deepEqual(told.asked, ["s1/changes?limit=1000", "s1/timeline?from=700&limit=500", "s1/timeline?from=200&limit=500", "s1/timeline?from=0&limit=200"]);
  assert.equal(run.chart.gap(500), null);
  assert.equal(run.chart.marks().length, 3);
});

test("what the stream told is not asked for again; what it missed is", async () => {
  const { run, told, pass } = stage({ now: 1_203 });
  run.takeIn("s1", 1_200, course());
  await pass(1_000);
  told.asked.length = 0;
  run.takeIn("s1", 1_201, course({ letters: "F" }));
  await pass(300);
  assert.deepEqual(told.asked, []);
  run.takeIn("s1", 1_203, course({ letters: "F?F" }));
  await pass(300);
  assert.deepEqual(told.asked, ["s1/timeline?from=1201&limit=1"]);
});

test("when something was taken back, the run is asked for from where it now differs", async () => {
  const said = (tick, sequence) => ({ tick, sequence, text: `said ${sequence}`, said: true });
  const { run, told, service, pass } = stage({ changes: [said(100, 1), said(900, 2)] });
  run.takeIn("s1", 1_200, course());
  await pass(1_000);
  assert.deepEqual(run.chart.marks().filter(({ kind }) => kind === "command").map(({ text }) => text), ["said 1", "said 2"]);
  told.asked.length = 0;
  told.rewritten = 0;
  service.changes = [said(100, 1)];
  run.takeIn("s1", 1_200, course({ edition: 2 }));
  await pass(1_000);
  assert.deepEqual(told.asked, ["s1/changes?limit=1000", "s1/timeline?from=900&limit=300"]);
  assert.equal(told.rewritten, 1);
  assert.deepEqual(run.chart.marks().filter(({ kind }) => kind === "command").map(({ text }) => text), ["said 1"]);
});

test("a failure is told and tried again later", async () => {
  const { run, told, service, pass } = stage({ failing: true });
  run.takeIn("s1", 1_200, course());
  await pass(200);
  assert.ok(told.failures.includes("Not now."));
  const asked = told.asked.length;
  await pass(2_000);
  assert.equal(told.asked.length, asked, "not at once");
  service.failing = false;
  await pass(6_000);
  assert.equal(run.chart.gap(500), null);
  assert.equal(told.failures.at(-1), null);
});

test("forks made here stand where they were made; another session has a chart of its own", async () => {
  const { run, storage, pass } = stage();
  noteFork(storage, { child: "b", parent: "s1", tick: 300 });
  noteFork(storage, { child: "c", parent: "other", tick: 40 });
  run.takeIn("s1", 1_200, course());
  await pass(200);
  assert.deepEqual(run.chart.marks().filter(({ kind }) => kind === "fork"), [{ tick: 300, kind: "fork", session: "b" }]);
  run.takeIn("s2", 3, course({ from: 3 }));
  assert.deepEqual([run.chart.now, run.chart.marks().length], [3, 0]);
});

/** A service that answers when the test lets it: what it knew when it was asked. */
function heldBack() {
  const told = { rewritten: 0 };
  const service = { changes: [], letter: "F", asked: [] };
  const clock = new FakeClock();
  const run = new Run({
    storage: null,
    changed() {},
    rewritten: () => (told.rewritten += 1),
    failed() {},
    later: clock.later,
    http(path) {
      const [, limit] = /limit=(\d+)/.exec(path).map(Number);
      const body = path.includes("/changes") ? { items: service.changes, more: false } : { from: Number(/from=(\d+)/.exec(path)[1]), now: 20, moves: service.letter.repeat(limit), marks: [], more: false };
      return new Promise((resolve) => service.asked.push({ path, answer: () => resolve(new Response(JSON.stringify(body))) }));
    },
  });
  const answer = async (which) => {
    service.asked.splice(service.asked.findIndex(({ path }) => path.includes(which)), 1)[0].answer();
    for (let turn = 0; turn < 6; turn += 1) await settle();
  };
  const commands = () => run.chart.marks().filter(({ kind }) => kind === "command").map(({ text }) => text);
  return { run, told, service, clock, answer, commands };
}

test("of two lists of what stands the newer one holds, even when the older one comes last", async () => {
  const { run, service, answer, commands } = heldBack();
  run.takeIn("s1", 20, course({ from: 20 }));
  service.changes = [{ tick: 5, sequence: 1, text: "the newer" }];
  run.takeIn("s1", 20, course({ from: 20, edition: 2 }));
  const [older] = service.asked.splice(0, 1);
  await answer("/changes");
  assert.deepEqual(commands(), ["the newer"]);
  older.answer();
  for (let turn = 0; turn < 6; turn += 1) await settle();
  assert.deepEqual(commands(), ["the newer"]);
});

test("a page of the run that was asked for before it became another is asked for again", async () => {
  const { run, service, clock, answer } = heldBack();
  run.takeIn("s1", 20, course({ from: 20 }));
  await answer("/changes");
  clock.pass(60);
  assert.match(service.asked[0].path, /timeline\?from=0&limit=20/);
  service.changes = [{ tick: 5, sequence: 1, text: "taken back" }];
  service.letter = "L";
  run.takeIn("s1", 20, course({ from: 20, edition: 2 }));
  await answer("/changes");
  await answer("/timeline");
  assert.equal(run.chart.letter(10), "", "what it was is not what it is");
  clock.pass(60);
  await answer("/timeline");
  assert.equal(run.chart.letter(10), "L");
});

test("what is about to be known is said to be coming, and no longer once it is known or cannot be had", async () => {
  const { run, service, pass } = stage();
  assert.equal(run.coming, false, "of no session");
  run.takeIn("s1", 1_200, course());
  assert.equal(run.coming, true);
  await pass(60);
  assert.equal(run.coming, true, "the first pages");
  await pass(1_000);
  assert.equal(run.coming, false);
  run.takeIn("s1", 1_200, course({ edition: 2 }));
  assert.equal(run.coming, true, "what stands is asked anew");
  service.failing = true;
  run.takeIn("s1", 1_202, course({ edition: 3, letters: "??" }));
  await pass(600);
  assert.equal(run.coming, false, "nobody waits for what cannot be had");
});
