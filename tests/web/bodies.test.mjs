// The page draws the boxes that the rules judge: sizes, ways and contacts are those of `bodies.json`, which
// `python -m tests.sim.contacts --write` makes of `sim/bodies.py` and of the poses of the window.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";

import { boxOf, firstContact, SIZES } from "../../web/src/road/collisionGeometry.js";
import { Stage } from "../../web/src/road/motion.js";
import { cracksOf, paintBarrier, paintPothole } from "../../web/src/road/paint/hazards.js";
import { paintWarning } from "../../web/src/road/paint/signals.js";
import { drawThing } from "../../web/src/road/paint/things.js";
import { lookOf, paintEgo, paintVehicle } from "../../web/src/road/paint/vehicle.js";
import { drawPedestrian } from "../../web/src/road/paint/pedestrian.js";
import { STEPS } from "../../web/src/why/forecast.js";
import { worldAfter, worldOf } from "../../web/src/road/world.js";
import { tick, wireState } from "./fakes.mjs";

const TOLD = JSON.parse(readFileSync(new URL("bodies.json", import.meta.url), "utf-8"));
const STEP_MS = 500;
const FRAMES = 30;
const OWN = [4, 20];

test("sizes are the rules' own", () => {
  const sizes = Object.fromEntries(Object.entries(SIZES).map(([kind, { across, along }]) => [kind, [across, along]]));
  assert.deepEqual(sizes, TOLD.sizes);
});

/** A stage on which one case is played from time 0. */
function played([kind, move, across, along, step], still = false) {
  const id = `${kind}-1`;
  const cell = [OWN[0] + across, OWN[1] + along];
  const thing = { id, kind, cell, heading: step < 0 ? "left" : "right", disabled: false };
  const fixed = kind === "pothole" || kind === "barrier";
  const state = wireState({ movers: fixed ? [] : [thing], hazards: fixed ? [{ id, kind, cell }] : [] });
  const to = [OWN[0] + STEPS[move][0], OWN[1] + STEPS[move][1]];
  const end = [cell[0] + step, cell[1]];
  const crashed = firstContact({ kind: "av", from: OWN, to }, { kind, from: cell, to: end }) !== null;
  const status = crashed ? "crash" : "running";
  const events = crashed ? [{ type: "crashed", ids: [id], cell: to }] : [];
  const before = worldOf(state);
  const after = worldAfter(before, tick({ status, events, vehicles: { "av-1": to }, moved: step ? { [id]: end } : {} }));
  const stage = new Stage();
  stage.receive(before, -9000, still);
  stage.receive(after, 0, still);
  return { stage, after, id, crashed };
}

const placesAt = (stage, id, now) =>
  ["av-1", id].flatMap((name) => {
    const { column, row } = stage.pose(name, now);
    return [column - OWN[0], row - OWN[1]];
  });

const close = (one, other, of) => one.forEach((value, at) => assert.ok(Math.abs(value - other[at]) < 1e-8, `${of}: ${one} is not ${other}`));

const deep = ([a, b, c, d], [e, f, g, h]) => Math.min(c - e, g - a, d - f, h - b);

test("every move beside everything within two cells is seen where the window draws it", () => {
  assert.equal(TOLD.cases.length, 1152);
  for (const told of TOLD.cases) {
    const { stage, id } = played(told);
    const seen = TOLD.phases.flatMap((phase) => placesAt(stage, id, phase * STEP_MS));
    close(seen, told[5], told.slice(0, 5));
  }
});

test("the vehicle is drawn over nothing, and touches only what it crashes into", () => {
  for (const told of TOLD.cases) {
    const { stage, id, crashed } = played(told);
    let least = Infinity;
    for (let frame = 0; frame <= FRAMES; frame++) {
      const [own, other] = ["av-1", id].map((name) => {
        const { thing, column, row } = stage.pose(name, (frame / FRAMES) * STEP_MS);
        return boxOf(thing.kind, [column, row]);
      });
      const apart = -deep(own, other);
      assert.ok(apart > -1e-9, `${told.slice(0, 5)} at frame ${frame}`);
      least = Math.min(least, apart);
    }
    assert.equal(least < 1e-9, crashed, `${told.slice(0, 5)}`);
    assert.equal(stage.touch(STEP_MS) !== null, crashed);
  }
});

test("what crashed stands where it touched for as long as the result does, and also where motion is reduced", () => {
  const told = TOLD.cases.find(([kind, move, across, along, step]) => kind === "vehicle" && move === "forward_left" && across === -1 && along === 0 && step === 1);
  for (const still of [false, true]) {
    const { stage, after, id } = played(told, still);
    const there = placesAt(stage, id, STEP_MS);
    close(there, told[5].slice(4), "touching");
    stage.receive({ ...after, tick: after.tick + 1 }, STEP_MS, still);
    for (const now of [STEP_MS, 1.5 * STEP_MS, 9 * STEP_MS]) close(placesAt(stage, id, now), there, "standing");
    assert.notEqual(stage.touch(9 * STEP_MS), null);
    stage.receive({ ...after, episode: after.episode + 1, status: "running" }, 10 * STEP_MS, still);
    assert.equal(stage.touch(10 * STEP_MS), null);
  }
});

test("a tick that comes early cuts no corner", () => {
  const { stage, after, id } = played(["vehicle", "forward", 2, 0, 0]);
  const next = worldAfter(after, tick({ tick: after.tick + 1, vehicles: { "av-1": [OWN[0] + 1, OWN[1] - 1] }, moved: {} }));
  stage.receive(next, 0.6 * STEP_MS, false);
  for (let frame = 0; frame <= FRAMES; frame++) {
    const [column, row] = placesAt(stage, id, (0.6 + frame / FRAMES) * STEP_MS);
    assert.ok(column === 0 || row === -1, `${column}, ${row} is on neither way`);
  }
  close(placesAt(stage, id, 1.6 * STEP_MS).slice(0, 2), [1, -1], "there");
});

test("things glide as fast as ticks come", () => {
  const lasting = (changes) => {
    const stage = new Stage();
    const before = { ...worldOf(wireState()), ...changes };
    stage.receive(before, 0, false);
    stage.receive(worldAfter(before, tick()), 0, false);
    let now = 0;
    while (stage.pose("av-1", now).row !== 19) now += 5;
    return now;
  };
  assert.equal(lasting({}), STEP_MS);
  assert.equal(lasting({ pace: 2 }), STEP_MS / 2);
  assert.equal(lasting({ pace: "max" }), 0);
  assert.equal(lasting({ pace: 4, paused: true }), STEP_MS);
});

test("ticks that nobody sent are not glided through", () => {
  const before = worldOf(wireState());
  const stage = new Stage();
  stage.receive(before, 0, false);
  stage.receive(worldAfter(before, tick({ tick: 13, vehicles: { "av-1": [5, 19] } })), 0, false);
  close(placesAt(stage, "vehicle-1", 1).slice(0, 2), [1, -1], "cut");
});

/** A pen that keeps the bounds of what is filled and stroked in cells, shadows, light and what is clipped away aside. */
function measuring() {
  let [path, bounds] = [[], [Infinity, Infinity, -Infinity, -Infinity]];
  let now = { matrix: [1, 0, 0, 1, 0, 0], clipped: false, lineWidth: 1 };
  const kept = [];
  const point = (x, y) => {
    const [a, b, c, d, e, f] = now.matrix;
    path.push([a * x + c * y + e, b * x + d * y + f]);
  };
  const around = (x, y, rx, ry, tilt = 0) => {
    for (let at = 0; at < 48; at++) {
      const [u, v] = [rx * Math.cos((at * Math.PI) / 24), ry * Math.sin((at * Math.PI) / 24)];
      point(x + u * Math.cos(tilt) - v * Math.sin(tilt), y + u * Math.sin(tilt) + v * Math.cos(tilt));
    }
  };
  const times = ([a, b, c, d, e, f], [g, h, i, j, k, l]) => [a * g + c * h, b * g + d * h, a * i + c * j, b * i + d * j, a * k + c * l + e, b * k + d * l + f];
  const take = (margin) => {
    if (now.clipped || pen.shadowColor) return;
    for (const [x, y] of path) bounds = [Math.min(bounds[0], x - margin), Math.min(bounds[1], y - margin), Math.max(bounds[2], x + margin), Math.max(bounds[3], y + margin)];
  };
  const gradient = { addColorStop() {} };
  const pen = {
    lineWidth: 1, globalAlpha: 1, fillStyle: "", strokeStyle: "", lineCap: "", lineJoin: "",
    save: () => void kept.push({ ...now, lineWidth: pen.lineWidth, shadow: pen.shadowColor }),
    restore: () => { now = kept.pop(); pen.lineWidth = now.lineWidth; pen.shadowColor = now.shadow; },
    translate: (x, y) => { now.matrix = times(now.matrix, [1, 0, 0, 1, x, y]); },
    rotate: (by) => { now.matrix = times(now.matrix, [Math.cos(by), Math.sin(by), -Math.sin(by), Math.cos(by), 0, 0]); },
    scale: (x, y) => { now.matrix = times(now.matrix, [x, 0, 0, y, 0, 0]); },
    getTransform: () => ({ a: 40 }),
    clip: () => { now.clipped = true; },
    beginPath: () => { path = []; },
    closePath() {},
    moveTo: point,
    lineTo: point,
    quadraticCurveTo: (cx, cy, x, y) => { point(x, y); point((cx + x) / 2, (cy + y) / 2); },
    roundRect: (x, y, width, height) => { for (const [u, v] of [[0, 0], [1, 0], [0, 1], [1, 1]]) point(x + u * width, y + v * height); },
    arc: (x, y, radius) => around(x, y, radius, radius),
    ellipse: (x, y, rx, ry, tilt) => around(x, y, rx, ry, tilt),
    fillRect() {},
    fill: () => take(0),
    stroke: () => take(pen.lineWidth / 2),
    createLinearGradient: () => gradient,
    createRadialGradient: () => gradient,
  };
  return { pen, bounds: () => bounds };
}

const PALETTE = new Proxy({ kinds: {}, roadKinds: {}, lamps: 0 }, { get: (target, name) => target[name] ?? String(name) });
const names = (kind) => Array.from({ length: 40 }, (_, at) => `${kind}-${at + 1}`);

test("all that is solid of a thing lies within its box, and vehicles fill theirs", () => {
  const check = (kind, paint, { turned = false, full = false } = {}) => {
    const { pen, bounds } = measuring();
    paint(pen);
    const { across, along } = SIZES[kind];
    const [x, y] = (turned ? [along, across] : [across, along]).map((side) => side / 2);
    const seen = bounds();
    [-x, -y, x, y].forEach((side, at) => {
      const beyond = (seen[at] - side) * (at < 2 ? -1 : 1);
      assert.ok(beyond < 1e-9, `${kind}: ${seen} in ${[x, y]}`);
      if (full) assert.ok(beyond > -0.012, `${kind}: ${seen} does not fill ${[x, y]}`);
    });
  };
  for (const id of names("vehicle")) check("vehicle", (pen) => paintVehicle(pen, lookOf(id, false)), { full: true });
  check("vehicle", (pen) => paintWarning(pen));
  check("av", (pen) => paintEgo(pen), { turned: true, full: true });
  for (const id of names("pothole")) check("pothole", (pen) => paintPothole(pen, id, PALETTE));
  for (const id of names("barrier")) check("barrier", (pen) => paintBarrier(pen, id, PALETTE));
  for (const id of names("pedestrian")) {
    for (const stride of [0, 0.25, 0.5, 0.75]) {
      for (const facing of [0, 0.8, Math.PI / 2, Math.PI]) {
        check("pedestrian", (pen) => { pen.rotate(facing); drawPedestrian(pen, id, stride, stride === 0); });
      }
    }
  }
});

test("a pothole's cracks stay within its box", () => {
  for (const id of names("pothole")) {
    for (const [x, y] of cracksOf(id).flat()) assert.ok(Math.max(Math.abs(x), Math.abs(y)) <= SIZES.pothole.across / 2, id);
  }
});

test("nothing turns out of its box: vehicles turn end for end, the autonomous one never", () => {
  const angles = (kind, facing) => {
    const { pen } = measuring();
    const turned = [];
    const { rotate } = pen;
    pen.rotate = (by) => { turned.push(by); rotate(by); };
    const sprites = { stamp() {} };
    const pose = { thing: { id: `${kind}-1`, kind, disabled: false }, column: 0, row: 0, facing, scale: 1, alpha: 1, stride: 0 };
    drawThing({ pen, sprites, palette: PALETTE, progress: 0.5, now: 0 }, pose, null);
    return turned;
  };
  for (const facing of [0, 0.4, 1.5, Math.PI]) {
    for (const by of angles("vehicle", facing)) assert.ok(by === 0 || by === Math.PI, `${by}`);
    for (const by of angles("av", facing)) assert.equal(by, -Math.PI / 2);
  }
});
