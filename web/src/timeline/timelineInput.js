// @ts-check
/** Pointer, wheel and keys on the timeline: dragged, pointed at, walked along. */

import { nowOf } from "./timelineState.js";
import { tickAt } from "./paint/line.js";

/** @import { Page } from "../core/page.js" */

const LEAP = 10;
/** So far a wheel is turned for a tick: about a notch. */
const WHEEL_PX = 100;

/**
 * The wheel goes along the run, upwards to later ticks as the vehicle drives. A page that can scroll is scrolled instead,
 * unless the wheel is turned sideways.
 * @param {Page} page
 * @param {HTMLElement} place  over which it does so
 * @param {() => boolean} [wanted]
 */
export function watchWheel(page, place, wanted = () => true) {
  let turned = 0;
  place.addEventListener(
    "wheel",
    (event) => {
      const { deltaX, deltaY, deltaMode, ctrlKey } = event;
      const { scrollHeight, clientHeight } = document.documentElement;
      const sideways = Math.abs(deltaX) > Math.abs(deltaY);
      if (ctrlKey || !wanted() || (!sideways && scrollHeight > clientHeight)) return;
      event.preventDefault();
      const turn = (sideways ? deltaX : -deltaY) * (deltaMode === WheelEvent.DOM_DELTA_PIXEL ? 1 : 33);
      turned = turn * turned < 0 ? turn : turned + turn;
      const ticks = Math.trunc(turned / WHEEL_PX);
      turned -= ticks * WHEEL_PX;
      if (ticks !== 0) void page.timeTravel.step(ticks);
    },
    { passive: false },
  );
}

/**
 * Listeners of the slider.
 * @param {Page} page
 * @param {() => {width: number, span: number}} line
 * @param {(tick: number | null) => void} point  a tick is pointed at, or none any more
 */
export function sliderInput(page, line, point) {
  let dragging = false;

  /** @param {PointerEvent} event */
  function move(event) {
    const slider = /** @type {HTMLElement} */ (event.currentTarget);
    const tick = tickAt(line(), event.clientX - slider.getBoundingClientRect().left);
    const reached = Math.max(0, Math.min(nowOf(page.state().timeline), tick));
    if (dragging) void page.timeTravel.at(reached);
    point(reached);
  }

  return {
    move,

    /** @param {PointerEvent} event */
    down(event) {
      if (event.button !== 0) return;
      dragging = true;
      /** @type {HTMLElement} */ (event.currentTarget).setPointerCapture(event.pointerId);
      move(event);
    },

    up() {
      dragging = false;
    },

    leave: () => point(null),

    /** @param {KeyboardEvent} event */
    key(event) {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      const leap = event.shiftKey ? LEAP : 1;
      const { timeTravel } = page;
      const ways = /** @type {Record<string, () => unknown>} */ ({
        ArrowLeft: () => timeTravel.step(-leap),
        ArrowDown: () => timeTravel.step(-leap),
        ArrowRight: () => timeTravel.step(leap),
        ArrowUp: () => timeTravel.step(leap),
        PageDown: () => timeTravel.step(-LEAP),
        PageUp: () => timeTravel.step(LEAP),
        Home: () => timeTravel.at(0),
        End: () => timeTravel.live(),
        Escape: () => timeTravel.live(),
      });
      if (!Object.hasOwn(ways, event.key)) return;
      void ways[event.key]();
      event.preventDefault();
      event.stopPropagation();
    },
  };
}
