// @ts-check
/** What was said before, walked with ↑ and ↓, kept in the browser where that is allowed. */

const KEY = "roadtalk.history";
const KEPT = 100;

/** A list of past sentences with a place in it; the place after the last is the draft being written. */
export class History {
  /** @type {string[]} oldest first */ said;
  /** @type {number} */ #place;
  #draft = "";

  /** @param {Pick<Storage, "getItem" | "setItem"> | null} storage  null: only for this visit */
  constructor(storage) {
    this.storage = storage;
    this.said = read(storage);
    this.#place = this.said.length;
  }

  /** @param {string} text */
  add(text) {
    this.said = [...this.said.filter((earlier) => earlier !== text), text].slice(-KEPT);
    this.#place = this.said.length;
    this.#draft = "";
    try {
      this.storage?.setItem(KEY, JSON.stringify(this.said));
    } catch {
      this.storage = null; // full or forbidden: the history lasts for this visit only
    }
  }

  /**
   * One sentence further back.
   * @param {string} current  what stands in the box, kept as the draft
   * @returns {string | null} null at the oldest
   */
  back(current) {
    if (this.#place === 0) return null;
    if (this.#place === this.said.length) this.#draft = current;
    this.#place -= 1;
    return this.said[this.#place];
  }

  /**
   * One sentence further on, and after the latest the draft.
   * @returns {string | null} null when already there
   */
  forth() {
    if (this.#place === this.said.length) return null;
    this.#place += 1;
    return this.#place === this.said.length ? this.#draft : this.said[this.#place];
  }
}

/** @param {Pick<Storage, "getItem" | "setItem"> | null} storage @returns {string[]} */
function read(storage) {
  try {
    const kept = JSON.parse(storage?.getItem(KEY) ?? "[]");
    return Array.isArray(kept) ? kept.filter((text) => typeof text === "string").slice(-KEPT) : [];
  } catch {
    return [];
  }
}
