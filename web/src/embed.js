// @ts-check
/**
 * A run in a frame of another page (`/embed`): the road, its clock, one line of narration, and a link to the whole.
 *
 * The address names a session (`#/s/<session>`) or carries one whole (`#/r/…`), which is opened as a copy. What is played
 * is the past of that session: nothing in the frame changes it.
 */

import { html, render } from "../vendor/lit-html.js";
import { hashOf, placeInHash } from "./core/address.js";
import { askJson, errorText } from "./core/http.js";
import { sessionPath } from "./core/protocol.js";
import { createLoop } from "./core/renderLoop.js";
import { openLink } from "./core/sessions.js";
import { INITIAL } from "./core/state.js";
import { t } from "./core/texts.js";
import { wantsStillness, watchPreferences } from "./core/theme.js";
import { createRoad } from "./road/road.js";
import { MomentCache } from "./timeline/momentCache.js";
import { byId } from "./ui/dom.js";
import { icon } from "./ui/icons.js";
import { find } from "./ui/slot.js";

/** @import { Session } from "./core/protocol.js" */
/** @import { State } from "./core/state.js" */

/** How far a road is driven that comes without a run [ticks]. */
const FIRST_TICKS = 60;

class Embed {
  /** @type {MomentCache | null} */ cache = null;
  /** @type {Session | null} */ session = null;
  at = 0;
  last = 0;
  playing = false;
  told = t("embed.opening");
  bad = false;
  /** @type {State} */ shown = INITIAL;
  #timer = 0;

  /** @param {HTMLElement} host */
  constructor(host) {
    this.host = host;
    this.show();
    this.road = createRoad(find(host, ".embed-road"));
    this.loop = createLoop({ update() {}, draw: (now) => this.shown.world !== null && (this.road.draw?.(now) ?? false) });
    new ResizeObserver(() => this.repaint()).observe(find(host, ".embed-road"));
    watchPreferences(() => this.repaint());
  }

  repaint() {
    this.road.repaint?.();
    this.loop.wake();
  }

  /** Finds or opens the session of the address, and plays it. */
  async open() {
    try {
      const place = placeInHash(location.hash);
      if (place === null || "scenario" in place) throw new Error(t("embed.no_run"));
      this.session = await ("carried" in place ? openLink(place.carried) : askJson(sessionPath(place.session)));
      const carried = "carried" in place;
      if (carried && this.session?.tick === 0) {
        await askJson(`${sessionPath(this.session.id)}/step`, { method: "POST", body: { ticks: FIRST_TICKS } });
        this.last = FIRST_TICKS;
      } else this.last = ("session" in place && place.tick) || (this.session?.tick ?? 0);
      this.cache = new MomentCache(/** @type {Session} */ (this.session).id);
      await this.go(0);
      if (!wantsStillness()) this.run(true);
    } catch (error) {
      this.#tell(errorText(error), true);
    }
  }

  /** @param {number} tick */
  async go(tick) {
    const { cache } = this;
    if (cache === null) return;
    this.at = Math.max(0, Math.min(this.last, tick));
    const wanted = this.at;
    const past = cache.known(wanted) ?? (await cache.at(wanted));
    cache.ahead(Math.min(this.last, wanted + 12));
    if (wanted !== this.at) return;
    const next = /** @type {State} */ ({ ...INITIAL, ...past, past, world: { ...past.world, paused: !this.playing } });
    this.road.update?.(next, this.shown);
    this.shown = next;
    this.loop.wake();
    // Of the present nothing is decided yet.
    this.#tell(past.narration ?? past.led ?? "");
  }

  /** @param {boolean} on */
  run(on) {
    clearTimeout(this.#timer);
    this.playing = on;
    if (on && this.at >= this.last) this.at = -1;
    if (on) void this.#onward();
    this.show();
  }

  async #onward() {
    try {
      await this.go(this.at + 1);
    } catch (error) {
      this.playing = false;
      return this.#tell(errorText(error), true);
    }
    if (!this.playing) return;
    if (this.at >= this.last) return this.run(false);
    this.#timer = setTimeout(() => void this.#onward(), (this.shown.world?.stepS ?? 0.5) * 1000);
  }

  /** @param {string} text @param {boolean} [bad] */
  #tell(text, bad = false) {
    this.told = text;
    this.bad = bad;
    this.show();
  }

  show() {
    const { at, last, playing, told, bad, session } = this;
    const slide = (/** @type {{target: HTMLInputElement}} */ { target }) => {
      this.run(false);
      this.go(Number(target.value)).catch((error) => this.#tell(errorText(error), true));
    };
    render(
      html`<div class="embed-road"></div>
        <p class="embed-told" data-tone=${bad ? "bad" : "plain"}>${told}</p>
        <div class="embed-bar">
          <button type="button" aria-label=${t(playing ? "clock.pause" : "clock.play")} ?disabled=${session === null} @click=${() => this.run(!this.playing)}>${icon(playing ? "pause" : "play")}</button>
          <input type="range" min="0" max=${last} aria-label=${t("timeline.label")} aria-valuetext=${t("timeline.tick", { tick: at })} ?disabled=${session === null} .value=${String(Math.max(0, at))} @input=${slide} />
          <span class="embed-tick">${t("timeline.tick", { tick: Math.max(0, at) })}</span>
          <a href=${session ? `./${hashOf(session.id)}` : "./"} target="_blank" rel="noopener">${t("embed.open")}</a>
        </div>`,
      this.host,
    );
  }
}

void new Embed(byId("embed")).open();
