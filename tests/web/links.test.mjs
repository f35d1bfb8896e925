import assert from "node:assert/strict";
import { test } from "node:test";

import { fetchedLater, fileName, videoPath, recordingIn, sizeText, stretch } from "../../web/src/timeline/downloads.js";
import { ask, askJson, Refused } from "../../web/src/core/http.js";
import { hashOf, placeInHash, raceHash } from "../../web/src/core/address.js";
import { forkAt, forks, noteFork, shareLink } from "../../web/src/timeline/links.js";

const page = new URL("http://localhost:8000/?x=1#/s/a");

test("an address names a session, a moment of it, or carries one whole", () => {
  assert.deepEqual(placeInHash("#/s/abc"), { session: "abc", tick: null });
  assert.deepEqual(placeInHash(hashOf("a b", 40)), { session: "a b", tick: 40 });
  assert.deepEqual(placeInHash("#/r/eJx-_9"), { carried: "#/r/eJx-_9" });
  assert.deepEqual(placeInHash(raceHash("abc", ["rules", "astar"], 7)), { session: "abc", tick: null, race: { planners: ["rules", "astar"], tick: 7 } });
  for (const hash of ["", "#", "#/c/abc", "#/c/abc/rules", "#/s/", "#/s/a/b", "#/r/", "#/r/a b", "#/s/a/9999999999999999"]) assert.equal(placeInHash(hash), null, hash);
});

test("a link is made of the page's own address", async () => {
  const asked = [];
  const http = async (path) => {
    asked.push(path);
    return new Response(JSON.stringify({ link: "#/r/xyz", tick: 40, carries: true }));
  };
  assert.deepEqual(await shareLink(page, "a", 40, http), { url: "http://localhost:8000/#/r/xyz", tick: 40, carries: true });
  await shareLink(page, "a", null, http);
  assert.deepEqual(asked, ["/api/v1/sessions/a/link?tick=40", "/api/v1/sessions/a/link"]);
});

test("a fork says only what was wished for", async () => {
  const bodies = [];
  const http = async (_, { body }) => {
    bodies.push(JSON.parse(body));
    return new Response("{}", { status: 201 });
  };
  await forkAt("a", 7, true, http);
  await forkAt("a", null, undefined, http);
  assert.deepEqual(bodies, [{ at_tick: 7, paused: true }, {}]);
});

test("forks are remembered, and a storage that is full or broken does no harm", () => {
  const kept = new Map();
  const storage = { getItem: (key) => kept.get(key) ?? null, setItem: (key, value) => kept.set(key, value) };
  for (let fork = 0; fork < 250; fork += 1) noteFork(storage, { child: `c${fork}`, parent: "p", tick: fork });
  assert.equal(forks(storage).length, 200);
  assert.equal(forks(storage).at(-1).child, "c249");
  const broken = { getItem: () => "{", setItem: () => { throw new Error("full"); } };
  noteFork(broken, { child: "c", parent: "p", tick: 1 });
  assert.deepEqual([forks(broken), forks(null)], [[], []]);
});

test("a refusal is its own sentence, with the field that was wrong", async () => {
  const refusing = (body, status = 422) => async () => new Response(typeof body === "string" ? body : JSON.stringify(body), { status });
  await assert.rejects(askJson("/x", { http: refusing({ detail: "fps: too many.", errors: [] }) }), (error) => error instanceof Refused && error.status === 422 && error.message === "fps: too many.");
  await assert.rejects(ask("/x", { http: refusing({ detail: "Two things are wrong.", errors: [{ field: "to", message: "has not come yet" }] }) }), /Two things are wrong\. to: has not come yet\./);
  await assert.rejects(ask("/x", { http: refusing("<html>", 502) }), /answered 502/);
  await assert.rejects(ask("/x", { http: async () => { throw new TypeError("failed"); } }), /cannot be reached/);
});

test("a film is of the latest ticks, or around the one that is looked at", () => {
  assert.deepEqual(stretch(300, null), { from: 280, to: 300 });
  assert.deepEqual(stretch(5, null), { from: 0, to: 5 });
  assert.deepEqual(stretch(300, 100), { from: 90, to: 110 });
  assert.deepEqual(stretch(300, 3), { from: 0, to: 20 });
  assert.deepEqual(stretch(300, 298), { from: 280, to: 300 });
  const wish = { from: 0, to: 20, format: "gif", view: "road", side: 480, theme: "light", boxes: false, path: true, forecast: false };
  assert.match(videoPath("a", wish, 0.5), /film\?from=0&to=20&format=gif&fps=12&view=road&side=480&theme=light&boxes=false&path=true&forecast=false$/);
  assert.match(videoPath("a", { ...wish, to: 160 }, 0.5), /fps=3&/);
});

const LATER = { id: "7", what: "film", links: { self: "/answers/7", result: "/answers/7/result" } };

test("a video that takes long is looked at until it is there, then fetched and forgotten", async () => {
  const asked = [], shares = [];
  const states = [{ state: "running", progress: 0.25 }, { state: "done", progress: 1 }];
  const http = async (path, { method, headers }) => {
    asked.push(`${method} ${path}`);
    if (path === "/film") {
      assert.equal(headers.prefer, "respond-async");
      return new Response(JSON.stringify({ ...LATER, state: "running", progress: 0 }), { status: 202 });
    }
    if (method === "DELETE") return new Response(null, { status: 204 });
    return new Response(path === "/answers/7" ? JSON.stringify({ ...LATER, ...states.shift() }) : "GIF89a");
  };
  const data = await fetchedLater("/film", new AbortController().signal, (share) => shares.push(share), { http, lookMs: 0 });
  assert.equal(await data.text(), "GIF89a");
  assert.deepEqual(shares, [0, 0.25]);
  assert.deepEqual(asked, ["GET /film", "GET /answers/7", "GET /answers/7", "GET /answers/7/result", "DELETE /answers/7"]);
});

test("a video that nobody wants any more is cancelled", async () => {
  const asked = [], own = new AbortController();
  const http = async (path, { method }) => {
    asked.push(`${method} ${path}`);
    return method === "DELETE" ? new Response(null, { status: 204 }) : new Response(JSON.stringify({ ...LATER, state: "running", progress: 0 }), { status: 202 });
  };
  await assert.rejects(fetchedLater("/film", own.signal, () => own.abort(), { http, lookMs: 60_000 }));
  assert.deepEqual(asked, ["GET /film", "DELETE /answers/7"]);
});

test("a video that is there at once is taken as it is", async () => {
  const data = await fetchedLater("/film", new AbortController().signal, () => assert.fail(), { http: async () => new Response("GIF89a") });
  assert.equal(await data.text(), "GIF89a");
});

test("a file that is no recording says what it is instead", () => {
  assert.throws(() => recordingIn("{", "a.json"), /“a\.json” is no recording: it is not JSON/);
  assert.throws(() => recordingIn("[1]", "b.json"), /does not say that it is one/);
  assert.throws(() => recordingIn("null", "c.json"), /does not say that it is one/);
  assert.equal(recordingIn('{"format":"roadtalk-recording"}', "d").format, "roadtalk-recording");
  assert.equal(fileName("abcdefghijk", "tick-4", "png"), "roadtalk-abcdefgh-tick-4.png");
});

test("a file's size is told in three figures or so", () => {
  assert.deepEqual([1, 1_499, 987_400, 1_568_000, 12_340_000].map(sizeText), ["1 kB", "1 kB", "987 kB", "1.6 MB", "12.3 MB"]);
});
