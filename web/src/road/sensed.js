// @ts-check
/** What the vehicle misses and makes up, asked from the service while its sensor may err. */

import { askJson } from "../core/http.js";
import { Latest } from "../core/latest.js";
import { sessionPath } from "../core/protocol.js";

/** @import { State } from "../core/state.js" */
/** @import { World } from "./world.js" */

/**
 * @typedef {object} Marks
 * @property {Set<string>} missed  ids of what is there, from the vehicle's row on, and not seen
 * @property {[number, number][]} madeUp  cells in which something is seen that is not there
 */

/** @typedef {{tick: number, missed: string[], seen: {cell: [number, number], real: boolean}[]}} Percept  as far as it is read */

/** What there is to mark of a percept. @param {Percept} percept @param {World} world @returns {Marks} */
export function marksOf({ missed, seen }, world) {
  const own = world.things.get("av-1")?.cell[1] ?? world.rows;
  return {
    missed: new Set(missed.filter((id) => (world.things.get(id)?.cell[1] ?? Infinity) <= own)),
    madeUp: seen.filter(({ real, cell }) => !real && cell[1] <= own).map(({ cell }) => cell),
  };
}

export class Sensed {
  /** @type {{of: World, marks: Marks} | null} */ #known = null;
  #asked = false;

  /** @param {typeof fetch} [http] */
  constructor(http = (...asked) => fetch(...asked)) {
    this.latest = new Latest({
      ask: (/** @type {{session: string, world: World}} */ { session, world }) =>
        askJson(`${sessionPath(session)}/percept?tick=${world.tick}`, { http }),
      tell: (/** @type {Percept} */ percept, { world }) => {
        this.#asked = false;
        this.#known = { of: world, marks: marksOf(percept, world) };
      },
      pauseMs: 0,
    });
  }

  /** The road is another one, or another tick. @param {State} state */
  update({ world, session, connection }) {
    if (!world || !session || world === this.#known?.of) return;
    this.#asked = world.sensor !== "perfect" && connection.phase === "live";
    if (this.#asked) this.latest.want({ session, world });
    else this.latest.drop();
  }

  /** Whether an answer is on its way, so that there will be more to draw. */
  get waiting() {
    return this.#asked;
  }

  /** What to mark on a road; null where that is not known. @param {World} world @returns {Marks | null} */
  of(world) {
    return this.#known?.of === world ? this.#known.marks : null;
  }
}
