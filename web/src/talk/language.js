// @ts-check
/** What can be said, how a sentence could go on, and what it would do: asked of the service, done nowhere. */

import { askJson } from "../core/http.js";
import { GUIDE_PATH } from "../core/protocol.js";
import { LANGUAGE, t } from "../core/texts.js";
import { changeWords } from "../core/words.js";

/** @import { Change } from "../core/protocol.js" */
/** @import { LanguageGuide as Guide, Preview } from "../core/wire.js" */

/** @typedef {{completions: string[], preview: Preview | null}} Foreseen */

const MOST_CHARS = 500;
/** @type {Foreseen} Of what is longer than the service reads, which need not be asked. */
const TOO_LONG = {
  completions: [],
  preview: { standing: "refused", actions: [], changes: [], detail: t("suggestions.too_long", { count: MOST_CHARS }), unparsed: [] },
};

/**
 * How a sentence that has been begun could go on, and what it would do as it stands.
 * @param {string} text
 * @param {string} session
 * @param {typeof fetch} [http]
 * @returns {Promise<Foreseen>}
 */
export async function foresee(text, session, http) {
  if ([...text].length > MOST_CHARS) return TOO_LONG;
  return asked({ prefix: text, session, language: LANGUAGE }, http);
}

/** All that can be said. @param {typeof fetch} [http] @returns {Promise<Guide>} */
export function guide(http) {
  return asked({ language: LANGUAGE }, http);
}

/** @param {Record<string, string>} query @param {typeof fetch} [http] @returns {Promise<any>} */
function asked(query, http) {
  return askJson(`${GUIDE_PATH}?${new URLSearchParams(query)}`, { http });
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
  if (standing === "asks") return t("suggestions.question");
  if (standing === "not_understood") {
    return unparsed.length > 0 ? t("suggestions.not_understood", { words: unparsed.join(" ") }) : "";
  }
  if (standing !== "does") return detail ?? "";
  // A setting that changes alone is all there is to tell.
  const told = changes.length === 1 ? changes : changes.filter(({ path }) => !path.startsWith("config."));
  const settings = changes.length - told.length;
  const words = told.slice(0, MOST_TOLD).map(inShort);
  if (told.length > MOST_TOLD) words.push(t("suggestions.more", { count: told.length - MOST_TOLD }));
  if (settings > 0) words.push(t("units.settings", { count: settings }));
  return words.join(" · ") || t("suggestions.understood");
}

/** @param {Change} change */
function inShort(change) {
  if (change.path === "paused") return t(change.after ? "suggestions.pauses" : "suggestions.resumes");
  return t("suggestions.change", changeWords(change));
}
