// @ts-check
/** The clock's buttons and its speed; the same as the keys do (`core/commands.js`). */

import { html, live, nothing, render } from "../../vendor/lit-html.js";
import { runCommand } from "../core/commands.js";
import { t } from "../core/texts.js";
import { paceText } from "../core/words.js";
import { icon } from "../ui/icons.js";

/** @import { Command } from "../core/commands.js" */
/** @import { Page } from "../core/page.js" */
/** @import { State } from "../core/state.js" */
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
  return {
    commands: [faster(1, "+"), faster(-1, "−"), ...speedCommands()],

    update(state) {
      const off = state.connection.phase !== "live";
      const pace = page.state().world?.pace ?? 1;
      const commands = page.commands().filter((act) => act.button);
      render(
        commands.map((act) => html`${button(act, state, off, page)}${act.name === AFTER ? speed(pace, off, page) : nothing}`),
        host,
      );
    },
  };
}

/** @param {Command} act @param {State} state @param {boolean} off @param {Page} page */
function button(act, state, off, page) {
  const doing = act.now(state);
  const { label, icon: picture = act.name } = doing ?? { label: t(`clock.${act.name}`) };
  const short = act.name === "manual" ? t("drive.label") : label;
  const title = [label, act.keyName].filter(Boolean).join("  ");
  return html`<button
    class=${act.name === "clock" ? "button strong" : "button"}
    type="button"
    title=${title}
    aria-label=${label}
    aria-pressed=${doing?.pressed === undefined ? nothing : String(doing.pressed)}
    aria-keyshortcuts=${act.key === " " ? "Space" : (act.key ?? nothing)}
    data-act=${act.name}
    ?disabled=${off || doing === null}
    @click=${() => runCommand(act, page)}
  ><span class="control-icon">${icon(picture)}</span><span class="control-label">${short}</span></button>`;
}

/** @param {number | "max"} pace @param {boolean} off @param {Page} page */
function speed(pace, off, page) {
  const choices = SPEEDS.includes(pace) ? SPEEDS : [...SPEEDS, pace];
  const choose = (/** @type {{target: HTMLSelectElement}} */ { target: { value } }) => setSpeed(value === "max" ? "max" : Number(value), page);
  return html`<select class="speed" aria-label=${t("clock.speed")} aria-keyshortcuts="- +" title="${t("clock.speed")}  − +" ?disabled=${off} @change=${choose}>
    ${choices.map((each) => html`<option value=${each} .selected=${live(each === pace)}>${paceText(each)}</option>`)}
  </select>`;
}

/** @param {number | "max"} value @param {Page} page */
function setSpeed(value, page) {
  page.act([{ do: "set", parameter: "playback_speed", value }], t("clock.speed_set", { pace: paceText(value) }), true);
}

/** Each speed by its name. @returns {Command[]} */
function speedCommands() {
  return SPEEDS.map((pace) => ({
    name: `speed-${pace}`,
    group: t("groups.clock"),
    now: ({ world }) => (world === null || world.pace === pace ? null : { label: t("clock.speed_set", { pace: paceText(pace) }), turns: [[{ do: "set", parameter: "playback_speed", value: pace }]] }),
  }));
}

/** @param {1 | -1} direction @param {string} keyName @returns {Command} */
function faster(direction, keyName) {
  const name = direction > 0 ? "faster" : "slower";
  return {
    name,
    group: t("groups.clock"),
    key: keyName === "+" ? "+" : "-",
    keyName,
    repeats: true,
    now({ world }) {
      const pace = world?.pace ?? 1;
      const at = SPEEDS.findIndex((speed) => speed === "max" || (pace !== "max" && speed >= pace));
      const next = SPEEDS[pace === "max" ? SPEEDS.length - 1 + direction : at + direction];
      return next === undefined ? null : { label: t(`clock.${name}`, { pace: paceText(next) }), run: (page) => setSpeed(next, page) };
    },
  };
}
