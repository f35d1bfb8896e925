// @ts-check
/**
 * What a menu, a key or a button of the page does can be said as well: by its name, as the palette shows it, or by one of
 * the phrases in `acts` of the page's texts. All else goes to the service.
 */

import { hasText, t } from "./texts.js";

/** @import { Command, Doing } from "./commands.js" */
/** @import { State } from "./state.js" */

/** What the service understands as it is said, and tells in its log as it was said. */
const OF_THE_SERVICE = new Set(["clock", "pause", "step", "undo"]);
/** Between the phrases of one act. */
const BETWEEN = " | ";
/** Where a name stands in a phrase. */
const MARK = "\u0000";

/**
 * The act that a sentence names, where it makes sense now.
 * @param {string} said
 * @param {Command[]} commands
 * @param {State} state
 * @returns {{act: Command, doing: Doing} | null}
 */
export function spokenAct(said, commands, state) {
  const wanted = plainWords(said);
  if (wanted === "") return null;
  for (const act of commands) {
    if (OF_THE_SERVICE.has(act.name)) continue;
    const name = act.named && nameSaid(said, act.name);
    if (act.named && name) return { act, doing: act.named(name) };
    const phrases = phrasesOf(act).map(plainWords);
    const doing = act.now(state);
    if (doing && (phrases.includes(wanted) || plainWords(doing.label) === wanted)) return { act, doing };
  }
  return null;
}

/** Phrases by which an act is known, besides its name. @param {{name: string}} act @returns {string[]} */
export function phrasesOf({ name }) {
  const key = `acts.${name}`;
  return hasText(key) ? t(`acts.${name}`).split(BETWEEN) : [];
}

/** The name that a sentence gives an act: what stands where a phrase of `acts_named` has `{name}`. @param {string} said @param {string} act */
function nameSaid(said, act) {
  const plain = said.trim().replace(/[.!]$/, "");
  for (const phrase of t(`acts_named.${act}`, { name: MARK }).split(BETWEEN)) {
    const [begin, end] = phrase.split(MARK);
    const lower = plain.toLocaleLowerCase();
    if (lower.startsWith(begin.toLocaleLowerCase()) && lower.endsWith(end.toLocaleLowerCase())) {
      const name = plain.slice(begin.length, plain.length - end.length).trim().replace(/^["“„'](.*)["”“']$/, "$1");
      if (name !== "") return name;
    }
  }
  return null;
}

/** Without what is said for politeness or written for the eye. @param {string} text */
function plainWords(text) {
  return text
    .toLocaleLowerCase()
    .replace(/[^\p{L}\p{N}*+×.]+/gu, " ")
    .replace(/\.(?!\d)/g, "")
    .trim();
}
