// @ts-check
/**
 * Only the newest answer is told: of questions that overtake one another, and of those asked while somebody types
 * (after a pause, one at a time).
 */

/**
 * Returns a function: each call starts a request and returns a check whether it is still the newest; late answers to
 * older ones are dropped.
 * @returns {() => () => boolean}
 */
export function newestOnly() {
  let newest = 0;
  return () => {
    const mine = ++newest;
    return () => mine === newest;
  };
}

/**
 * @template Asked, Told
 * @typedef {object} Asking
 * @property {(asked: Asked) => Promise<Told>} ask
 * @property {(told: Told, asked: Asked) => void} tell
 * @property {number} pauseMs  how long the typing must have stopped
 * @property {(run: () => void, ms: number) => number} [later]
 * @property {(timer: number) => void} [never]
 */

/** @template Asked, Told */
export class Latest {
  /** @type {number | undefined} */ #timer;
  #asking = false;
  /** @type {{asked: Asked} | null} what is wanted and not told yet */ #wanted = null;

  /** @param {Asking<Asked, Told>} how */
  constructor({ ask, tell, pauseMs, later = (run, ms) => Number(setTimeout(run, ms)), never = (timer) => clearTimeout(timer) }) {
    this.ask = ask;
    this.tell = tell;
    this.pauseMs = pauseMs;
    this.later = later;
    this.never = never;
  }

  /** Want an answer to this, and to nothing asked before. @param {Asked} asked */
  want(asked) {
    this.#wanted = { asked };
    this.never(/** @type {number} */ (this.#timer));
    this.#timer = this.later(() => void this.#run(), this.pauseMs);
  }

  /** Want nothing any more. */
  drop() {
    this.#wanted = null;
    this.never(/** @type {number} */ (this.#timer));
  }

  async #run() {
    if (this.#asking) return; // whoever is asking sees what is wanted when the answer comes
    this.#asking = true;
    while (this.#wanted !== null) {
      const wanted = this.#wanted;
      const told = await this.ask(wanted.asked).catch(() => null);
      if (wanted !== this.#wanted) continue;
      this.#wanted = null;
      if (told !== null) this.tell(told, wanted.asked);
    }
    this.#asking = false;
  }
}
