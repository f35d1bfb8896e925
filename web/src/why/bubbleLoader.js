// @ts-check
/** The bubble as those know it who point at something (`bubble.js`), fetched when something is first pointed at. */

import { same } from "../road/hitTest.js";
import { onDemand, styled } from "../core/lazy.js";

/** @import { Places } from "../road/hitTest.js" */
/** @import { Page } from "../core/page.js" */
/** @import { Cell } from "../core/protocol.js" */
/** @import { Bubble } from "./bubble.js" */
/** @import { Panel } from "../panels/index.js" */

/**
 * @typedef {{kind: "cell", cell: Cell, id: string | null, places: Places, frame: HTMLElement}
 *   | {kind: "decision", tick: number, frame: HTMLElement}} Target  `frame`: the view or the line it is in
 */

/**
 * @typedef {object} Card
 * @property {(target: Target, pin?: boolean, into?: boolean) => void} show  pinned, it stays until it is sent away;
 *   `into`: the focus goes into it
 * @property {() => void} hide
 * @property {() => void} leave  hide it soon, unless the pointer comes back
 * @property {() => void} stay
 * @property {() => boolean} focus  go into it; false where there is nothing to press
 * @property {() => Target | null} target
 * @property {() => boolean} pinned
 */

/** @param {HTMLElement} host @param {Page} page @returns {Panel & Card} */
export function createCard(host, page) {
  /** @type {Bubble | null} */ let bubble = null;
  /** What is to be shown as soon as it has come. */
  let wish = 0;
  const wanted = onDemand(page, async () => {
    const [{ createBubble }] = await Promise.all([import("./bubble.js"), styled("bubble")]);
    return (bubble = createBubble(host, page));
  });

  /** Nothing is wished for any more. @param {(bubble: Bubble) => void} then */
  function instead(then) {
    wish += 1;
    if (bubble) then(bubble);
  }

  return {
    show(target, pin, into) {
      const mine = ++wish;
      wanted((made) => {
        if (mine !== wish) return;
        made.show(target, pin);
        if (into) made.focus();
      });
    },
    hide: () => instead((made) => made.hide()),
    leave: () => instead((made) => made.leave()),
    stay: () => bubble?.stay(),
    focus: () => bubble?.focus() ?? false,
    target: () => bubble?.target() ?? null,
    pinned: () => bubble?.pinned() ?? false,
    update: (state, before) => bubble?.update?.(state, before),
    draw: (now) => bubble?.draw?.(now) ?? false,
  };
}

/** @param {Target} a @param {Target} b */
export function alike(a, b) {
  if (a.frame !== b.frame) return false;
  if (a.kind === "decision" || b.kind === "decision") return a.kind === b.kind;
  return a.id !== null || b.id !== null ? a.id === b.id : same(a.cell, b.cell);
}
