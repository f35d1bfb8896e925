// @ts-check
/** A short tour: five stops, each beside what it speaks of, and each lets the person do the thing. It can be skipped. */

import { html, nothing, render } from "../../vendor/lit-html.js";
import { prefer } from "../core/preferences.js";
import { t } from "../core/texts.js";

/** @import { Page } from "../core/page.js" */

/**
 * @typedef {object} Stop
 * @property {string} name  its texts are `tour.stops` and `tour.dos`
 * @property {string} at  what it speaks of, as a selector
 * @property {(page: Page) => void} run  the thing
 */

/** @type {Stop[]} */
const STOPS = [
  { name: "watch", at: "#road", run: (page) => page.act([{ do: page.state().world?.paused ? "resume" : "pause" }], t("tour.dos.watch"), true) },
  { name: "change", at: "#command", run: (page) => page.say(t("talk.examples.change")) },
  { name: "why", at: "#talk", run: (page) => page.say(t("talk.examples.why")) },
  { name: "time", at: "#timeline", run: (page) => void page.timeTravel.at(0) },
  { name: "drive", at: "#controls", run: (page) => page.act([{ do: "mode", mode: "manual" }], t("drive.manual"), true) },
];
const GAP_PX = 12;

/** @param {Page} page @returns {() => void} begins it */
export function createTour(page) {
  const card = document.createElement("div");
  card.id = "tour";
  card.className = "tour";
  card.setAttribute("role", "dialog");
  card.setAttribute("aria-labelledby", "tour-title");
  card.popover = "manual";
  document.body.append(card);
  let at = 0;
  let done = false;

  function show() {
    document.querySelector(".tour-spot")?.classList.remove("tour-spot");
    const stop = STOPS[at];
    const target = /** @type {HTMLElement | null} */ (document.querySelector(stop.at));
    target?.classList.add("tour-spot");
    render(template(stop, at, done, { go, run, end }), card);
    if (target) place(card, target);
  }

  /** @param {number} by */
  function go(by) {
    if (at + by >= STOPS.length) return end();
    at = Math.max(0, at + by);
    done = false;
    show();
    focusFirst();
  }

  function run() {
    STOPS[at].run(page);
    done = true;
    show();
    focusFirst();
  }

  function end() {
    prefer("tour", "seen");
    document.querySelector(".tour-spot")?.classList.remove("tour-spot");
    card.hidePopover();
  }

  const focusFirst = () => /** @type {HTMLElement | null} */ (card.querySelector(".button.strong"))?.focus();
  card.addEventListener("keydown", (event) => {
    event.stopPropagation();
    if (event.key === "Escape") end();
  });
  addEventListener("resize", () => card.matches(":popover-open") && show());

  return () => {
    at = 0;
    done = false;
    card.showPopover();
    show();
    focusFirst();
  };
}

/**
 * @param {Stop} stop
 * @param {number} at
 * @param {boolean} done  whether the thing was done
 * @param {{go: (by: number) => void, run: () => void, end: () => void}} hands
 */
function template({ name }, at, done, { go, run, end }) {
  const last = at === STOPS.length - 1;
  const next = t(last ? "tour.end" : "tour.next");
  return html`<p class="tour-count">${t("tour.count", { number: at + 1, count: STOPS.length })}</p>
    <h2 class="tour-title" id="tour-title">${t(`tour.titles.${name}`)}</h2>
    <p>${t(`tour.stops.${name}`)}</p>
    <div class="tour-buttons">
      <button class="button quiet small" type="button" data-tour="skip" @click=${end}>${t("tour.skip")}</button>
      ${at > 0 ? html`<button class="button small" type="button" data-tour="back" @click=${() => go(-1)}>${t("tour.back")}</button>` : nothing}
      ${
        done
          ? html`<button class="button small strong" type="button" data-tour="next" @click=${() => go(1)}>${next}</button>`
          : html`<button class="button small" type="button" data-tour="next" @click=${() => go(1)}>${next}</button>
              <button class="button small strong" type="button" data-tour="do" @click=${run}>${t(`tour.dos.${name}`)}</button>`
      }
    </div>`;
}

/** Beside what it speaks of, and never over the edge of the window. @param {HTMLElement} card @param {HTMLElement} target */
function place(card, target) {
  const box = target.getBoundingClientRect();
  const { offsetWidth: width, offsetHeight: height } = card;
  const top = box.top > height + 2 * GAP_PX ? box.top - height - GAP_PX : Math.min(box.top + GAP_PX, innerHeight - height - GAP_PX);
  const left = Math.min(Math.max(GAP_PX, box.left + GAP_PX), innerWidth - width - GAP_PX);
  card.style.inset = `${Math.round(Math.max(GAP_PX, top))}px auto auto ${Math.round(left)}px`;
}
