// @ts-check
/**
 * The one way to ask the service over HTTP: the answer, or an error whose message a person can read. Requests carry the
 * page's language, so that the service answers in that language.
 */

import { LANGUAGE, t } from "./texts.js";

/** @import { Problem } from "./protocol.js" */

/** What the service refused, with its whole problem document where it sent one. */
export class Refused extends Error {
  /** @param {string} message @param {number} status  0: it was not reached @param {Problem | null} problem */
  constructor(message, status, problem) {
    super(message);
    this.status = status;
    this.problem = problem;
  }
}

/**
 * @typedef {object} Asking
 * @property {"GET" | "POST" | "PATCH" | "DELETE"} [method]
 * @property {unknown} [body]  sent as JSON
 * @property {AbortSignal} [signal]  an abort is thrown on as it is
 * @property {typeof fetch} [http]
 * @property {Record<string, string>} [headers]  beside those that every request has
 */

/**
 * Ask, and have the response when it is a good one.
 * @param {string} path
 * @param {Asking} [asking]
 * @returns {Promise<Response>} throws `Refused`
 */
export async function ask(path, { method = "GET", body, signal, http = fetch, headers: more = {} } = {}) {
  /** @type {Record<string, string>} */
  const headers = { "accept-language": LANGUAGE, ...more };
  if (body !== undefined) headers["content-type"] = "application/json";
  let response;
  try {
    response = await http(path, { method, signal, headers, body: body === undefined ? undefined : JSON.stringify(body) });
  } catch (error) {
    if (signal?.aborted) throw error;
    throw new Refused(t("page.unreachable"), 0, null);
  }
  if (response.ok) return response;
  /** @type {Problem | null} */
  const problem = await response.json().catch(() => null);
  throw new Refused(problemText(problem) ?? t("page.answered", { status: response.status }), response.status, problem);
}

/**
 * Ask for JSON.
 * @param {string} path
 * @param {Asking} [asking]
 * @returns {Promise<any>} throws `Refused`
 */
export async function askJson(path, asking) {
  return (await ask(path, asking)).json();
}

/** @param {Problem | null} problem */
function problemText(problem) {
  if (!problem?.detail) return null;
  const first = problem.errors?.find(({ message }) => !problem.detail.includes(message));
  return first ? `${problem.detail} ${first.field}: ${first.message}.` : problem.detail;
}

/** What went wrong, in words. @param {unknown} error */
export function errorText(error) {
  return error instanceof Error ? error.message : String(error);
}
