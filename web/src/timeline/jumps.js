// @ts-check
/** Jumping along the run from event to event, by buttons, keys and the palette. */

import { html } from "../../vendor/lit-html.js";
import { t } from "../core/texts.js";
import { icon } from "../ui/icons.js";
import { eventText, JUMPS, nextEvent } from "./timelineEvents.js";
import { allEvents } from "./timelineState.js";

/** @import { Command } from "../core/commands.js" */
/** @import { Page } from "../core/page.js" */

const WAYS = /** @type {const} */ ([
  { direction: -1, name: "previous", key: "[" },
  { direction: 1, name: "next", key: "]" },
]);

/** @param {Page} page */
export function createJumps(page) {
  let chosen = JUMPS[0].name;
  /** @type {(() => void) | null} a jump that waits for the part of the run that is about to be known */ let sought = null;

  /** @param {string} name @param {1 | -1} direction */
  function jump(name, direction) {
    const { look, session, timeline, world } = page.state();
    sought = timeline.loading ? () => session === page.state().session && jump(name, direction) : null;
    if (sought) return;
    const kinds = JUMPS.find((each) => each.name === name)?.kinds ?? [];
    const event = nextEvent(allEvents(timeline), kinds, look.tick ?? world?.tick ?? 0, direction);
    const kind = t(`timeline.kinds.${name}`);
    if (event) {
      page.tell({ text: t("timeline.found", { tick: event.tick, text: eventText(event) }), aloud: true });
      void page.timeTravel.at(event.tick);
    } else if (direction > 0 && look.tick !== null) {
      page.timeTravel.live();
      page.tell({ text: t("timeline.none_later_live", { kind }) });
    } else page.tell({ text: t(direction < 0 ? "timeline.none_earlier" : "timeline.none_later", { kind }) });
  }

  page.subscribe(({ timeline }) => {
    if (timeline.loading || sought === null) return;
    const now = sought;
    sought = null;
    now();
  });

  return {
    commands: jumpCommands(jump, () => chosen),

    /** The buttons, with the choice between them. */
    buttons() {
      const [back, forth] = WAYS.map((way) => button(way, () => jump(chosen, way.direction)));
      return html`<div class="jumps" role="group" aria-label=${t("timeline.jumps")}>
        ${back}
        <select class="line-kinds" aria-label=${t("timeline.jump_between")} @change=${choose}>
          ${JUMPS.map(({ name }) => html`<option value=${name}>${t(name === "any" ? "timeline.any" : `timeline.kinds.${name}`)}</option>`)}
        </select>
        ${forth}
      </div>`;
    },
  };

  /** @param {Event} event */
  function choose({ target }) {
    chosen = /** @type {HTMLSelectElement} */ (target).value;
  }
}

/** @param {typeof WAYS[number]} way @param {() => void} press */
function button({ name, key }, press) {
  const label = t(`timeline.${name}_kind`, { kind: t("timeline.kinds.any") });
  const title = `${t(`timeline.${name}`)}  ${key}`;
  return html`<button class="button icon small" type="button" data-jump=${name} aria-label=${label} title=${title} aria-keyshortcuts=${key} @click=${press}>
    ${icon(name)}
  </button>`;
}

/**
 * @param {(name: string, direction: 1 | -1) => void} jump
 * @param {() => string} chosen
 * @returns {Command[]}
 */
function jumpCommands(jump, chosen) {
  const group = t("groups.time");
  return WAYS.flatMap(({ direction, name: way, key }) => [
    { name: way, group, key, keyName: key, repeats: true, now: () => ({ label: t(`timeline.${way}_chosen`), run: () => jump(chosen(), direction) }) },
    ...JUMPS.slice(1).map(({ name }) => ({
      name: `${way}-${name}`,
      group,
      now: () => ({ label: t(`timeline.${way}_kind`, { kind: t(`timeline.kinds.${name}`) }), run: () => jump(name, direction) }),
    })),
  ]);
}
