// @ts-check
/**
 * Every word of the page for people, in the reader's language: `t("clock.pause")`, `t("units.rows", { count: 3 })`.
 *
 * The words are in `prompts/interface/<language>/page.yaml`; `early.js` chooses the language and asks for them.
 */

import { prefer } from "./preferences.js";

/** @typedef {string | Record<string, string>} Text  one text, or one for each plural form */

/** The page's language, as a code. */
export const LANGUAGE = globalThis.document?.documentElement?.lang || "en";

/** @type {Record<string, Text>} */
const TEXTS = await /** @type {Promise<Record<string, Text>>} */ (Reflect.get(globalThis, "pageTexts"));

const locale = String(TEXTS.locale ?? LANGUAGE);
const plurals = new Intl.PluralRules(locale);
const figures = new Intl.NumberFormat(locale, { useGrouping: false, maximumFractionDigits: 6 });
const lists = new Intl.ListFormat(locale, { type: "conjunction" });

/**
 * A text with its `{names}` filled in. Of plural forms, `count` chooses; numbers are written as in the page's language.
 * A text that is not there is its key.
 * @param {string} key
 * @param {Record<string, unknown>} [values]
 * @returns {string}
 */
export function t(key, values = {}) {
  const text = TEXTS[key];
  if (text === undefined) return key;
  const form = typeof text === "string" ? text : (text[plurals.select(Number(values.count))] ?? text.other);
  return form.replace(/\{(\w+)\}/g, (whole, name) => (name in values ? written(values[name]) : whole));
}

/** Whether there is a text: names from the wire may be newer than the page. @param {string} key */
export function hasText(key) {
  return Object.hasOwn(TEXTS, key);
}

/**
 * The name of something on the wire: its text under a prefix, or as it is spelt: "success_rate" → "success rate".
 * @param {string} prefix
 * @param {string} name
 */
export function nameText(prefix, name) {
  const key = `${prefix}.${name}`;
  return hasText(key) ? t(key) : name.replaceAll("_", " ").replaceAll(".", " ");
}

/** "a, b and c". @param {Iterable<string>} parts */
export function listText(parts) {
  return lists.format(parts);
}

/** A number with a fixed count of decimals. @param {number} value @param {number} decimals */
export function decimalText(value, decimals) {
  return value.toLocaleString(locale, { useGrouping: false, minimumFractionDigits: decimals, maximumFractionDigits: decimals });
}

/** @param {string} text */
export function capital(text) {
  return text.charAt(0).toLocaleUpperCase(locale) + text.slice(1);
}

/** Languages the page can be read in, by code, each named in itself. @returns {[code: string, name: string][]} */
export function languages() {
  const codes = (document.documentElement.dataset.languages ?? "en").split(" ");
  return codes.map((code) => [code, capital(new Intl.DisplayNames([code], { type: "language" }).of(code) ?? code)]);
}

/** Choose the language of the page, now and for later visits: the page is loaded anew. @param {string} code */
export function chooseLanguage(code) {
  prefer("language", code);
  const url = new URL(location.href);
  url.searchParams.delete("lang");
  if (url.href === location.href) location.reload();
  else location.replace(url);
}

/** @param {unknown} value */
function written(value) {
  return typeof value === "number" && Number.isFinite(value) ? figures.format(value) : String(value);
}

/** A day and time, in short. @param {Date} date */
export function dateText(date) {
  return date.toLocaleString(locale, { day: "numeric", month: "short", hour: "2-digit", minute: "2-digit" });
}
