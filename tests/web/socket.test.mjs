import assert from "node:assert/strict";
import { test } from "node:test";

import { Connection, pauseBefore } from "../../web/src/core/socket.js";
import { FakeClock, FakeSocket, hello, settle, tick } from "./fakes.mjs";

function connected({ find = async () => "here" } = {}) {
  const clock = new FakeClock();
  const sockets = [];
  const phases = [];
  const messages = [];
  const connection = new Connection("s1", {
    page: new URL("http://localhost/"),
    find,
    onMessage: (message) => messages.push(message),
    onPhase: (phase) => phases.push(phase),
    open: (url) => sockets[sockets.push(new FakeSocket(url)) - 1],
    later: clock.later,
    cancel: clock.cancel,
    random: () => 0,
  });
  return { clock, sockets, phases, messages, connection };
}

async function live(parts) {
  await parts.connection.open();
  parts.sockets.at(-1).receive(hello());
}

test("opens, greets, passes messages on", async () => {
  const parts = connected();
  await live(parts);
  parts.sockets[0].receive(tick());
  assert.deepEqual(parts.phases.map(({ phase }) => phase), ["opening", "live"]);
  assert.deepEqual(parts.messages.map(({ type }) => type), ["hello", "tick"]);
  assert.equal(parts.sockets[0].url, "ws://localhost/api/v1/sessions/s1/stream");
});

test("after a loss it tries again with growing pauses and resumes after the last sequence seen", async () => {
  let there = "here";
  const parts = connected({ find: async () => there });
  await live(parts);
  parts.sockets[0].receive(tick({ sequence: 137 }));
  there = "unreachable";
  parts.sockets[0].break();
  const pauses = [];
  for (let attempt = 0; attempt < 4; attempt++) {
    const last = parts.phases.at(-1);
    assert.equal(last.phase, "lost");
    pauses.push(last.retryMs);
    parts.clock.pass(last.retryMs);
    await settle();
  }
  assert.deepEqual(pauses, [400, 800, 1600, 3200]);
  there = "here";
  parts.clock.pass(parts.phases.at(-1).retryMs);
  await settle();
  assert.match(parts.sockets.at(-1).url, /\?after=137$/);
  parts.sockets.at(-1).receive(hello());
  assert.equal(parts.phases.at(-1).phase, "live");
});

test("pauses grow to ten seconds, never beyond, and never to nothing", () => {
  for (let attempt = 0; attempt < 40; attempt++) {
    for (const random of [0, 0.5, 0.999]) {
      const pause = pauseBefore(attempt, random);
      assert.ok(pause >= 300 && pause <= 10_000, `${attempt}: ${pause}`);
      assert.ok(pauseBefore(attempt + 1, random) >= pause);
    }
  }
});

test("a session that is missing or gone is not tried again", async () => {
  const missing = connected({ find: async () => "missing" });
  await missing.connection.open();
  assert.deepEqual(missing.phases.map(({ phase }) => phase), ["opening", "missing"]);
  assert.equal(missing.clock.waiting, 0);

  const gone = connected();
  await live(gone);
  gone.sockets[0].receive({ type: "gone" });
  assert.equal(gone.phases.at(-1).phase, "gone");
  assert.equal(gone.clock.waiting, 0);
  assert.equal(gone.connection.send({ type: "ping" }), false);
});

test("silence is asked about, and only then taken for a loss", async () => {
  const parts = connected();
  await live(parts);
  parts.clock.pass(8_000);
  assert.deepEqual(parts.sockets[0].sent, [{ type: "ping" }]);
  parts.sockets[0].receive({ type: "pong" });
  parts.clock.pass(8_000);
  assert.equal(parts.sockets[0].sent.length, 2);
  assert.equal(parts.phases.at(-1).phase, "live");
  parts.clock.pass(15_000);
  assert.equal(parts.phases.at(-1).phase, "lost");
});

test("a socket that never opens is given up and tried again", async () => {
  const parts = connected();
  await parts.connection.open();
  parts.clock.pass(15_000);
  assert.equal(parts.phases.at(-1).phase, "lost");
});

test("rubbish is left out and the connection stays", async (t) => {
  t.mock.method(console, "warn", () => {});
  const parts = connected();
  await live(parts);
  parts.sockets[0].receive("not json");
  parts.sockets[0].receive(tick());
  assert.deepEqual(parts.messages.map(({ type }) => type), ["hello", "tick"]);
});

test("an older socket's late news does not disturb the new one", async () => {
  const parts = connected();
  await live(parts);
  const [first] = parts.sockets;
  const late = first.onclose;
  first.break();
  parts.clock.pass(400);
  await settle();
  parts.sockets[1].receive(hello());
  late({});
  assert.equal(parts.phases.at(-1).phase, "live");
});

test("nothing is sent before it is open or after it is closed", async () => {
  const parts = connected();
  assert.equal(parts.connection.send({ type: "ping" }), false);
  await live(parts);
  assert.equal(parts.connection.send({ type: "command", id: "c1", text: "hi" }), true);
  parts.connection.close();
  assert.equal(parts.connection.send({ type: "ping" }), false);
  assert.equal(parts.clock.waiting, 0);
});

test("while an answer is awaited silence is borne longer: a ping is answered in turn", async () => {
  const parts = connected();
  await live(parts);
  parts.connection.send({ type: "command", id: "1", text: "why?" });
  parts.clock.pass(8_000);
  parts.clock.pass(60_000);
  assert.equal(parts.phases.at(-1).phase, "live");
  parts.sockets[0].receive({ type: "problem", id: "1", problem: { detail: "No." } });
  parts.clock.pass(8_000);
  parts.clock.pass(15_000);
  assert.equal(parts.phases.at(-1).phase, "lost", "nothing is awaited any more");
});
