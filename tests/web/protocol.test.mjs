import assert from "node:assert/strict";
import { test } from "node:test";

import { decode, encode, ProtocolError, sessionPath, streamUrl } from "../../web/src/core/protocol.js";
import { hello, tick } from "./fakes.mjs";

test("a message comes back as it was sent", () => {
  for (const message of [hello(), tick(), { type: "gone" }, { type: "pong" }]) {
    assert.deepEqual(decode(JSON.stringify(message)), message);
  }
});

test("what is not a message is refused with a reason", () => {
  for (const text of ["", "{", "null", "[]", "3", '"tick"', "{}", '{"type": 7}']) {
    assert.throws(() => decode(text), ProtocolError, text);
  }
});

test("a message that lacks what it needs names what is lacking", () => {
  assert.throws(() => decode('{"type":"tick","tick":1}'), /no sequence, episode, status, metrics/);
  assert.throws(() => decode('{"type":"result","id":"c1"}'), /no result/);
});

test("types of a later service are let through as unknown, names of Object.prototype too", () => {
  assert.deepEqual(decode('{"type":"frame","n":1}'), { type: "unknown" });
  assert.deepEqual(decode('{"type":"constructor"}'), { type: "unknown" });
});

test("commands are encoded as JSON", () => {
  assert.equal(encode({ type: "command", id: "c1", text: "say “hi”" }), '{"type":"command","id":"c1","text":"say “hi”"}');
});

test("addresses keep to the page's host and cannot leave the session", () => {
  const page = new URL("https://road.example:8443/#/s/x");
  assert.equal(streamUrl(page, "a1", null), "wss://road.example:8443/api/v1/sessions/a1/stream");
  assert.equal(streamUrl(new URL("http://localhost:8000/"), "a1", 7), "ws://localhost:8000/api/v1/sessions/a1/stream?after=7");
  assert.equal(sessionPath("../x?y"), "/api/v1/sessions/..%2Fx%3Fy");
});
