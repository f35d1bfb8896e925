// @ts-check
/**
 * What a person can do without words, once for buttons, keys and the palette. Those that belong to a panel are told by
 * it (`Panel.acts`); all of them together are `page.acts()`.
 */

/** @import { Page } from "./main.js" */
/** @import { Action } from "./protocol.js" */
/** @import { State } from "./state.js" */

/**
 * @typedef {object} Act
 * @property {string} name
 * @property {string} group  a heading in the palette and in help
 * @property {string} [key]  as `KeyboardEvent.key` has it
 * @property {string} [keyName]  as people call it
 * @property {boolean} [repeats]  whether a key held down does it again and again
 * @property {boolean} [button]  whether it stands among the clock's buttons
 * @property {(state: State) => Doing | null} now  what it does in this state; null where it makes no sense
 */

/**
 * @typedef {object} Doing
 * @property {string} label
 * @property {string} [icon]
 * @property {Action[][]} [turns]  typed actions, each turn a message of its own
 * @property {(page: Page) => void} [run]  what else is to be done
 */

/** Do it, if it makes sense now. @param {Act} act @param {Page} page */
export function perform(act, page) {
  const doing = act.now(page.state());
  if (doing === null) return;
  for (const actions of doing.turns ?? []) page.act(actions, doing.label, true);
  doing.run?.(page);
}

const STEP = { do: "step", ticks: 1 };

/** @type {Act[]} */
export const ACTS = [
  {
    name: "undo",
    group: "Change",
    button: true,
    key: "u",
    keyName: "U",
    now: () => ({ label: "Undo", icon: "undo", turns: [[{ do: "undo" }]] }),
  },
  {
    name: "clock",
    group: "Clock",
    button: true,
    key: " ",
    keyName: "Space",
    now: (state) =>
      state.world?.paused
        ? { label: "Resume", icon: "play", turns: [[{ do: "resume" }]] }
        : { label: "Pause", icon: "pause", turns: [[{ do: "pause" }]] },
  },
  {
    name: "step",
    group: "Clock",
    button: true,
    repeats: true,
    key: "ArrowRight",
    keyName: "→",
    now: (state) => ({
      label: "Step",
      icon: "step",
      // Two messages: a step that comes alone is streamed tick by tick, with its decision.
      turns: state.world?.paused === false ? [[{ do: "pause" }], [STEP]] : [[STEP]],
    }),
  },
  {
    name: "reset",
    group: "Change",
    button: true,
    key: "r",
    keyName: "R",
    now: () => ({ label: "Reset", icon: "reset", turns: [[{ do: "reset" }]] }),
  },
];
