import assert from "node:assert/strict";
import { test } from "node:test";

import { createStore } from "../../web/src/core/store.js";

const counting = () => createStore((/** @type {number} */ state, /** @type {number} */ event) => state + event, 0);

test("listeners are told of each change, and of no event that changes nothing", () => {
  const store = counting();
  const told = [];
  const end = store.subscribe((now, before) => told.push([before, now]));
  for (const event of [1, 0, 2]) store.dispatch(event);
  end();
  store.dispatch(4);
  assert.deepEqual(told, [[0, 1], [1, 3]]);
  assert.equal(store.state(), 7);
});

test("what a listener dispatches is told to all after what they are being told", () => {
  const store = counting();
  const told = [];
  store.subscribe((now) => now === 1 && store.dispatch(10));
  store.subscribe((now, before) => told.push([before, now]));
  store.dispatch(1);
  assert.deepEqual(told, [[0, 1], [1, 11]]);
});
