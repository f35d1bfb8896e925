import assert from "node:assert/strict";
import { test } from "node:test";

import { INITIAL, reduce } from "../../web/src/core/state.js";
import { createStore } from "../../web/src/core/store.js";
import { pastOf } from "../../web/src/timeline/momentCache.js";
import { TimeTravel } from "../../web/src/timeline/timeTravel.js";
import { FakeClock, hello, settle, wireState } from "./fakes.mjs";

const NOW = 100;

/** A service whose answers come when the test lets them. */
class SlowService {
  asked = [];
  held = [];
  failing = null;

  http = (path) => {
    const from = Number(/from=(\d+)/.exec(path)[1]);
    const limit = Number(/limit=(\d+)/.exec(path)[1]);
    this.asked.push(limit === 2 ? `${from}` : from);
    const items = [];
    for (let tick = from; tick < Math.min(from + limit, NOW + 1); tick += 1) {
      items.push({ state: wireState({ tick }), decision: tick === 0 ? null : { tick: tick - 1, move: "forward", narration: `N${tick}`, options: [{ reason: "free", causes: ["c"] }] } });
    }
    const body = this.failing ?? { items, now: NOW };
    const status = this.failing ? 503 : 200;
    return new Promise((resolve) => this.held.push(() => resolve(new Response(JSON.stringify(body), { status }))));
  };

  async answer(which = 0) {
    this.held.splice(which, 1)[0]();
    for (let turn = 0; turn < 5; turn += 1) await settle();
  }
}

function stage(now = NOW) {
  const service = new SlowService();
  const clock = new FakeClock();
  const store = createStore(reduce, INITIAL);
  const present = (tick) => store.dispatch(hello({ state: wireState({ tick, playback_speed: 2 }) }));
  store.dispatch({ type: "session", id: "s1" });
  present(now);
  const seen = [];
  store.subscribe(({ past }, before) => past !== before.past && seen.push(past && past.world.tick));
  const looking = new TimeTravel(store, { http: service.http, later: clock.later, cancel: clock.cancel });
  return { service, clock, seen, looking, present, store };
}

test("a past tick is shown with what was decided there, with reason and causes", () => {
  const decision = { tick: 7, move: "stay", narration: "Waits.", options: [{ reason: "pothole", causes: ["pothole-1"] }] };
  const past = pastOf({ state: wireState({ tick: 7 }) }, { decision });
  assert.equal(past.world.tick, 7);
  assert.deepEqual([past.decision.tick, past.decision.reason, past.decision.causes, past.narration], [7, "pothole", ["pothole-1"], "Waits."]);
  assert.equal(pastOf({ state: wireState({ tick: 0 }) }).decision, null);
});

test("a tick seen alone or in a page has the decision of its own tick", async () => {
  const { service, looking, store } = stage();
  for (const tick of [40, 41]) {
    void looking.at(tick);
    await service.answer();
  }
  assert.equal(store.state().past.world.tick, 41);
  assert.equal(store.state().past.decision.tick, 41);
  assert.equal(store.state().past.narration, "N42");
});

test("the latest wish wins, and a drag leaves no queue of questions behind", async () => {
  const { service, seen, looking } = stage();
  for (const tick of [5, 20, 60, 40]) void looking.at(tick);
  assert.equal(looking.tick, 40);
  assert.deepEqual(service.asked, ["5"]);
  await service.answer();
  assert.deepEqual(service.asked, ["5", "40"]);
  assert.deepEqual(seen, []);
  await service.answer();
  assert.deepEqual(seen, [40]);
});

test("who rests at a tick has its page at hand, asked for once", async () => {
  const { service, clock, seen, looking } = stage();
  void looking.at(36);
  await service.answer();
  assert.deepEqual(service.asked, ["36"]);
  clock.pass(200);
  assert.deepEqual(service.asked, ["36", 32, 16], "its page, and the nearer neighbour");
  await service.answer();
  for (const tick of [37, 38, 35]) await looking.at(tick);
  assert.deepEqual(seen, [36, 37, 38, 35]);
  assert.equal(service.asked.filter((from) => from === 32).length, 1);
});

test("who walks is given pages, and what comes next before it is wished for", async () => {
  const { service, looking } = stage();
  void looking.at(42);
  await service.answer();
  void looking.at(43);
  await service.answer();
  assert.deepEqual(service.asked, ["42", 32, 48]);
});

test("at the present or beyond it one is back at the present", async () => {
  const { service, seen, looking } = stage();
  void looking.at(99);
  await service.answer();
  await looking.step(1);
  assert.deepEqual([looking.tick, seen.at(-1)], [null, null]);
  void looking.at(-5);
  assert.equal(looking.tick, 0);
});

test("playing goes on at the session's speed and ends at the present", async () => {
  const { service, clock, seen, looking } = stage();
  void looking.at(97);
  await service.answer();
  clock.pass(200);
  while (service.held.length > 0) await service.answer();
  looking.toggle();
  for (let turn = 0; turn < 4; turn += 1) {
    clock.pass(250);
    await settle();
    await settle();
  }
  assert.deepEqual(seen, [97, 98, 99, null]);
  assert.equal(looking.playing, false);
  assert.equal(clock.waiting, 0, "nothing is left to wait for");
});

test("a refusal is told, and the present is shown again", async () => {
  const { service, looking, store } = stage();
  service.failing = { title: "x", status: 503, detail: "The service is being stopped.", errors: [] };
  void looking.at(10);
  await service.answer();
  assert.deepEqual(store.state().notice, { text: "The service is being stopped.", tone: "bad" });
  assert.equal(looking.tick, null);
  service.failing = null;
  void looking.at(10);
  await service.answer();
  assert.equal(looking.tick, 10);
});

test("a run that has become another is asked for anew", async () => {
  const { service, looking, store, seen, present } = stage();
  void looking.at(20);
  await service.answer();
  void looking.at(70);
  // With a question under way, and then with the present before what is looked at.
  store.dispatch({ type: "timeline-changes", items: [{ tick: 5, sequence: 1, text: "add a pothole" }], more: false, forks: [] });
  await service.answer();
  assert.deepEqual(seen, [20], "what was asked before is not shown");
  await service.answer();
  assert.deepEqual(seen, [20, 70]);
  present(12);
  assert.deepEqual([looking.tick, seen.at(-1)], [null, null]);
});

test("when the stream is opened again, the tick that was looked at is shown again", async () => {
  const { service, looking, seen, present } = stage();
  void looking.at(20);
  await service.answer();
  present(NOW);
  await service.answer();
  assert.deepEqual([looking.tick, seen], [20, [20, null, 20]]);
});

test("what was just changed is to be seen; in another session nothing is looked at", async () => {
  const { service, looking, store } = stage();
  void looking.at(20);
  await service.answer();
  store.dispatch({ type: "said", id: "c1", text: "add a pothole", quiet: false });
  const result = { text: null, actions: [], changes: [{ path: "potholes", before: 1, after: 2 }], reply: "Done.", answer: null, sequence: 101 };
  store.dispatch({ type: "result", id: "c1", result });
  assert.deepEqual([looking.tick, store.state().past], [null, null]);
  void looking.at(40);
  store.dispatch({ type: "session", id: "s2" });
  await service.answer();
  assert.deepEqual([looking.tick, store.state().past], [null, null]);
});

test("time going on lengthens a page that ended at the present", async () => {
  const { service, looking, present } = stage(101);
  present(101);
  void looking.at(98);
  await service.answer();
  service.held.length = 0;
  void looking.at(100);
  await settle();
  assert.equal(looking.tick, 100);
});

test("stopped and played again while a tick is on its way, it goes on at its own pace and no faster", async () => {
  const { service, clock, looking } = stage();
  void looking.at(36);
  await service.answer();
  looking.play();
  clock.pass(250);
  looking.stop();
  looking.play();
  await service.answer();
  const from = looking.tick;
  for (const held of service.held.splice(0)) held();
  for (let turn = 0; turn < 5; turn += 1) await settle();
  for (let each = 0; each < 4; each += 1) {
    clock.pass(250);
    for (let turn = 0; turn < 5; turn += 1) await settle();
  }
  assert.equal(looking.tick, from + 4);
});
