// @ts-check
/** Asking the service over HTTP: the answer, or an `Error` whose message a person can read. */

/** @import { Problem } from "./protocol.js" */

/** What the service refused, with its whole problem document where it sent one. */
export class Refused extends Error {
  /** @param {string} message @param {number} status @param {Problem | null} problem */
  constructor(message, status, problem) {
    super(message);
    this.status = status;
    this.problem = problem;
  }
}

/**
 * @typedef {object} Asking
 * @property {"GET" | "POST" | "DELETE"} [method]
 * @property {unknown} [body]  sent as JSON
 * @property {AbortSignal} [signal]  an abort is thrown on as it is
 * @property {typeof fetch} [http]
 */

/**
 * Ask, and have the response when it is a good one.
 * @param {string} path
 * @param {Asking} [asking]
 * @returns {Promise<Response>}
 */
export async function ask(path, { method = "GET", body, signal, http = fetch } = {}) {
  let response;
  try {
    response = await http(path, {
      method,
      signal,
      ...(body === undefined ? {} : { headers: { "content-type": "application/json" }, body: JSON.stringify(body) }),
    });
  } catch (error) {
    if (signal?.aborted) throw error;
    throw new Refused("The service cannot be reached.", 0, null);
  }
  if (response.ok) return response;
  /** @type {Problem | null} */
  const problem = await response.json().catch(() => null);
  throw new Refused(sentence(problem) ?? `The service answered ${response.status}.`, response.status, problem);
}

/**
 * Ask for JSON.
 * @param {string} path
 * @param {Asking} [asking]
 * @returns {Promise<any>}
 */
export async function askJson(path, asking) {
  return (await ask(path, asking)).json();
}

/** @param {Problem | null} problem */
function sentence(problem) {
  if (!problem?.detail) return null;
  const first = problem.errors?.find(({ message }) => !problem.detail.includes(message));
  return first ? `${problem.detail} ${first.field}: ${first.message}.` : problem.detail;
}

/** What went wrong, in words. @param {unknown} error */
export function words(error) {
  return error instanceof Error ? error.message : String(error);
}
