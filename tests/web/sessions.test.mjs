import assert from "node:assert/strict";
import { test } from "node:test";

import { hashOf, momentInHash } from "../../web/src/core/address.js";
import { createSession, findSession } from "../../web/src/core/sessions.js";

const answering = (status, body = {}) => async () => new Response(JSON.stringify(body), { status });
const failing = async () => {
  throw new TypeError("fetch failed");
};

test("the address names a session, whatever its id", () => {
  for (const id of ["abc", "a b", "ä/ö", "50%"]) assert.deepEqual(momentInHash(hashOf(id)), { session: id, tick: null });
  for (const hash of ["", "#", "#/s/", "#/s/a/b", "#/t/a", "#/s/%"]) assert.equal(momentInHash(hash), null, hash);
});

test("a session is missing only when the service says so", async () => {
  assert.equal(await findSession("a", answering(200)), "here");
  assert.equal(await findSession("a", answering(404)), "missing");
  assert.equal(await findSession("a", answering(410)), "missing");
  assert.equal(await findSession("a", answering(500)), "unreachable");
  assert.equal(await findSession("a", answering(429)), "unreachable");
  assert.equal(await findSession("a", failing), "unreachable");
});

test("a session is made in the page's language, or in English where the service does not speak it", async () => {
  const asked = [];
  const http = (speaks) => async (path, { body }) => {
    asked.push(JSON.parse(body));
    const refused = asked.at(-1).language !== undefined && !speaks;
    return new Response(JSON.stringify({ id: "n", detail: "no" }), { status: refused ? 422 : 201 });
  };
  assert.equal((await createSession(http(true), "de")).id, "n");
  assert.equal((await createSession(http(false), "de")).id, "n");
  await createSession(http(true), "en");
  assert.deepEqual(asked, [{ language: "de" }, { language: "de" }, {}, {}]);
});

test("a new session, or a sentence why not", async () => {
  assert.deepEqual(await createSession(answering(201, { id: "n" })), { id: "n" });
  await assert.rejects(createSession(answering(429, { detail: "Too many sessions." })), /Too many sessions\./);
  await assert.rejects(createSession(async () => new Response("oops", { status: 502 })), /answered 502/);
  await assert.rejects(createSession(failing), /cannot be reached/);
});
