import assert from "node:assert/strict";
import { test } from "node:test";

import { drawLine, tickAt, xOf } from "../../web/src/timeline/paint/line.js";

/** A canvas that writes down what is drawn on it, with the colour it was drawn in. */
function recording() {
  const drawn = [];
  const note = (what) => (...numbers) => drawn.push({ what, numbers, fill: pen.fillStyle, alpha: pen.globalAlpha });
  const pen = { globalAlpha: 1 };
  for (const what of ["clearRect", "fillRect", "beginPath", "roundRect", "fill", "stroke", "arc", "moveTo", "lineTo", "rect", "save", "restore", "translate", "fillText"]) pen[what] = note(what);
  return { pen, drawn };
}

const INKS = { band: "band", ahead: "ahead", text: "text", ink: "ink", surface: "surface", accent: "accent", danger: "danger", warn: "warn", good: "good" };
const line = (changes = {}) => ({ width: 500, span: 250, now: 200, at: null, over: null, events: [], ...changes });

test("places and ticks are each other's inverse", () => {
  for (const tick of [0, 1, 77, 249, 250]) assert.equal(tickAt(line(), xOf(line(), tick)), tick);
  assert.ok(xOf(line(), 250) <= 500);
});

test("a crash, an arrival and what was said are told apart by shape, not by colour alone", () => {
  const shapes = ["crash", "success", "command", "fork", "stuck"].map((kind) => {
    const { pen, drawn } = recording();
    drawLine(pen, line({ events: [{ tick: 50, kind }] }), INKS);
    const from = drawn.findIndex(({ what }) => what === "translate");
    return drawn.slice(from + 1, drawn.findIndex(({ what }) => what === "restore")).map(({ what, numbers }) => `${what}${numbers}`).join(" ");
  });
  assert.equal(new Set(shapes).size, 5);
});

test("of events that share a place the most important is drawn", () => {
  const { pen, drawn } = recording();
  drawLine(pen, line({ span: 10_000, now: 9_000, events: [{ tick: 500, kind: "command" }, { tick: 505, kind: "crash" }, { tick: 510, kind: "success" }] }), INKS);
  assert.equal(drawn.filter(({ what }) => what === "translate").length, 1);
  assert.equal(pen.strokeStyle, "danger");
});

test("a wait is a high bar, a detour a low one, and many in a pixel are fainter", () => {
  const { pen, drawn } = recording();
  drawLine(pen, line({ events: [{ tick: 10, kind: "wait", ticks: 5 }, { tick: 40, kind: "detour", ticks: 5 }] }), INKS);
  const wait = drawn.find(({ fill, what }) => fill === "warn" && what === "fillRect");
  const detour = drawn.find(({ fill, what }) => fill === "accent" && what === "fillRect");
  assert.ok(wait.numbers[3] > detour.numbers[3]);
  assert.equal(wait.alpha, 1);
  const crowded = recording();
  drawLine(crowded.pen, line({ span: 10_000, now: 9_000, events: [{ tick: 10, kind: "wait", ticks: 1 }] }), INKS);
  const faint = crowded.drawn.find(({ fill, what }) => fill === "warn" && what === "fillRect");
  assert.ok(faint.alpha < 0.5);
  assert.ok(faint.numbers[2] >= 1, "yet never nothing");
});

test("the head stands at the present, or in the accent's colour at what is looked at", () => {
  const head = (at) => {
    const { pen, drawn } = recording();
    drawLine(pen, line({ at }), INKS);
    return drawn.filter(({ what, numbers }) => what === "fillRect" && numbers[2] === 2).at(-1);
  };
  assert.deepEqual([head(null).fill, head(null).numbers[0]], ["ink", xOf(line(), 200) - 1]);
  assert.deepEqual([head(40).fill, head(40).numbers[0]], ["accent", xOf(line(), 40) - 1]);
});

test("figures stand in round steps and do not touch", () => {
  for (const span of [64, 250, 1_000, 10_000, 64_000]) {
    const { pen, drawn } = recording();
    drawLine(pen, line({ span, now: span }), INKS);
    const places = drawn.filter(({ what }) => what === "fillText").map(({ numbers }) => numbers[1]);
    assert.ok(places.length >= 3, `${span}: ${places.length}`);
    for (const [at, x] of places.slice(1).entries()) assert.ok(x - places[at] > 40, `${span}`);
  }
});
