// @ts-check
/**
 * One redraw per animation frame, and none when nothing moves.
 *
 * Whatever happens only wakes the loop; the next frame brings the panels up to date once, however
 * much happened, and draws. A frame asks for the next one only while something is on its way.
 */

/**
 * @param {object} work
 * @param {() => void} work.update  brings panels up to date with the state
 * @param {(now: number) => boolean} work.draw  draws what moves; whether there is more to come
 * @param {(frame: (now: number) => void) => unknown} [work.request]
 * @returns {{wake: (changed?: boolean) => void}}
 */
export function createLoop({ update, draw, request = (frame) => requestAnimationFrame(frame) }) {
  let asked = false;
  let stale = false;

  /** @param {number} now */
  function frame(now) {
    asked = false;
    if (stale) {
      stale = false;
      update();
    }
    if (draw(now)) ask();
  }

  function ask() {
    if (asked) return;
    asked = true;
    request(frame);
  }

  return {
    wake(changed = false) {
      stale ||= changed;
      ask();
    },
  };
}
