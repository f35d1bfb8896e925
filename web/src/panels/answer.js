// @ts-check
/** An answer with its evidence: causes to point at, the proof, and what else could have been done. */

import { icon } from "../icons.js";
import { make } from "../dom.js";
import { MOVES, plain, reasonWords } from "../words.js";

/** @typedef {import("../protocol.js").Answer} Answer */
/** @typedef {import("../main.js").Page} Page */

/**
 * @param {Answer} answer
 * @param {string} reply
 * @param {Page} page
 */
export function answerElement(answer, reply, page) {
  const element = make("div", { class: "answer" }, make("p", { class: "reply" }, answer.text || reply));
  const causes = answer.causes ?? [];
  if (causes.length > 0) {
    element.append(
      make("ul", { class: "causes", "aria-label": "Causes" }, ...causes.map((cause) => causeElement(cause, page))),
    );
  }
  const proof = causes.length > 0 ? proofWords(answer) : "";
  if (proof) {
    element.append(make("p", { class: "proof" }, icon("proof"), make("span", {}, proof)));
  }
  const alternatives = answer.alternatives ?? [];
  if (alternatives.length > 0) element.append(alternativesElement(alternatives));
  return element;
}

/**
 * @param {Answer["causes"][number]} cause
 * @param {Page} page
 */
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
      make("span", { class: "cause-name" }, cause.id.replace("-", " ")),
      cause.role ? make("span", { class: "cause-role" }, plain(cause.role)) : null,
    ),
  );
}

/**
 * What was shown by running the moment again; nothing is said that was not.
 * @param {Answer} answer
 */
function proofWords({ verified, counterfactual }) {
  if (!verified?.necessary && !verified?.sufficient) return "";
  const instead = counterfactual?.decision?.move;
  const parts = ["Proved by re-simulation"];
  if (verified.necessary && instead && MOVES[instead]) {
    parts.push(`without the cause the move is ${MOVES[instead].name}`);
  } else if (verified.necessary) parts.push("without the cause the decision changes");
  if (verified.sufficient) parts.push("with it alone it stays the same");
  return `${parts[0]}: ${parts.slice(1).join("; ")}.`;
}

/** @param {import("../protocol.js").Option[]} alternatives */
function alternativesElement(alternatives) {
  return make(
    "details",
    { class: "alternatives" },
    make("summary", {}, `${alternatives.length} other ${alternatives.length === 1 ? "move" : "moves"}`),
    make(
      "ul",
      {},
      ...alternatives.map(({ move, verdict, reason }) =>
        make(
          "li",
          { "data-verdict": verdict },
          make("span", { class: "option-arrow", "aria-hidden": "true" }, MOVES[move]?.arrow ?? ""),
          make("span", { class: "option-move" }, MOVES[move]?.name ?? plain(move)),
          make("span", { class: "option-reason" }, reasonWords(reason)),
        ),
      ),
    ),
  );
}
