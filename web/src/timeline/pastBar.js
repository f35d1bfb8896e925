// @ts-check
/** Looking at the past: which tick, what can be done from there, and the way back to the present. */

import { make, setText } from "../ui/dom.js";
import { words } from "../core/http.js";
import { icon } from "../ui/icons.js";
import { hashOf, placeInHash } from "./links.js";
import { Looking } from "./past.js";
import { changesOf } from "../talk/exchanges.js";

/** @import { Act } from "../core/commands.js" */
/** @import { Page } from "../main.js" */
/** @import { Panel } from "../panels/index.js" */

/** Browsers slow a page down that writes its address with every tick it is dragged over. */
const ADDRESS_MS = 300;
const FASTEST = 64;

/** What looks at ticks, for all panels that have to do with time. @param {Page} page */
export function createLooking(page) {
  const looking = new Looking({
    present() {
      const { session, world } = page.state();
      const pace = world?.pace === "max" ? FASTEST : (world?.pace ?? 1);
      return { session, tick: world?.tick ?? 0, stepS: world?.stepS ?? 0.5, pace };
    },
    look: page.look,
    failed: (error) => page.tell({ text: words(error), tone: "bad" }),
  });
  page.looking = looking;
  return looking;
}

/**
 * @param {HTMLElement} host  what the bar lies over
 * @param {Page} page
 * @param {Looking} looking
 * @returns {Panel}
 */
export function createPast(host, page, looking) {
  const tick = make("span", { class: "past-tick" });
  const now = make("span", { class: "past-now" });
  const where = make("span", { class: "past-where" }, tick, now);
  const play = pressed("play", "Play from here", "play", () => looking.toggle());
  const bar = make(
    "div",
    { class: "past", role: "group", "aria-label": "The past", hidden: true },
    where,
    play,
    pressed("fork", "Fork here", "fork", () => perform("fork")),
    pressed("rewind", "Rewind here", "rewind", () => perform("rewind")),
    pressed("share", "Share", "share", () => perform("share")),
    make("button", { class: "past-live", type: "button", "data-past": "live", "aria-label": "Back to live", title: "Back to the present  N", onclick: () => looking.live() }, make("span", { class: "past-now" }, "Back to "), make("span", {}, "live")),
  );
  host.append(bar);
  /** @type {any} */ let timer = null;
  let address = true;

  /** @param {string} name */
  function perform(name) {
    page.acts().find((act) => act.name === name)?.now(page.state())?.run?.(page);
  }

  function tell() {
    if (looking.tick === null) return;
    setText(tick, `Tick ${looking.tick}`);
    setText(now, ` of ${page.state().world?.tick ?? looking.tick}`);
  }

  function show() {
    const looked = looking.tick;
    const left = looked === null && bar.contains(document.activeElement);
    bar.hidden = looked === null;
    if (left) /** @type {HTMLElement | null} */ (document.querySelector(".line"))?.focus({ preventScroll: true });
    document.body.classList.toggle("past-seen", looked !== null);
    const { session } = page.state();
    tell();
    if (play.dataset.playing !== String(looking.playing)) {
      play.dataset.playing = String(looking.playing);
      play.replaceChildren(icon(looking.playing ? "pause" : "play"), make("span", { class: "past-label" }, looking.playing ? "Pause" : "Play"));
    }
    clearTimeout(timer);
    // The address carries the moment that is looked at; it is not a step of the browser's own way back.
    if (session && address) timer = setTimeout(() => write(session), ADDRESS_MS);
  }

  /** Unless the address names another session by now. @param {string} session */
  function write(session) {
    const place = placeInHash(location.hash);
    if (place && "session" in place && place.session === session) history.replaceState(null, "", hashOf(session, looking.tick));
  }

  /** Look where the address says, once there is a run to look at. */
  function follow() {
    const place = placeInHash(location.hash);
    address = true;
    if (place && "session" in place && place.session === page.state().session && page.state().world) {
      if (place.tick === null) looking.live();
      else void looking.at(place.tick);
    }
  }

  looking.listen(show);
  addEventListener("hashchange", () => {
    clearTimeout(timer);
    follow();
  });

  return {
    acts: pastActs(looking),

    update(state, before) {
      if (state.session !== before.session) {
        address = false;
        looking.live();
      }
      const present = page.state();
      if (present.world && before.world === null) follow();
      else if (before.past !== null && state.past === null && looking.tick !== null) looking.rewritten(); // the stream was opened again
      const latest = state.talk.at(-1);
      const done = latest && latest !== before.talk.at(-1) && latest.standing === "done" && changesOf(latest.result).some(({ path }) => path !== "playback_speed");
      if (done) looking.live(); // what was just changed is to be seen
      tell();
    },
  };
}

/**
 * @param {string} name
 * @param {string} label
 * @param {string} picture
 * @param {() => void} onclick
 */
function pressed(name, label, picture, onclick) {
  return make("button", { class: "past-do", type: "button", "data-past": name, "aria-label": label, title: label, onclick }, icon(picture), make("span", { class: "past-label" }, label.split(" ")[0]));
}

/** @param {Looking} looking @returns {Act[]} */
function pastActs(looking) {
  const group = "Time";
  return [
    { name: "to-start", group, now: ({ world }) => world && world.tick > 0 ? { label: "Look at the start", run: () => void looking.at(0) } : null },
    { name: "to-live", group, key: "n", keyName: "N", now: ({ past }) => past && { label: "Back to the present", run: () => looking.live() } },
  ];
}
