// @ts-check
/**
 * The end of an episode: what happened in a line, and what can be done about it. A person who watches at a speed one can
 * follow is not shown the next road while they look: the clock is stopped for them, or where others watch as well, their
 * own view stays at the end.
 */

import { html, live, nothing } from "../../vendor/lit-html.js";
import { askJson } from "../core/http.js";
import { prefer, preference } from "../core/preferences.js";
import { sessionPath } from "../core/protocol.js";
import { t } from "../core/texts.js";
import { clock } from "../core/words.js";

/** @import { Page } from "../core/page.js" */
/** @import { Action } from "../core/protocol.js" */
/** @import { State } from "../core/state.js" */

/** Faster than this nobody follows single episodes. */
const FASTEST_WATCHED = 8;
/** How many ticks before the end are watched again, or driven by hand. */
const TICKS_BEFORE = 5;
/** Events that tell of an end. */
const ENDS = new Set(["arrived", "crashed", "stuck"]);
/** A preference: whether the next road begins by itself. */
const GOES_ON = "ends_go_on";

/** Whether the end is to be held: an episode has just ended before somebody's eyes. @param {State} state @param {State} before */
export function endsNow({ world, connection, past }, before) {
  if (!world || world.status === "running" || world.paused || past !== null || connection.phase !== "live") return false;
  if (before.world?.status !== "running" || before.world.episode !== world.episode) return false;
  const followed = world.pace !== "max" && world.pace <= FASTEST_WATCHED;
  return followed && !document.hidden && preference(GOES_ON) !== "yes";
}

/**
 * Holds the end of an episode: stops the clock of a session that nobody else watches; else, or where the next road has
 * begun, only this page stays there.
 * @param {Page} page
 */
export function createHold(page) {
  /** @type {{tick: number, seen: boolean} | null} the end at which the view stays */ let held = null;
  return {
    /** @param {NonNullable<State["world"]>} ended */
    async begin({ tick, episode }) {
      const { session } = page.state();
      if (!session) return;
      const { watchers } = await askJson(sessionPath(session)).catch(() => ({ watchers: 1 }));
      const { look, world, session: now } = page.state();
      if (now !== session || look.tick !== null || !world) return;
      if (watchers <= 1 && world.episode === episode) page.act([{ do: "pause" }], t("clock.pause"), true);
      else held = { tick, seen: false };
    },

    /** Whether the view stays at an end; a look elsewhere ends that. */
    follow() {
      const { look, world } = page.state();
      if (held === null) return false;
      if (look.tick === held.tick) held.seen = true;
      else if (held.seen || look.tick !== null) held = null;
      else if (world && world.tick > held.tick) void page.timeTravel.at(held.tick);
      return held?.seen === true;
    },
  };
}

/** The line that told of the end. @param {Pick<State, "log" | "world">} state */
export function endOf({ log, world }) {
  const tick = world?.tick ?? 0;
  const end = log.findLast(({ type, gone, to }) => ENDS.has(type) && !gone && to <= tick);
  return end && end.to >= tick - (world?.metrics.last_episode_ticks ?? 0) ? end : undefined;
}

/**
 * The card's lower part.
 * @param {State} state  whose episode has ended
 * @param {Page} page
 */
export function endingTemplate(state, page) {
  const { world } = state;
  if (!world) return nothing;
  const end = endOf(state)?.to ?? world.tick;
  const ticks = world.metrics.last_episode_ticks ?? 0;
  const arrived = world.status === "success";
  const told = arrived ? "summary" : "why";
  const otherwise = world.status === "stuck" ? "leads_on" : "saved";
  return html`${ticks > 0 ? html`<p class="ending-figures">${t("ending.after", { time: clock(ticks * world.stepS), ticks })}</p>` : nothing}
    <div class="ending-buttons">
      ${button("next", t("ending.next"), () => void goOn(page, end), "strong")}
      ${button("drive", t("ending.drive"), () => page.act(driveAgain(page.state()), t("ending.drive")))}
      ${button(told, t(`ending.${told}`), () => page.say(t(`ending.say.${world.status}`)))}
      ${button("watch", t("ending.watch"), () => void watch(page, beforeEnd(state)))}
      ${arrived ? nothing : button(otherwise, t(`ending.${otherwise}`), () => page.say(t(`ending.say.${otherwise}`)))}
    </div>
    <label class="ending-choice"><input type="checkbox" .checked=${live(preference(GOES_ON) === "yes")} @change=${choose}> ${t("ending.go_on")}</label>`;
}

/** @param {string} name @param {string} label @param {() => void} press @param {string} [look] */
function button(name, label, press, look = "") {
  return html`<button class="button small ${look}" type="button" data-ending=${name} @click=${press}>${label}</button>`;
}

/** @param {Event} event */
function choose({ target }) {
  prefer(GOES_ON, /** @type {HTMLInputElement} */ (target).checked ? "yes" : "no");
}

/** @param {Page} page @param {number} from */
async function watch(page, from) {
  await page.timeTravel.at(from);
  page.timeTravel.play();
}

/** The tick from which the end is seen, or driven, again. @param {Pick<State, "log" | "world">} state */
function beforeEnd(state) {
  const { tick, metrics } = /** @type {NonNullable<State["world"]>} */ (state.world);
  const end = endOf(state)?.to ?? tick;
  return Math.max(0, end - Math.min(TICKS_BEFORE, metrics.last_episode_ticks ?? 0));
}

/**
 * Puts a person at the wheel, the clock standing: each move makes its own tick. After an end it goes back to where it
 * could still be driven otherwise, or to the start of a drive that went well.
 * @param {Pick<State, "log" | "world">} state  whose episode has ended
 * @returns {Action[]}
 */
export function driveAgain(state) {
  const { world } = state;
  /** @type {Action[]} */
  const wheel = world?.mode === "manual" ? [] : [{ do: "mode", mode: "manual" }];
  /** @type {Action[]} */
  const still = world?.paused ? [] : [{ do: "pause" }];
  return [{ do: "rewind", to: world?.status === "success" ? "episode" : beforeEnd(state) }, ...wheel, ...still];
}

/** On to the next road: over what is left of the time for which a result stands. @param {Page} page @param {number} end */
export async function goOn(page, end) {
  const { look, session, world } = page.state();
  if (look.tick !== null) return page.timeTravel.live();
  if (!session || !world || world.status === "running") return;
  const { config } = await askJson(sessionPath(session)).catch(() => ({ config: {} }));
  const now = page.state().world;
  if (!now || now.episode !== world.episode) return;
  const stands = Math.max(1, Math.ceil((config.reset_delay_s ?? 2) / now.stepS));
  /** @type {Action[]} */
  const actions = [{ do: "step", ticks: Math.max(1, stands - (now.tick - end)) }];
  page.act(now.mode === "manual" ? actions : [...actions, { do: "resume" }], t("ending.next"), true);
}
