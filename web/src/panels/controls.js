// @ts-check
/** The clock's buttons and the help button; the same acts as the keys (`acts.js`). */

import { ACTS, HELP } from "../acts.js";
import { icon } from "../icons.js";
import { make, setText } from "../dom.js";

/** @import { Page } from "../main.js" */
/** @import { Panel } from "./index.js" */

/**
 * @param {HTMLElement} host
 * @param {HTMLElement} help
 * @param {Page} page
 * @returns {Panel}
 */
export function createControls(host, help, page) {
  const buttons = ACTS.map((act) => {
    const label = make("span", { class: "control-label" });
    const picture = make("span", { class: "control-icon" });
    const button = make(
      "button",
      {
        class: act.name === "clock" ? "button strong" : "button",
        type: "button",
        "data-act": act.name,
        "aria-keyshortcuts": act.key === " " ? "Space" : act.key,
        onclick: () => {
          const { turns, label: said } = act.now(page.state());
          for (const actions of turns) page.act(actions, said, true);
        },
      },
      picture,
      label,
    );
    host.append(button);
    return { act, button, label, picture, shown: "" };
  });
  help.addEventListener("click", () => page.act(HELP.actions, HELP.label));

  return {
    update(state) {
      const off = state.connection.phase !== "live";
      for (const entry of buttons) {
        const { label, icon: name } = entry.act.now(state);
        entry.button.disabled = off;
        if (entry.shown === name) continue;
        entry.shown = name;
        setText(entry.label, label);
        entry.button.title = `${label}  ${entry.act.keyName}`;
        entry.button.setAttribute("aria-label", label);
        entry.picture.replaceChildren(icon(name));
      }
    },
  };
}
