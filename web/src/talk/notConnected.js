// @ts-check
/** What is told where a sentence could not be sent. */

import { t } from "../core/texts.js";

/** @import { Problem } from "../core/protocol.js" */

/** @type {Problem} */
export const NOT_CONNECTED = {
  type: "about:blank",
  title: t("page.not_connected"),
  status: 0,
  errors: [],
  detail: t("page.not_sent"),
};
