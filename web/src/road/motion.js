// @ts-check
/**
 * Where things are seen between two ticks, along the very ways that the rules judge.
 *
 * Everything goes in a straight line from cell to cell, all of it by the same share f(t) = t²(3 − 2t) of its way at
 * the same time. A tick that comes early finds things on their way: they finish it a little faster, and cut no corner.
 * In a crash everything stops at the first contact, and stands there while the result does. What appears grows,
 * what is removed fades. A jump of more than one tick is shown at once, without animation.
 */

import { boxOf, firstContact, meeting } from "./collisionGeometry.js";
import { egoOf } from "./world.js";

/** @import { World, Thing } from "./world.js" */

/**
 * @typedef {object} Pose
 * @property {Thing} thing
 * @property {number} column  of the centre, in cells; whole numbers are cell centres
 * @property {number} row
 * @property {number} facing  radians, clockwise from facing right; between 0 and π while it turns round
 * @property {number} scale  1 but while appearing
 * @property {number} alpha  1 but while disappearing
 * @property {number} stride  how far into its present step, 0–1; 0 while it makes none
 */

/**
 * @typedef {object} Actor
 * @property {Thing} thing
 * @property {[number, number]} prior  where the step before the present one began
 * @property {[number, number]} from  where the present step began
 * @property {[number, number]} to
 * @property {number} turnFrom
 * @property {number} turnTo
 * @property {number} bornAt  ms
 * @property {number | null} goneAt  ms
 */

const APPEAR_MS = 320;
const VANISH_MS = 240;
const LONGEST_GLIDE_CELLS = 2.5;
const TRAIL_CELLS = 14;
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
  /** When things last appeared or vanished, ms; also between two ticks. */
  #changedAt = 0;
  #glideMs = 0;
  /** Where in the present step things were when the world came; below 0 they were in the step before. */
  #begun = 0;
  /** The share of the present step's way at which a crash stops it. */
  #stop = 1;
  /** @type {[number, number] | null} where it was hit */ #touch = null;

  /**
   * Take in a new world.
   * @param {World} world
   * @param {number} now  ms
   * @param {boolean} still  whether the person asked for reduced motion: then nothing is seen on its way
   */
  receive(world, now, still) {
    const before = this.world;
    if (world === before) return;
    if (before === null || world.episode !== before.episode || this.#jumped(world)) this.trail = [];
    this.#follow(world);
    const stands = before?.status === "crash" && world.status === "crash" && world.episode === before.episode;
    const same = stands || (before !== null && world.tick === before.tick && world.status === before.status);
    const cut = this.#isCut(world) || (!same && this.#stop < 1);
    const going = same && !cut;
    const head = this.#head(now);
    const actors = new Map();
    for (const thing of world.things.values()) {
      const old = this.actors.get(thing.id);
      actors.set(thing.id, going ? this.#kept(thing, old, now, still) : this.#actor(thing, old, now, cut, still));
    }
    if (!cut && !still) {
      for (const [id, actor] of this.actors) {
        if (actors.has(id) || (actor.goneAt !== null && now - actor.goneAt > VANISH_MS)) continue;
        actors.set(id, { ...actor, goneAt: actor.goneAt ?? now });
      }
    }
    this.actors = actors;
    this.world = world;
    this.#changedAt = now;
    if (!going) {
      this.#glideMs = still ? 0 : glideMs(world);
      this.#begun = cut ? 0 : Math.max(-1, head - 1);
      this.receivedAt = now;
      this.#collide(before, world, cut);
    }
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
    return Math.max(0, this.#head(now));
  }

  /**
   * Where the vehicle was hit, once it was.
   * @param {number} now  ms
   */
  touch(now) {
    return ease(this.#head(now)) >= this.#stop ? this.#touch : null;
  }

  /** Whether anything is still on its way. @param {number} now  ms */
  moving(now) {
    return now - this.receivedAt < this.#glideMs || now - this.#changedAt < Math.max(APPEAR_MS, VANISH_MS);
  }

  /** Where in the present step things are, up to 1; below 0 in the one before. @param {number} now  ms */
  #head(now) {
    if (this.#glideMs === 0) return 1;
    const gone = Math.min(1, Math.max(0, (now - this.receivedAt) / this.#glideMs));
    return this.#begun + (1 - this.#begun) * gone;
  }

  /** Whether no single tick leads to a world. @param {World} world */
  #isCut(world) {
    const before = this.world;
    if (before === null || world.episode !== before.episode || this.#jumped(world)) return true;
    const stood = before.status === "crash" && world.status === "crash";
    return !stood && Math.abs(world.tick - before.tick) > 1;
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
   * See when the vehicle is hit on its way to a crash, and where.
   * @param {World | null} before
   * @param {World} world
   * @param {boolean} cut
   */
  #collide(before, world, cut) {
    const ego = egoOf(world);
    this.#stop = 1;
    // Who comes to a crash that has been knows only its cell.
    this.#touch = ego && world.status === "crash" ? ego.cell : null;
    const own = ego && this.actors.get(ego.id);
    if (!own || cut || world.status !== "crash" || before?.status !== "running") return;
    const along = (/** @type {Actor} */ { thing, from, to }) => ({ kind: thing.kind, from, to });
    for (const actor of this.actors.values()) {
      if (actor === own || actor.goneAt !== null) continue;
      const share = firstContact(along(own), along(actor));
      if (share === null || share >= this.#stop) continue;
      this.#stop = share;
      const [one, other] = [own, actor].map(({ thing, from, to }) => boxOf(thing.kind, between(from, to, share)));
      this.#touch = meeting(one, other);
    }
  }

  /**
   * A thing that makes a new step.
   * @param {Thing} thing
   * @param {Actor | undefined} old
   * @param {number} now
   * @param {boolean} cut
   * @param {boolean} still
   * @returns {Actor}
   */
  #actor(thing, old, now, cut, still) {
    const { cell } = thing;
    const turnTo = thing.heading === "left" ? Math.PI : 0;
    if (cut || !old || old.goneAt !== null) {
      const bornAt = cut || still ? -Infinity : now;
      return { thing, prior: cell, from: cell, to: cell, turnFrom: turnTo, turnTo, bornAt, goneAt: null };
    }
    return { ...old, thing, prior: old.from, from: old.to, to: cell, turnFrom: old.turnTo, turnTo };
  }

  /**
   * A thing where nothing but time, or what a person did, has passed: it goes on with its step.
   * @param {Thing} thing
   * @param {Actor | undefined} old
   * @param {number} now
   * @param {boolean} still
   * @returns {Actor}
   */
  #kept(thing, old, now, still) {
    const stays = old && old.goneAt === null && old.to[0] === thing.cell[0] && old.to[1] === thing.cell[1];
    return stays ? { ...old, thing } : this.#actor(thing, undefined, now, false, still);
  }

  /** @param {Actor} actor @param {number} now @returns {Pose} */
  #pose(actor, now) {
    const { prior, from, to, turnFrom, turnTo, bornAt, goneAt, thing } = actor;
    const head = this.#head(now);
    const [start, end] = head < 0 ? [prior, from] : [from, to];
    const t = head < 0 ? head + 1 : head;
    const part = head < 0 ? ease(t) : Math.min(ease(t), this.#stop);
    const [column, row] = between(start, end, part);
    return {
      thing,
      column,
      row,
      facing: turnFrom + (turnTo - turnFrom) * ease(Math.max(0, head) / TURN_SHARE),
      scale: grown(Math.min(1, (now - bornAt) / APPEAR_MS)),
      alpha: goneAt === null ? 1 : Math.max(0, 1 - (now - goneAt) / VANISH_MS),
      stride: start[0] === end[0] && start[1] === end[1] ? 0 : t,
    };
  }
}

/**
 * How long a step is seen to take: as long as the next tick takes to come.
 * @param {World} world
 */
function glideMs({ stepS, pace, paused }) {
  if (paused) return stepS * 1000;
  return pace === "max" ? 0 : (stepS * 1000) / pace;
}

/**
 * @param {[number, number]} from
 * @param {[number, number]} to
 * @param {number} share
 * @returns {[number, number]}
 */
function between(from, to, share) {
  return [from[0] + (to[0] - from[0]) * share, from[1] + (to[1] - from[1]) * share];
}

/**
 * Growing from nothing to full size, and never beyond it.
 * @param {number} t
 */
function grown(t) {
  return t < 1 ? 1 + (t - 1) ** 3 : 1;
}
