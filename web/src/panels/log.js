// @ts-check
/** The driving log: newest last, following the newest unless the reader has scrolled up. */

import { make, setText } from "../ui/dom.js";

/** @import { Line } from "../talk/journal.js" */
/** @import { Panel } from "./index.js" */

const NEAR_END_PX = 24;

/** @param {HTMLElement} host @returns {Panel} */
export function createLog(host) {
  const list = make("ol", { class: "log-lines", tabIndex: 0, "aria-label": "Driving log, newest last" });
  const newest = make(
    "button",
    { class: "button small newest", type: "button", hidden: true, onclick: () => follow(true) },
    "Newest ↓",
  );
  host.append(list, newest);
  /** @type {Map<string, {line: Line, row: HTMLElement}>} */
  const rows = new Map();
  let following = true;

  list.addEventListener("scroll", () => {
    following = list.scrollHeight - list.scrollTop - list.clientHeight < NEAR_END_PX;
    newest.hidden = following;
  });

  /** @param {boolean} on */
  function follow(on) {
    following = on;
    newest.hidden = on;
    if (on) list.scrollTop = list.scrollHeight;
  }

  /** The line of the decision that led to what is looked at. @param {number | null} tick */
  function lookedAt(tick) {
    list.querySelector("[data-looked]")?.removeAttribute("data-looked");
    if (tick === null) return follow(true);
    const found = [...rows.values()].findLast(({ line }) => line.from <= tick && tick <= line.to);
    if (!found) return;
    found.row.setAttribute("data-looked", "");
    list.scrollTop = found.row.offsetTop - list.offsetTop - list.clientHeight / 2;
  }

  return {
    update({ log, past }, before) {
      if (past !== before.past) lookedAt(past && past.world.tick - 1);
      if (log === before.log) return;
      const kept = new Set(log.map(({ key }) => key));
      for (const [key, { row }] of rows) {
        if (kept.has(key)) continue;
        row.remove();
        rows.delete(key);
      }
      for (const line of log) {
        const known = rows.get(line.key);
        if (known?.line === line) continue;
        if (known) setText(/** @type {Element} */ (known.row.firstElementChild), ticks(line));
        const row = known?.row ?? list.appendChild(rowOf(line));
        rows.set(line.key, { line, row });
      }
      if (following) follow(true);
    },
  };
}

/** @param {Line} line */
function rowOf(line) {
  return make(
    "li",
    { class: "log-line", "data-tone": line.tone, "data-type": line.type },
    make("span", { class: "log-tick" }, ticks(line)),
    make("span", { class: "log-text" }, line.said && make("span", { class: "log-said" }, `“${line.said}” `), line.text),
  );
}

/** @param {Line} line */
function ticks({ from, to }) {
  return from === to ? String(from) : `${from}–${to}`;
}
