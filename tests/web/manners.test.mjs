import assert from "node:assert/strict";
import { test } from "node:test";

import { watchKeys } from "../../web/src/core/commands.js";
import { onDemand } from "../../web/src/core/lazy.js";
import { prefer, preference } from "../../web/src/core/preferences.js";
import { settle } from "./fakes.mjs";

test("a part is made once, for all who want it", async () => {
  let made = 0;
  const use = onDemand({ tell: assert.fail }, async () => ({ number: ++made }));
  const got = [];
  use((part) => got.push(part.number));
  use((part) => got.push(part.number));
  await settle();
  use((part) => got.push(part.number));
  await settle();
  assert.deepEqual(got, [1, 1, 1]);
});

test("a part that could not be fetched is told, and tried again when it is wanted again", async () => {
  const told = [];
  let tries = 0;
  const use = onDemand({ tell: (notice) => told.push(notice) }, async () => {
    tries += 1;
    if (tries === 1) throw new Error("No such file.");
    return "part";
  });
  const got = [];
  use((part) => got.push(part));
  await settle();
  assert.deepEqual(got, []);
  assert.match(told[0].text, /could not be fetched.*No such file/);
  assert.equal(told[0].tone, "bad");
  use((part) => got.push(part));
  await settle();
  assert.deepEqual(got, ["part"]);
});

test("what is chosen holds for this visit even where nothing can be kept", () => {
  assert.equal(preference("theme"), "");
  assert.equal(preference("theme", "dark"), "dark");
  prefer("theme", "light");
  assert.equal(preference("theme", "dark"), "light");
});

/** The keyboard, with what has the focus, and what a key has done. */
function keyboard(commands) {
  const did = [];
  /** @type {(event: object) => void} */ let press = () => {};
  globalThis.Element = class {
    constructor(...matched) {
      this.matched = matched;
    }
    closest(selector) {
      return this.matched.some((each) => selector.split(", ").includes(each)) ? this : null;
    }
  };
  globalThis.addEventListener = (_, listener) => (press = listener);
  const page = { state: () => ({}), act: (actions, label) => did.push(label), commands: () => commands };
  watchKeys(page, { focus: () => did.push("focus") });
  return (key, changes = {}) => {
    did.length = 0;
    let prevented = false;
    press({ key, target: null, preventDefault: () => (prevented = true), ...changes });
    assert.equal(prevented, did.length > 0, "only what was done is kept from the browser");
    return did.join(" ");
  };
}

test("a key does its act, unless somebody is typing or the key is the button's own", () => {
  const act = (key, more = {}) => ({ name: key, group: "Clock", key, now: () => ({ label: `did ${key}`, turns: [[{ do: "pause" }]] }), ...more });
  const press = keyboard([act(" "), act("ArrowRight", { repeats: true }), act("u")]);
  assert.equal(press("u"), "did u");
  assert.equal(press("/"), "focus");
  assert.equal(press("x"), "");
  assert.equal(press("u", { target: new Element("input") }), "");
  assert.equal(press(" ", { target: new Element("button") }), "");
  assert.equal(press("u", { target: new Element("button") }), "did u");
  for (const held of ["ctrlKey", "metaKey", "altKey", "isComposing"]) assert.equal(press("u", { [held]: true }), "", held);
  assert.equal(press("u", { repeat: true }), "", "holding a key down does most things once");
  assert.equal(press("ArrowRight", { repeat: true }), "did ArrowRight");
});
