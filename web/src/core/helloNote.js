// @ts-check
/** What is told once a stream has begun, or has begun anew after the connection was lost. */

import { t } from "./texts.js";

/** @import { HelloMessage } from "./protocol.js" */
/** @import { State } from "./state.js" */

/** @param {State} state @param {HelloMessage} hello @returns {string | null} */
export function helloNote({ world }, hello) {
  if (world === null) return hello.session.rules_note ?? null; // once, not with each connection
  return !world.paused && hello.state.paused ? t("connection.paused_meanwhile", { tick: hello.state.tick }) : null;
}
