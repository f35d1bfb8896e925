import assert from "node:assert/strict";
import { test } from "node:test";

import { INITIAL, reduce } from "../../web/src/core/state.js";
import { createStore } from "../../web/src/core/store.js";
import { noteFork } from "../../web/src/timeline/links.js";
import { TimelineLoader } from "../../web/src/timeline/timelineLoader.js";
import { allEvents, gapOf, nowOf } from "../../web/src/timeline/timelineState.js";
import { FakeClock, hello, settle, tick, wireState } from "./fakes.mjs";

/** A store with a session at a tick. */
function opened(now, session = "s1") {
  const store = createStore(reduce, INITIAL);
  return { store, open: (at = now, id = session) => open(store, at, id) };
}

function open(store, now, session) {
  store.dispatch({ type: "session", id: session });
  store.dispatch(hello({ session: { id: session, name: null, paused: false }, state: wireState({ tick: now, session }) }));
}

/** Something is said that may have rewritten the run. */
const say = (store, sequence, now) =>
  store.dispatch({ type: "changed", sequence, text: null, reply: "Done.", changes: [{ path: "potholes", before: 1, after: 2 }], events: [], state: wireState({ tick: now, sequence }) });
const commands = (store) => allEvents(store.state().timeline).filter(({ kind }) => kind === "command").map(({ text }) => text);

function stage({ now = 1_200, changes = [], failing = false } = {}) {
  const clock = new FakeClock();
  const asked = [];
  const service = { changes, failing };
  const kept = new Map();
  const storage = { getItem: (key) => kept.get(key) ?? null, setItem: (key, value) => kept.set(key, value) };
  const { store, open } = opened(now);
  new TimelineLoader(store, {
    storage,
    later: clock.later,
    async http(path) {
      asked.push(path.replace("/api/v1/sessions/", ""));
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
  return { store, open, asked, service, storage, pass, timeline: () => store.state().timeline };
}

test("the older part comes in pages, the newest first, one after the other", async () => {
  const { open, timeline, asked, pass } = stage();
  open();
  await pass(1_000);
  assert.deepEqual(asked, ["s1/changes?limit=1000", "s1/timeline?from=700&limit=500", "s1/timeline?from=200&limit=500", "s1/timeline?from=0&limit=200"]);
  assert.equal(gapOf(timeline(), 500), null);
  assert.equal(allEvents(timeline()).length, 3);
});

test("what the stream told is not asked for again; what it missed is", async () => {
  const { store, open, asked, pass } = stage();
  open();
  await pass(1_000);
  asked.length = 0;
  store.dispatch(tick({ tick: 1_201, decision: { tick: 1_200, move: "forward" } }));
  await pass(300);
  assert.deepEqual(asked, []);
  store.dispatch(tick({ tick: 1_203, decision: { tick: 1_202, move: "forward" } }));
  await pass(300);
  assert.deepEqual(asked, ["s1/timeline?from=1201&limit=1"]);
});

test("when something was taken back, the run is asked for from where it now differs", async () => {
  const said = (tick, sequence) => ({ tick, sequence, text: `said ${sequence}`, said: true });
  const { store, open, timeline, asked, service, pass } = stage({ changes: [said(100, 1), said(900, 2)] });
  open();
  await pass(1_000);
  assert.deepEqual(commands(store), ["said 1", "said 2"]);
  asked.length = 0;
  const { version } = timeline();
  service.changes = [said(100, 1)];
  say(store, 101, 1_200);
  await pass(1_000);
  assert.deepEqual(asked, ["s1/changes?limit=1000", "s1/timeline?from=900&limit=300"]);
  assert.equal(timeline().version, version + 1);
  assert.deepEqual(commands(store), ["said 1"]);
});

test("a failure is told and tried again later", async () => {
  const { open, timeline, asked, service, pass } = stage({ failing: true });
  open();
  await pass(200);
  assert.equal(timeline().trouble, "Not now.");
  const before = asked.length;
  await pass(2_000);
  assert.equal(asked.length, before, "not at once");
  service.failing = false;
  await pass(6_000);
  assert.equal(gapOf(timeline(), 500), null);
  assert.equal(timeline().trouble, null);
});

test("forks made here stand where they were made; another session has a timeline of its own", async () => {
  const { open, timeline, storage, pass } = stage();
  noteFork(storage, { child: "b", parent: "s1", tick: 300 });
  noteFork(storage, { child: "c", parent: "other", tick: 40 });
  open();
  await pass(200);
  assert.deepEqual(allEvents(timeline()).filter(({ kind }) => kind === "fork"), [{ tick: 300, kind: "fork", session: "b" }]);
  open(3, "s2");
  assert.deepEqual([nowOf(timeline()), allEvents(timeline()).length], [3, 0]);
});

/** A service that answers when the test lets it: what it knew when it was asked. */
function heldBack() {
  const service = { changes: [], letter: "F", asked: [] };
  const clock = new FakeClock();
  const { store, open } = opened(20);
  new TimelineLoader(store, {
    storage: null,
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
  return { store, open, service, clock, answer };
}

test("of two lists of what stands the newer one holds, even when the older one comes last", async () => {
  const { store, open, service, answer } = heldBack();
  open();
  service.changes = [{ tick: 5, sequence: 1, text: "the newer" }];
  say(store, 101, 20);
  const [older] = service.asked.splice(0, 1);
  await answer("/changes");
  assert.deepEqual(commands(store), ["the newer"]);
  older.answer();
  for (let turn = 0; turn < 6; turn += 1) await settle();
  assert.deepEqual(commands(store), ["the newer"]);
});

test("a page of the run that was asked for before it became another is asked for again", async () => {
  const { store, open, service, clock, answer } = heldBack();
  open();
  await answer("/changes");
  clock.pass(60);
  assert.match(service.asked[0].path, /timeline\?from=0&limit=20/);
  service.changes = [{ tick: 5, sequence: 1, text: "taken back" }];
  service.letter = "L";
  say(store, 101, 20);
  await answer("/changes");
  await answer("/timeline");
  assert.equal(store.state().timeline.letters[10], "?", "what it was is not what it is");
  clock.pass(60);
  await answer("/timeline");
  assert.equal(store.state().timeline.letters[10], "L");
});

test("a page of a session that was left is not another's", async () => {
  const { store, open, clock, answer } = heldBack();
  open();
  await answer("/changes");
  clock.pass(60);
  open(20, "s2");
  await answer("/timeline");
  assert.equal(store.state().timeline.letters, "?".repeat(20));
});

test("what is about to be known is said to be coming, and no longer once it is known or cannot be had", async () => {
  const { store, open, timeline, service, pass } = stage();
  assert.equal(timeline().loading, false, "of no session");
  open();
  assert.equal(timeline().loading, true);
  await pass(60);
  assert.equal(timeline().loading, true, "the first pages");
  await pass(1_000);
  assert.equal(timeline().loading, false);
  say(store, 101, 1_200);
  assert.equal(timeline().loading, true, "what stands is asked anew");
  service.failing = true;
  say(store, 102, 1_202);
  await pass(600);
  assert.equal(timeline().loading, false, "nobody waits for what cannot be had");
});
