// @ts-check
/**
 * Commands for buttons, keys and the palette. A panel adds its own in `Panel.commands`; all of them together are
 * `page.commands()`.
 */

import { t } from "./texts.js";

/** @import { Page } from "./page.js" */
/** @import { Action } from "./protocol.js" */
/** @import { State } from "./state.js" */

/**
 * @typedef {object} Command
 * @property {string} name
 * @property {string} group  a heading in the palette and in help
 * @property {string} [key]  as `KeyboardEvent.key` has it
 * @property {string} [keyName]  as people call it
 * @property {boolean} [repeats]  whether a key held down does it again and again
 * @property {boolean} [button]  whether it stands among the clock's buttons
 * @property {(state: State) => Doing | null} now  what it does in this state; null where it makes no sense
 * @property {(name: string) => Doing} [named]  what it does with the name that is said with it
 */

/**
 * @typedef {object} Doing
 * @property {string} label
 * @property {string} [icon]
 * @property {boolean} [pressed]  of a button that is on or off
 * @property {Action[][]} [turns]  typed actions, each turn a message of its own
 * @property {(page: Page) => void} [run]  what else is to be done
 * @property {Action[]} [said]  what is done instead where it is said: on every page that watches
 */

/** Do it, if it makes sense now. @param {Command} act @param {Page} page */
export function runCommand(act, page) {
  const doing = act.now(page.state());
  if (doing === null) return;
  for (const actions of doing.turns ?? []) page.act(actions, doing.label, true);
  doing.run?.(page);
}

/** @type {Action} */
const STEP = { do: "step", ticks: 1 };

/** @type {Command[]} */
export const COMMANDS = [
  {
    name: "back",
    group: t("groups.clock"),
    button: true,
    repeats: true,
    key: "ArrowLeft",
    keyName: "←",
    now: ({ world, past }) =>
      world && (past ?? { world }).world.tick > 0
        ? {
            label: t("clock.back"),
            icon: "back",
            turns: past || world.paused ? [] : [[{ do: "pause" }]],
            run: (page) => void page.timeTravel.step(-1),
          }
        : null,
  },
  {
    name: "clock",
    group: t("groups.clock"),
    button: true,
    key: " ",
    keyName: t("clock.space"),
    now: ({ look, past, world }) => {
      if (past) {
        const doing = look.playing ? "pause" : "play";
        return { label: t(`clock.${doing}`), icon: doing, run: (page) => page.timeTravel.toggle() };
      }
      return world?.paused
        ? { label: t("clock.resume"), icon: "play", turns: [[{ do: "resume" }]] }
        : { label: t("clock.pause"), icon: "pause", turns: [[{ do: "pause" }]] };
    },
  },
  {
    name: "step",
    group: t("groups.clock"),
    button: true,
    repeats: true,
    key: "ArrowRight",
    keyName: "→",
    now({ past, world }) {
      if (past) return { label: t("clock.step"), icon: "step", run: (page) => void page.timeTravel.step(1) };
      // Two messages: a step that comes alone is streamed tick by tick, with its decision.
      return { label: t("clock.step"), icon: "step", turns: world?.paused === false ? [[{ do: "pause" }], [STEP]] : [[STEP]] };
    },
  },
  {
    name: "undo",
    group: t("groups.change"),
    button: true,
    key: "u",
    keyName: "U",
    now: () => ({ label: t("clock.undo"), icon: "undo", turns: [[{ do: "undo" }]] }),
  },
  {
    name: "reset",
    group: t("groups.change"),
    button: true,
    key: "r",
    keyName: "R",
    now: () => ({ label: t("clock.reset"), icon: "reset", turns: [[{ do: "reset" }]] }),
  },
];

/** Elements that need the keys themselves. */
const TYPING = "input, textarea, select, [contenteditable]";
const PRESSABLE = "button, a[href], summary";

/** @param {Page} page @param {HTMLElement} words  the command box */
export function watchKeys(page, words) {
  addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.isComposing) return;
    const target = event.target instanceof Element ? event.target : null;
    if (target?.closest(TYPING)) return;
    if (target?.closest(PRESSABLE) && (event.key === " " || event.key === "Enter")) return;
    if (event.key === "/") words.focus();
    else {
      const act = page.commands().find(({ key }) => key === event.key);
      if (!act || (event.repeat && !act.repeats)) return;
      runCommand(act, page);
    }
    event.preventDefault();
  });
}
