// What is kept of a conversation, and what the log tells of the time before the page was opened.
import assert from "node:assert/strict";
import { test } from "node:test";

import { INITIAL, reduce } from "../../web/src/core/state.js";
import { createStore } from "../../web/src/core/store.js";
import { openQuestion, withQuestion } from "../../web/src/talk/exchanges.js";
import { withPastLines } from "../../web/src/talk/pastLines.js";
import { keepTalk } from "../../web/src/talk/talkKeeper.js";
import { hello } from "./fakes.mjs";

/** A page with a storage that may be another page's as well. */
function visit(entries = new Map()) {
  const storage = { getItem: (key) => entries.get(key) ?? null, setItem: (key, value) => void entries.set(key, value), removeItem: (key) => void entries.delete(key) };
  const heard = {};
  const due = [];
  const store = createStore(reduce, INITIAL);
  keepTalk(store, { storage, later: (work) => due.push(work), window: { addEventListener: (name, call) => (heard[name] = call) } });
  const said = (id, reply = "Done.") => {
    store.dispatch({ type: "said", id, text: `say ${id}`, quiet: false });
    store.dispatch({ type: "result", id, result: { text: `say ${id}`, reply, actions: [], changes: [], answer: null } });
    for (const work of due.splice(0)) work();
  };
  const open = (id) => store.dispatch({ type: "session", id });
  return { entries, store, said, open, heard, talk: () => store.state().talk.map(({ said: text }) => text) };
}

test("a conversation is there again after a reload, and only in its own session", () => {
  const first = visit();
  first.open("s1");
  first.said("a-1");
  const again = visit(first.entries);
  again.open("s1");
  assert.deepEqual(again.talk(), ["say a-1"]);
  assert.equal(again.store.state().talk[0].result.reply, "Done.");
  again.open("s2");
  assert.deepEqual(again.talk(), []);
});

test("a fork goes on with what was said before it was made", () => {
  const page = visit();
  page.open("s1");
  page.said("a-1");
  page.open("s2");
  const message = hello();
  page.store.dispatch({ ...message, session: { ...message.session, id: "s2", parent: { id: "s1", tick: 3 } } });
  assert.deepEqual(page.talk(), ["say a-1"]);
});

test("two tabs show what either has said", () => {
  const one = visit();
  one.open("s1");
  const other = visit(one.entries);
  other.open("s1");
  one.said("a-1");
  other.heard.storage({ key: "roadtalk.talk.s1" });
  other.said("b-1");
  one.heard.storage({ key: "roadtalk.talk.s1" });
  assert.deepEqual(one.talk(), ["say a-1", "say b-1"]);
  assert.deepEqual(other.talk(), ["say a-1", "say b-1"]);
});

test("what is broken in the storage is left, and the oldest conversations go first", () => {
  const entries = new Map([["roadtalk.talk.s1", "{"]]);
  const page = visit(entries);
  page.open("s1");
  assert.deepEqual(page.talk(), []);
  for (let each = 0; each < 25; each += 1) {
    page.open(`n${each}`);
    page.said(`c-${each}`);
  }
  assert.equal(entries.has("roadtalk.talk.n0"), false);
  assert.equal(entries.has("roadtalk.talk.n24"), true);
});

test("a question that the session has dropped is closed", () => {
  const pending = { text: "remove the car", question: "Which?", choices: [] };
  const talk = withQuestion([], pending);
  assert.equal(openQuestion(talk), "pending");
  assert.equal(openQuestion(withQuestion(talk, null)), null);
});

test("the log of a page opened late tells decisions and words like one that was there", () => {
  const event = (number, tick, text, tone = "change") => ({ key: `e${number}`, tone, type: tone === "change" ? "changed" : "crashed", from: tick, to: tick, text, number });
  const log = [event(1, 0, "Advanced 4 ticks."), event(2, 4, "Added 5 potholes."), event(3, 4, "Advanced 2 ticks."), event(4, 6, "Crash.", "event")];
  const decisions = [0, 1, 2, 3].map((tick) => ({ tick, narration: "Forward." })).concat([{ tick: 4, narration: "Left." }, { tick: 5, narration: "Left." }]);
  const changes = [{ tick: 4, sequence: 2, text: "add five potholes", said: true }];
  const lines = withPastLines([event(1, 0, "Advanced 4 ticks."), event(2, 4, "Added 5 potholes."), event(4, 6, "Crash.", "event")], decisions, changes, []);
  assert.deepEqual(
    lines.map(({ from, to, text, said }) => [from, to, text, said]),
    [[0, 3, "Forward.", undefined], [4, 4, "Added 5 potholes.", "add five potholes"], [4, 5, "Left.", undefined], [6, 6, "Crash.", undefined]],
  );
  // Where it is not known which of two lines was said, both stay as they are.
  assert.equal(withPastLines(log, decisions, changes, []).filter(({ said }) => said).length, 0);
  const talk = [{ id: "a", said: "add five potholes", quiet: false, standing: "done", result: { reply: "Added 5 potholes." }, problem: null }];
  assert.deepEqual(withPastLines(log, decisions, changes, talk).filter(({ said }) => said).map(({ text }) => text), ["Added 5 potholes."]);
});
