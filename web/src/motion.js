// @ts-check
/**
 * Where things are seen between two ticks. Presentation only: no rule of the world depends on it.
 *
 * Each thing glides from where it is seen now to its new cell along f(t) = t²(3 − 2t) within one
 * step, so a tick that comes a little early or late shows no jump. What appears grows, what is
 * removed fades, and a new episode is cut to, not glided to.
 */

import { egoOf } from "./world.js";

/** @import { World, Thing } from "./world.js" */

/**
 * @typedef {object} Pose
 * @property {Thing} thing
 * @property {number} column  of the centre, in cells; whole numbers are cell centres
 * @property {number} row
 * @property {number} facing  radians, clockwise from facing right
 * @property {number} scale  1 but while appearing
 * @property {number} alpha  1 but while disappearing
 * @property {number} stride  how far into its present step, 0–1
 */

/**
 * @typedef {object} Actor
 * @property {Thing} thing
 * @property {[number, number]} from
 * @property {[number, number]} to
 * @property {number} turnFrom
 * @property {number} turnTo
 * @property {number} start  ms
 * @property {number} bornAt  ms
 * @property {number | null} goneAt  ms
 */

const APPEAR_MS = 320;
const VANISH_MS = 240;
const LONGEST_GLIDE_CELLS = 2.5;
const TRAIL_CELLS = 14;
const STEER_RAD = 0.3;
/** The part of a step in which a mover turns round. */
const TURN_SHARE = 0.45;

/**
 * The easing of the whole project: 0 → 0, 1 → 1, at rest at both ends.
 * @param {number} t  clamped to [0, 1]
 */
export function ease(t) {
  const x = Math.min(1, Math.max(0, t));
  return x * x * (3 - 2 * x);
}

/** The things on the road as they are seen, fed with worlds. */
export class Stage {
  /** @type {Map<string, Actor>} */ actors = new Map();
  /** @type {World | null} */ world = null;
  /** @type {[number, number][]} cells the vehicle has left in this episode, oldest first */ trail = [];
  /** @type {number} when the latest world came, ms */ receivedAt = 0;
  #glideMs = 0;

  /**
   * Take in a new world.
   * @param {World} world
   * @param {number} now  ms
   * @param {boolean} still  whether the person asked for reduced motion: then everything is cut to
   */
  receive(world, now, still) {
    if (world === this.world) return;
    const cut = still || this.#isCut(world);
    if (this.world === null || world.episode !== this.world.episode || this.#jumped(world)) this.trail = [];
    this.#follow(world);
    const actors = new Map();
    for (const thing of world.things.values()) {
      actors.set(thing.id, this.#actor(thing, this.actors.get(thing.id), now, cut));
    }
    if (!cut) {
      for (const [id, actor] of this.actors) {
        if (actors.has(id) || (actor.goneAt !== null && now - actor.goneAt > VANISH_MS)) continue;
        actors.set(id, { ...actor, goneAt: actor.goneAt ?? now });
      }
    }
    this.actors = actors;
    this.#glideMs = world.stepS * 1000;
    this.world = world;
    this.receivedAt = now;
  }

  /**
   * Everything as seen at a time.
   * @param {number} now  ms
   * @returns {Pose[]}
   */
  poses(now) {
    return [...this.actors.values()]
      .filter(({ goneAt }) => goneAt === null || now - goneAt < VANISH_MS)
      .map((actor) => this.#pose(actor, now));
  }

  /**
   * One thing as seen at a time.
   * @param {string} id
   * @param {number} now  ms
   */
  pose(id, now) {
    const actor = this.actors.get(id);
    return actor ? this.#pose(actor, now) : null;
  }

  /** How far the present step is, 0–1. @param {number} now  ms */
  progress(now) {
    return this.#glideMs === 0 ? 1 : Math.min(1, Math.max(0, (now - this.receivedAt) / this.#glideMs));
  }

  /** Whether anything is still on its way. @param {number} now  ms */
  moving(now) {
    return now - this.receivedAt < Math.max(this.#glideMs, APPEAR_MS, VANISH_MS);
  }

  /** @param {World} world */
  #isCut(world) {
    return this.world === null || world.episode !== this.world.episode || this.#jumped(world);
  }

  /** @param {World} world */
  #jumped(world) {
    const before = this.world && egoOf(this.world);
    const after = egoOf(world);
    if (!before || !after) return before !== after;
    const distance = Math.hypot(after.cell[0] - before.cell[0], after.cell[1] - before.cell[1]);
    return distance > LONGEST_GLIDE_CELLS;
  }

  /** @param {World} world */
  #follow(world) {
    const ego = egoOf(world);
    if (!ego) return;
    const last = this.trail.at(-1);
    if (last && last[0] === ego.cell[0] && last[1] === ego.cell[1]) return;
    this.trail = [...this.trail, ego.cell].slice(-TRAIL_CELLS);
  }

  /**
   * @param {Thing} thing
   * @param {Actor | undefined} old
   * @param {number} now
   * @param {boolean} cut
   * @returns {Actor}
   */
  #actor(thing, old, now, cut) {
    const turnTo = thing.heading === "left" ? Math.PI : 0;
    if (cut || !old || old.goneAt !== null) {
      const bornAt = cut ? -Infinity : now;
      return { thing, from: thing.cell, to: thing.cell, turnFrom: turnTo, turnTo, start: now, bornAt, goneAt: null };
    }
    const seen = this.#pose(old, now);
    /** @type {[number, number]} */
    const from = [seen.column, seen.row];
    return { ...old, thing, from, to: thing.cell, turnFrom: old.turnTo, turnTo, start: now };
  }

  /** @param {Actor} actor @param {number} now @returns {Pose} */
  #pose(actor, now) {
    const { from, to, turnFrom, turnTo, start, bornAt, goneAt, thing } = actor;
    const t = this.#glideMs === 0 ? 1 : Math.min(1, Math.max(0, (now - start) / this.#glideMs));
    const part = ease(t);
    const facing =
      thing.kind === "av"
        ? Math.sign(to[0] - from[0]) * STEER_RAD * 4 * t * (1 - t)
        : turnFrom + (turnTo - turnFrom) * ease(t / TURN_SHARE);
    return {
      thing,
      column: from[0] + (to[0] - from[0]) * part,
      row: from[1] + (to[1] - from[1]) * part,
      facing,
      scale: overshoot(Math.min(1, (now - bornAt) / APPEAR_MS)),
      alpha: goneAt === null ? 1 : Math.max(0, 1 - (now - goneAt) / VANISH_MS),
      stride: t,
    };
  }
}

/**
 * Growing from nothing to full size, a little beyond it on the way.
 * @param {number} t
 */
function overshoot(t) {
  if (!(t < 1)) return 1;
  const x = t - 1;
  return 1 + 2.2 * x ** 3 + 1.2 * x ** 2;
}
