// @ts-check
/** What a person can do without words: each act's key, label and typed actions, once for buttons and keys. */

/** @import { Action } from "./protocol.js" */
/** @import { State } from "./state.js" */

/**
 * @typedef {object} Act
 * @property {string} name
 * @property {string} key  as `KeyboardEvent.key` has it
 * @property {string} keyName  as people call it
 * @property {(state: State) => {label: string, icon: string, turns: Action[][]}} now  what it does in this state,
 *   each turn a message of its own
 */

const STEP = { do: "step", ticks: 1 };

/** @type {Act[]} */
export const ACTS = [
  {
    name: "undo",
    key: "u",
    keyName: "U",
    now: () => ({ label: "Undo", icon: "undo", turns: [[{ do: "undo" }]] }),
  },
  {
    name: "clock",
    key: " ",
    keyName: "Space",
    now: (state) =>
      state.world?.paused
        ? { label: "Resume", icon: "play", turns: [[{ do: "resume" }]] }
        : { label: "Pause", icon: "pause", turns: [[{ do: "pause" }]] },
  },
  {
    name: "step",
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
    key: "r",
    keyName: "R",
    now: () => ({ label: "Reset", icon: "reset", turns: [[{ do: "reset" }]] }),
  },
];

/** The question what can be said. */
export const HELP = { label: "What can I say?", actions: [{ do: "ask", about: "help" }] };
