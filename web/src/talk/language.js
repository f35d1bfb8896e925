// @ts-check
/** What can be said, how a sentence could go on, and what it would do: asked of the service, done nowhere. */

import { preference } from "../core/preferences.js";
import { GUIDE_PATH } from "../core/protocol.js";
import { changeWords, counted } from "../core/words.js";

/** @import { Action, Change } from "../core/protocol.js" */

/**
 * @typedef {object} Preview
 * @property {"does" | "asks" | "ambiguous" | "not_understood" | "refused"} standing
 * @property {Action[]} actions
 * @property {Change[]} changes
 * @property {string | null} detail
 * @property {string[]} unparsed
 */
/** @typedef {{completions: string[], preview: Preview | null}} Foreseen */
/** @typedef {{intent: string, available: boolean, why_not: string | null, examples: {text: string}[]}} Intent */
/** @typedef {{language: string, languages: string[], intents: Intent[], taught: {phrase: string, sentence: string}[]}} Guide */

const MOST_CHARS = 500;
/** @type {Foreseen} Of what is longer than the service reads, which need not be asked. */
const TOO_LONG = {
  completions: [],
  preview: { standing: "refused", actions: [], changes: [], detail: `Too long: at most ${MOST_CHARS} letters are read`, unparsed: [] },
};

/** The language that is spoken here, as a code. */
export const spoken = () => preference("language", "en");

/**
 * How a sentence that has been begun could go on, and what it would do as it stands.
 * @param {string} text
 * @param {string} session
 * @param {typeof fetch} [http]
 * @returns {Promise<Foreseen>}
 */
export async function foresee(text, session, http = fetch) {
  if ([...text].length > MOST_CHARS) return TOO_LONG;
  return asked({ prefix: text, session, language: spoken() }, http);
}

/** All that can be said. @param {typeof fetch} [http] @returns {Promise<Guide>} */
export function guide(http = fetch) {
  return asked({ language: spoken() }, http);
}

/** @param {Record<string, string>} query @param {typeof fetch} http */
async function asked(query, http) {
  const response = await http(`${GUIDE_PATH}?${new URLSearchParams(query)}`);
  if (!response.ok) throw new Error(`The service answered ${response.status}.`);
  return response.json();
}

const MOST_TOLD = 3;

/**
 * A preview in a few words; empty when there is nothing worth telling.
 * @param {Preview | null} preview
 * @returns {string}
 */
export function previewWords(preview) {
  if (preview === null) return "";
  const { standing, changes, detail, unparsed } = preview;
  if (standing === "asks") return "A question: changes nothing";
  if (standing === "not_understood") {
    return unparsed.length > 0 ? `Not understood so far: “${unparsed.join(" ")}”` : "";
  }
  if (standing !== "does") return detail ?? "";
  // A setting that changes alone is all there is to tell.
  const told = changes.length === 1 ? changes : changes.filter(({ path }) => !path.startsWith("config."));
  const settings = changes.length - told.length;
  const words = told.slice(0, MOST_TOLD).map(inShort);
  if (told.length > MOST_TOLD) words.push(`${told.length - MOST_TOLD} more`);
  if (settings > 0) words.push(counted(settings, "setting"));
  return words.join(" · ") || "Understood";
}

/** @param {Change} change */
function inShort(change) {
  if (change.path === "paused") return change.after ? "pauses" : "goes on";
  const { name, before, after } = changeWords(change);
  return `${name} ${before} → ${after}`;
}
