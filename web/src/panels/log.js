// @ts-check
/** The driving log: newest last, following the newest unless the reader has scrolled up. */

import { html, nothing, render, repeat } from "../../vendor/lit-html.js";
import { t } from "../core/texts.js";
import { find } from "../ui/slot.js";

/** @import { Line } from "../talk/journal.js" */
/** @import { Panel } from "./index.js" */

const NEAR_END_PX = 24;

/** @param {HTMLElement} host @returns {Panel} */
export function createLog(host) {
  /** @type {Line[]} */ let lines = [];
  /** The past tick that is looked at. @type {number | null} */ let tickLooked = null;
  /** The line of what was decided there. @type {Line | null} */ let looked = null;
  let following = true;
  /** The list's size when it was last laid out: what it scrolls by itself because its size changes is nobody's wish. */
  let size = "";

  function show() {
    render(
      html`<ol class="log-lines" tabindex="0" aria-label=${t("log.label")} data-none=${t("log.none")} @scroll=${scrolled}>${repeat(lines, ({ key }) => key, (line) => row(line, { looked: line === looked, later: tickLooked !== null && line.from > tickLooked }))}</ol>
        <button class="button small newest" type="button" ?hidden=${following} @click=${() => follow(true)}>${t("log.newest")}</button>`,
      host,
    );
  }

  function scrolled() {
    const list = find(host, ".log-lines");
    if (sizeOf(list) !== size) return;
    follow(list.scrollHeight - list.scrollTop - list.clientHeight < NEAR_END_PX, false);
  }

  /** @param {boolean} on @param {boolean} [scroll] */
  function follow(on, scroll = on) {
    if (on !== following) {
      following = on;
      show();
    }
    const list = find(host, ".log-lines");
    if (scroll) list.scrollTop = list.scrollHeight;
  }

  /** @param {number | null} tick */
  function lookAt(tick) {
    tickLooked = tick;
    looked = tick === null ? null : (lines.findLast(({ from, to }) => from <= tick && tick <= to) ?? looked);
    show();
    if (tick === null) return follow(true);
    const [list, line] = [find(host, ".log-lines"), host.querySelector("[data-looked]")];
    if (line instanceof HTMLElement) list.scrollTop = line.offsetTop - list.offsetTop - list.clientHeight / 2;
  }

  show();
  // A window made smaller keeps the newest in sight.
  new ResizeObserver(([{ target }]) => {
    size = sizeOf(target);
    if (following) follow(true);
  }).observe(find(host, ".log-lines"));
  return {
    update({ log, past }, before) {
      lines = log;
      if (past !== before.past) return lookAt(past && past.world.tick);
      if (log === before.log) return;
      show();
      if (following) follow(true);
    },
  };
}

/** @param {Element} list */
const sizeOf = ({ clientWidth, clientHeight }) => `${clientWidth} ${clientHeight}`;

/** @param {Line} line @param {{looked: boolean, later: boolean}} seen  `later`: it speaks of what came after the tick that is looked at */
function row(line, { looked, later }) {
  return html`<li class="log-line" data-tone=${line.tone} data-type=${line.type} data-tick=${line.from} ?data-looked=${looked} ?data-later=${later || line.gone}>
    <span class="log-tick">${ticks(line)}</span>
    <span class="log-text">${line.said ? html`<span class="log-said">${t("log.said", { text: line.said })} </span>` : nothing}${linked(line.text)}</span>
  </li>`;
}

/** @param {Line} line */
function ticks({ from, to }) {
  return from === to ? String(from) : `${from}–${to}`;
}

/** The address of a report as a link. @param {string} text */
export function linked(text) {
  const parts = text.split(/(\/api\/\S+\/report)/);
  return parts.map((part, at) => (at % 2 === 0 ? part : html`<a href=${part} target="_blank" rel="noopener">${t("session.open")}</a>`));
}
