// @ts-check
/**
 * What is read aloud to those who listen: replies and how episodes end, never every tick.
 *
 * A sentence that comes too soon after another waits, and only the newest of those waiting is read.
 */

import { render } from "../../vendor/lit-html.js";

/** @import { Panel } from "../panels/index.js" */

const APART_MS = 1_500;

/** @param {HTMLElement} host  a polite live region @returns {Panel} */
export function createAnnouncer(host) {
  /** @type {string | null} */ let waiting = null;
  let timer = 0;

  function speak() {
    if (waiting === null) {
      timer = 0;
      return;
    }
    render(waiting, host);
    waiting = null;
    timer = setTimeout(speak, APART_MS);
  }

  return {
    update({ announcement }, before) {
      if (announcement === null || announcement === before.announcement) return;
      waiting = announcement;
      if (timer === 0) speak();
    },
  };
}
