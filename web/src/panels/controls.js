// @ts-check
/** The clock's buttons; the same acts as the keys (`acts.js`). */

import { ACTS, perform } from "../acts.js";
import { icon } from "../icons.js";
import { make, setText } from "../dom.js";

/** @import { Page } from "../main.js" */
/** @import { Panel } from "./index.js" */

/**
 * @param {HTMLElement} host
 * @param {Page} page
 * @returns {Panel}
 */
export function createControls(host, page) {
  const buttons = ACTS.filter((act) => act.button).map((act) => {
    const label = make("span", { class: "control-label" });
    const picture = make("span", { class: "control-icon" });
    const button = make(
      "button",
      {
        class: act.name === "clock" ? "button strong" : "button",
        type: "button",
        "data-act": act.name,
        "aria-keyshortcuts": act.key === " " ? "Space" : act.key,
        onclick: () => perform(act, page),
      },
      picture,
      label,
    );
    host.append(button);
    return { act, button, label, picture, shown: "" };
  });

  return {
    update(state) {
      const off = state.connection.phase !== "live";
      for (const entry of buttons) {
        const doing = entry.act.now(state);
        entry.button.disabled = off || doing === null;
        if (doing === null) continue;
        const { label, icon: name = "" } = doing;
        if (entry.shown === name) continue;
        entry.shown = name;
        setText(entry.label, label);
        entry.button.title = [label, entry.act.keyName].filter(Boolean).join("  ");
        entry.button.setAttribute("aria-label", label);
        entry.picture.replaceChildren(icon(name));
      }
    },
  };
}
