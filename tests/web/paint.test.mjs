import assert from "node:assert/strict";
import { test } from "node:test";

import { drawChart } from "../../web/src/timeline/paint/chart.js";
import { drawGlyph } from "../../web/src/road/paint/glyphs.js";
import { cracksOf, paintBarrier, paintPothole, rimOf } from "../../web/src/road/paint/hazards.js";
import { drawCell, drawImpact, drawMove, drawRing, drawTrail, drawWait } from "../../web/src/road/paint/annotations.js";
import { drawOccupancy } from "../../web/src/road/paint/occupancy.js";
import { drawBoxes, drawForecast, drawHazards } from "../../web/src/road/paint/overlays.js";
import { drawSignal, paintWarning } from "../../web/src/road/paint/signals.js";
import { drawLines } from "../../web/src/road/paint/surface.js";
import { drawMarks, drawWeather } from "../../web/src/road/paint/weather.js";
import { drawPedestrian, paintWalkerShadow } from "../../web/src/road/paint/pedestrian.js";
import { KINDS, PALETTE, pose, recording } from "./recording.mjs";

const PAINTED = {
  pothole: (pen) => paintPothole(pen, "pothole-3", PALETTE),
  barrier: (pen) => paintBarrier(pen, "barrier-3", PALETTE),
  walker: (pen) => drawPedestrian(pen, "pedestrian-2", 0.3, false),
  "walker, hurt": (pen) => drawPedestrian(pen, "pedestrian-2", 0, true),
  "walker's shadow": (pen) => paintWalkerShadow(pen, PALETTE),
  trail: (pen) => drawTrail(pen, [[4, 20], [4, 19], [3, 18]], PALETTE),
  wait: (pen) => drawWait(pen, [4, 20], 0.4, PALETTE),
  move: (pen) => drawMove(pen, [4, 20], [3, 19], 0.4, PALETTE),
  ring: (pen) => drawRing(pen, "red", 0.5),
  cell: (pen) => drawCell(pen, "red"),
  impact: (pen) => drawImpact(pen, 0.5, PALETTE),
  brake: (pen) => drawSignal(pen, "brake"),
  left: (pen) => drawSignal(pen, "left"),
  right: (pen) => drawSignal(pen, "right"),
  warning: (pen) => paintWarning(pen),
  boxes: (pen) => drawBoxes(pen, KINDS.map((kind, at) => pose(kind, at, 2)), PALETTE),
  hazards: (pen) => drawHazards(pen, KINDS.map((kind, at) => pose(kind, at, 2)), PALETTE),
  ...Object.fromEntries([...KINDS, "something new"].map((kind) => [`sign of ${kind}`, (pen) => drawGlyph(pen, { kind, heading: "left" }, 40, 40, 20, PALETTE)])),
};

for (const [name, paint] of Object.entries(PAINTED)) {
  test(`${name}: something is drawn, at numbers, and the pen is handed back as it came`, () => {
    const { pen, drawn, count } = recording();
    paint(pen);
    assert.ok(count("fill") + count("stroke") + count("fillRect") + count("strokeRect") > 0);
    assert.equal(count("save"), count("restore"));
    for (const { what, values } of drawn) {
      for (const value of values.flat()) if (typeof value === "number") assert.ok(Number.isFinite(value), `${what}(${values})`);
    }
  });
}

test("a pothole looks the same whenever it is drawn, and no two are alike", () => {
  assert.deepEqual(rimOf("pothole-1"), rimOf("pothole-1"));
  assert.deepEqual(cracksOf("pothole-1"), cracksOf("pothole-1"));
  assert.notDeepEqual(rimOf("pothole-1"), rimOf("pothole-2"));
  assert.notDeepEqual(cracksOf("pothole-1"), cracksOf("pothole-2"));
});

test("cracks begin at the rim and stay in the cell", () => {
  for (let number = 1; number < 50; number++) {
    for (const crack of cracksOf(`pothole-${number}`)) {
      for (const [x, y] of crack) assert.ok(Math.hypot(x, y) < 0.75, `pothole-${number}: ${x}, ${y}`);
    }
  }
});

test("signs are told apart by their shape, not by their colour alone", () => {
  const shapes = KINDS.map((kind) => {
    const { pen, drawn } = recording();
    drawGlyph(pen, { kind, heading: "right" }, 0, 0, 20, PALETTE);
    return drawn.map(({ what, values }) => `${what}(${values})`).join(" ");
  });
  assert.equal(new Set(shapes).size, KINDS.length);
  const headed = ["left", "right"].map((heading) => {
    const { pen, drawn } = recording();
    drawGlyph(pen, { kind: "vehicle", heading }, 0, 0, 20, PALETTE);
    return JSON.stringify(drawn);
  });
  assert.notEqual(headed[0], headed[1]);
});

test("the matrix has a figure for each cell, one where something is", () => {
  const things = new Map([pose("av", 4, 20), pose("vehicle", 2, 3), pose("pothole", 0, 0)].map(({ thing }) => [thing.id, thing]));
  const { pen, drawn } = recording();
  drawOccupancy(pen, { columns: 8, rows: 30, things }, { x: 0, y: 0, across: 16, along: 14 }, PALETTE);
  const figures = drawn.filter(({ what }) => what === "fillText");
  assert.equal(figures.length, 240);
  assert.equal(figures.filter(({ values }) => values[0] === "1").length, 3);
  const grounds = drawn.filter(({ what }) => what === "fill").map(({ fill }) => fill);
  assert.deepEqual([...grounds].sort(), ["kind-av", "kind-pothole", "kind-vehicle"]);
});

test("a crash in the matrix shows the vehicle", () => {
  const things = new Map([pose("av", 4, 20), pose("vehicle", 4, 20)].map(({ thing }) => [thing.id, thing]));
  const { pen, drawn } = recording();
  drawOccupancy(pen, { columns: 8, rows: 30, things }, { x: 0, y: 0, across: 16, along: 14 }, PALETTE);
  assert.deepEqual(drawn.filter(({ what }) => what === "fill").map(({ fill }) => fill), ["kind-av"]);
});

test("a ghost stands where a mover will be, and none where it stays or is not known", () => {
  const poses = [pose("vehicle", 2, 5), pose("pedestrian", 6, 9), pose("av", 4, 20)];
  const { pen, drawn } = recording();
  drawForecast(pen, poses, [{ "vehicle-1": [3, 5], "av-1": [4, 19] }, { "vehicle-1": [4, 5] }, { "vehicle-1": [4, 5] }], PALETTE);
  const ghosts = drawn.filter(({ what }) => what === "roundRect");
  assert.deepEqual(ghosts.map(({ values }) => values[0] + values[2] / 2), [3, 4]);
  const clear = drawn.filter(({ what }) => what === "fill").map(({ alpha }) => alpha);
  assert.ok(clear[0] > clear[1], "what is farther off is fainter");
});

test("hazards are brought out, and nothing that moves", () => {
  const { pen, drawn } = recording();
  drawHazards(pen, KINDS.map((kind, at) => pose(kind, at, 2)), PALETTE);
  assert.deepEqual(drawn.filter(({ what }) => what === "stroke").map(({ stroke }) => stroke), ["road-pothole", "road-barrier"]);
});

test("the chart has a bar for each tick that is known and not nothing; a lost road is the tallest and told by colour", () => {
  const items = new Map([[98, { blocked: 2, ticks: 1 }], [97, { blocked: 0, ticks: 0 }], [96, null], [99, { blocked: 6, ticks: null, lost: true }]]);
  for (const [figure, fills] of [["blocked", ["kind-pothole", "danger"]], ["ticks", ["focus", "danger"]]]) {
    const { pen, drawn } = recording();
    drawChart(pen, { width: 120, height: 60 }, figure, 100, (tick) => items.get(tick), PALETTE);
    const bars = drawn.filter(({ what }) => what === "fillRect").slice(1);
    assert.deepEqual(bars.map(({ fill }) => fill), fills, figure);
    assert.ok(bars[0].values[3] < bars[1].values[3]);
    assert.ok(bars.every(({ values: [x, y, width, height] }) => x >= 0 && y >= 0 && x + width <= 120.5 && y + height <= 60));
  }
});

test("the road's ends are drawn only where they are seen", () => {
  const road = { columns: 8, rows: 30 };
  const view = { width: 600, height: 600, cell: 60, left: 60, top: 0, rows: 10 };
  const drawnAt = (top) => {
    const { pen, drawn } = recording();
    drawLines(pen, view, top, road, PALETTE);
    return drawn.length;
  };
  assert.ok(drawnAt(-1) > drawnAt(12));
});

test("weather and light lie over the road in their own colours; clear weather by day draws nothing", () => {
  const view = { width: 400, height: 320, cell: 40 };
  const palette = { veils: Object.fromEntries(["rain", "fog", "snow", "dusk", "dawn", "night", "drops"].map((name) => [name, `veil-${name}`])) };
  const plain = recording();
  drawWeather(plain.pen, view, { weather: "clear", light: "day" }, 3, palette);
  assert.equal(plain.drawn.length, 0);
  for (const conditions of [{ weather: "fog", light: "day" }, { weather: "clear", light: "night" }]) {
    const { pen, drawn } = recording();
    drawWeather(pen, view, conditions, 3, palette);
    assert.deepEqual(drawn.map(({ what, fill }) => [what, fill]), [["fillRect", `veil-${conditions.weather === "fog" ? "fog" : "night"}`]]);
    assert.equal(pen.globalAlpha, 1);
  }
  const falling = [3, 3.5].map((time) => {
    const { pen, drawn, count } = recording();
    drawWeather(pen, view, { weather: "rain", light: "day" }, time, palette);
    assert.ok(count("lineTo") > 20);
    return drawn.filter(({ what }) => what === "moveTo").map(({ values }) => values[1]);
  });
  assert.notDeepEqual(falling[0], falling[1]);
});

test("what is missed is ringed where it is, and what is made up is crossed out where it is seen", () => {
  const { pen, drawn, count } = recording();
  const marks = { missed: new Set(["pothole-1"]), madeUp: [[2, 7]] };
  drawMarks(pen, [pose("pothole", 4, 3), pose("vehicle", 5, 3)], marks, PALETTE);
  assert.deepEqual(drawn.filter(({ what }) => what === "arc").map(({ values }) => values.slice(0, 2)), [[4, 3]]);
  assert.equal(count("lineTo"), 2);
});
