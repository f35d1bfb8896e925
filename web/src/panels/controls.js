// @ts-check
/** The clock's buttons and its speed; the same acts as the keys (`acts.js`). */

import { ACTS, perform } from "../core/commands.js";
import { icon } from "../ui/icons.js";
import { make, setText } from "../ui/dom.js";

/** @import { Act } from "../core/commands.js" */
/** @import { Page } from "../main.js" */
/** @import { Panel } from "./index.js" */

/** What the service plays, from slowest to as fast as it can. @type {(number | "max")[]} */
const SPEEDS = [0.25, 0.5, 1, 2, 4, 8, 16, 32, 64, "max"];
/** The speed stands after the clock's own buttons. */
const AFTER = "step";

/**
 * @param {HTMLElement} host
 * @param {Page} page
 * @returns {Panel}
 */
export function createControls(host, page) {
  const speed = make("select", {
    class: "speed",
    "aria-label": "Playback speed",
    "aria-keyshortcuts": "- +",
    title: "Playback speed  − +",
    onchange: () => setSpeed(speed.value === "max" ? "max" : Number(speed.value), page),
  });
  speed.append(...SPEEDS.map(optionOf));
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
    if (act.name === AFTER) host.append(speed);
    return { act, button, label, picture, shown: "" };
  });

  return {
    acts: [faster(1, "+"), faster(-1, "−")],

    update(state) {
      const off = state.connection.phase !== "live";
      for (const entry of buttons) {
        const doing = entry.act.now(state);
        entry.button.disabled = off || doing === null;
        if (doing === null && entry.shown) continue;
        const { label, icon: name = "" } = doing ?? { label: "Back", icon: "back" };
        if (entry.shown === `${name} ${label}`) continue;
        entry.shown = `${name} ${label}`;
        setText(entry.label, label);
        entry.button.title = [label, entry.act.keyName].filter(Boolean).join("  ");
        entry.button.setAttribute("aria-label", label);
        entry.picture.replaceChildren(icon(name));
      }
      const pace = String(page.state().world?.pace ?? 1);
      speed.disabled = off;
      if (speed.value === pace) return;
      if (![...speed.options].some(({ value }) => value === pace)) speed.append(optionOf(Number(pace)));
      speed.value = pace;
    },
  };
}

/** @param {number | "max"} pace */
function optionOf(pace) {
  return make("option", { value: String(pace) }, wordsOf(pace));
}

/** @param {number | "max"} pace */
function wordsOf(pace) {
  return pace === "max" ? "max" : `${pace}×`;
}

/** @param {number | "max"} value @param {Page} page */
function setSpeed(value, page) {
  page.act([{ do: "set", parameter: "playback_speed", value }], `Playback speed ${wordsOf(value)}`, true);
}

/** @param {1 | -1} direction @param {string} keyName @returns {Act} */
function faster(direction, keyName) {
  return {
    name: direction > 0 ? "faster" : "slower",
    group: "Clock",
    key: keyName === "+" ? "+" : "-",
    keyName,
    repeats: true,
    now({ world }) {
      const pace = world?.pace ?? 1;
      const at = SPEEDS.findIndex((speed) => speed === "max" || (pace !== "max" && speed >= pace));
      const next = SPEEDS[pace === "max" ? SPEEDS.length - 1 + direction : at + direction];
      const label = direction > 0 ? "Faster" : "Slower";
      return next === undefined ? null : { label: `${label}: ${wordsOf(next)}`, run: (page) => setSpeed(next, page) };
    },
  };
}
