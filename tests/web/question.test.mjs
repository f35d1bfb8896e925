import assert from "node:assert/strict";
import { test } from "node:test";

import { answerExchange, beginExchange, openQuestion, refuseExchange, withQuestion } from "../../web/src/talk/exchanges.js";

const CHOICES = [1, 3].map((count) => ({ text: `add ${count}`, actions: [{ do: "add", kind: "pothole", count }] }));
const PENDING = { text: "add potholes", question: "How many?", choices: CHOICES };
const ASKED = { type: "/problems/ambiguous", title: "", status: 409, detail: "How many?", errors: [], choices: CHOICES, pending: PENDING };

/** A talk in which a question was asked, and then this was done. */
function after(text, actions, { quiet = false, answer = null, said = text } = {}) {
  let talk = refuseExchange(beginExchange([], { id: "1", text: "add potholes", quiet: false }), "1", ASKED);
  talk = beginExchange(talk, { id: "2", text, quiet });
  return answerExchange(talk, "2", { text: said, actions, changes: [], reply: "", answer });
}

test("a question is open until it is answered or something else is said", () => {
  const asked = refuseExchange(beginExchange([], { id: "1", text: "add potholes", quiet: false }), "1", ASKED);
  assert.equal(openQuestion(asked), "1");
  assert.equal(openQuestion(after("ten", [{ do: "add", kind: "pothole", count: 10 }])), null);
  assert.equal(openQuestion(after("where are you?", [{ do: "ask", about: "status" }])), null);
});

test("a refusal, a button and the question what was asked leave it open", () => {
  const refused = refuseExchange(
    beginExchange(refuseExchange(beginExchange([], { id: "1", text: "add potholes", quiet: false }), "1", ASKED), { id: "2", text: "cake", quiet: false }),
    "2",
    { type: "/problems/not-understood", title: "", status: 422, detail: "?", errors: [] },
  );
  assert.equal(openQuestion(refused), "1");
  assert.equal(openQuestion(after("Pause", [{ do: "pause" }], { quiet: true, said: null })), "1");
  assert.equal(openQuestion(after("what?", [{ do: "ask", about: "pending" }], { answer: { about: "pending" } })), "1");
});

test("a choice taken by a click and the cross close it", () => {
  assert.equal(openQuestion(after("add 3", CHOICES[1].actions, { said: null })), null);
  assert.equal(openQuestion(after("Drop", [{ do: "drop" }], { quiet: true, said: null })), null);
});

test("a question that was open before the page was is shown once", () => {
  const talk = withQuestion([], PENDING);
  assert.equal(talk.length, 1);
  assert.equal(talk[0].problem.detail, "How many?");
  assert.equal(withQuestion(talk, PENDING), talk);
  assert.deepEqual(withQuestion([], null), []);
});
