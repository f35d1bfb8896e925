// @ts-check
/** An answer with its evidence: causes to point at, the proof, and what else could have been done. */

import { labelOf } from "../why/alternatives.js";
import { icon } from "../ui/icons.js";
import { make } from "../ui/dom.js";
import { counted, MOVES, plain, reasonWords } from "../core/words.js";

/** @import { Page } from "../main.js" */
/** @import { Action, Answer, Option } from "../core/protocol.js" */

/** @param {Answer} answer @param {string} reply @param {Page} page */
export function answerElement(answer, reply, page) {
  const element = make("div", { class: "answer" }, make("p", { class: "reply" }, answer.text || reply));
  const causes = answer.causes ?? [];
  if (causes.length > 0) {
    element.append(
      make("ul", { class: "causes", "aria-label": "Causes" }, ...causes.map((cause) => causeElement(cause, page))),
    );
  }
  const proof = causes.length > 0 ? proofElement(answer) : null;
  if (proof) element.append(proof);
  const others = (answer.alternatives ?? []).filter(({ move }) => move !== answer.move);
  if (others.length > 0) element.append(alternativesElement(others, answer.tick, page));
  const play = answer.play ?? answer.counterfactual;
  if (play?.at_tick !== undefined) element.append(watchElement(play.at_tick, play.actions ?? play.change ?? [], page));
  return element;
}

/** @param {Answer["causes"][number]} cause @param {Page} page */
function causeElement(cause, page) {
  const show = () => page.highlight({ ids: [cause.id], cells: cause.cell ? [cause.cell] : [] });
  const hide = () => page.highlight(null);
  return make(
    "li",
    {},
    make(
      "button",
      {
        class: "cause",
        type: "button",
        title: "Show on the road",
        "data-kind": cause.kind,
        onpointerenter: show,
        onpointerleave: hide,
        onfocus: show,
        onblur: hide,
        onclick: show,
      },
      make("span", { class: "cause-name" }, cause.id),
      make("span", { class: "cause-role" }, roleWords(cause)),
    ),
  );
}

/** @param {Answer["causes"][number]} cause */
function roleWords({ role, moves }) {
  const names = (moves ?? []).map((move) => MOVES[move]?.name ?? plain(move));
  return [plain(role), names.join(", ")].join(" ").trim();
}

const PROOFS = /** @type {const} */ ([
  ["necessary", "without it the decision is another"],
  ["sufficient", "with nothing but it the decision is the same"],
  ["minimal", "no part of it can be left out"],
]);

/**
 * What was shown by running the moment again; nothing is said that was not.
 * @param {Answer} answer
 */
function proofElement({ verified }) {
  const shown = PROOFS.filter(([property]) => verified?.[property]);
  if (shown.length === 0) return null;
  return make(
    "p",
    { class: "proof" },
    icon("proof"),
    make("span", {}, "Proved by re-simulation"),
    ...shown.map(([property, meaning]) => make("span", { class: "proof-tag", title: meaning }, property)),
  );
}

/** Play a change beside the real run. @param {number} tick @param {Action[]} actions @param {Page} page */
function watchElement(tick, actions, page) {
  const watch = () => page.pick?.({ kind: "change", tick, actions, label: labelOf(actions) });
  return make("button", { class: "button small watch", type: "button", onclick: watch }, icon("play"), "Watch it beside the real run");
}

/** @param {Option[]} alternatives @param {number | null} tick @param {Page} page */
function alternativesElement(alternatives, tick, page) {
  return make(
    "details",
    { class: "alternatives" },
    make("summary", {}, counted(alternatives.length, "other move")),
    make(
      "ul",
      {},
      ...alternatives.map(({ move, cell, verdict, reason }) =>
        make(
          "li",
          { "data-verdict": verdict },
          make("span", { class: "option-arrow", "aria-hidden": "true" }, MOVES[move]?.arrow ?? ""),
          make("span", { class: "option-move" }, MOVES[move]?.name ?? plain(move)),
          make("span", { class: "option-reason" }, reasonWords(reason)),
          cell && tick !== null
            ? make(
                "button",
                {
                  class: "option-watch",
                  type: "button",
                  "aria-label": `Watch ${MOVES[move]?.name ?? plain(move)} beside the real run`,
                  title: "Watch it beside the real run",
                  onclick: () => page.pick?.({ kind: "move", tick, move }),
                },
                icon("play"),
              )
            : null,
        ),
      ),
    ),
  );
}
