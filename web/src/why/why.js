// @ts-check
/** What is told of a cell, a thing or a past decision, and what can be done about it. Pure. */

import { t } from "../core/texts.js";
import { moveName } from "../core/words.js";
import { hindrance, placing, removing, TOOLS } from "../road/edit.js";
import { same, thingIn } from "../road/hitTest.js";
import { calledOf, headingWords, nameOf, nounOf, placeWords } from "../road/placeTexts.js";
import { egoOf } from "../road/world.js";
import { optionLine } from "./moveOptions.js";

/** @import { Hypothesis } from "./alternatives.js" */
/** @import { Action, Cell, Decision, Option } from "../core/protocol.js" */
/** @import { State } from "../core/state.js" */
/** @import { World, Thing } from "../road/world.js" */

/**
 * @typedef {object} Offer  a button
 * @property {string} text
 * @property {boolean} [small]  one of several alike
 * @property {{actions: Action[], label: string, quiet?: boolean}} [act]
 * @property {Hypothesis} [pick]  what would have been
 */

/**
 * @typedef {object} Told
 * @property {string} kind  what it is of
 * @property {string} title
 * @property {string} note
 * @property {string[]} lines
 * @property {Option[]} moves  that were not made
 * @property {Offer[]} offers
 */

/** @typedef {{kind: "cell", cell: Cell, id: string | null} | {kind: "decision", tick: number}} About */

/**
 * @param {About} about
 * @param {State} state
 * @param {Decision | null} decision  with its whole trace, where that has come
 * @returns {Told | null}
 */
export function tellOf(about, state, decision) {
  const { world } = state;
  if (world === null) return null;
  if (about.kind === "decision") return ofDecision(about.tick, decision);
  const thing = thingOf(world, about);
  const past = state.past !== null;
  if (thing === null) return ofFree(world, about.cell, decision, past);
  return thing.kind === "av" ? ofEgo(world, thing, decision, state.narration, past) : ofThing(world, thing, decision, past);
}

/** @param {World} world @param {{cell: Cell, id: string | null}} at @returns {Thing | null} */
export function thingOf(world, { cell, id }) {
  return (id !== null && world.things.get(id)) || thingIn(world, cell);
}

/**
 * What is past is told, and imagined otherwise; it is not changed.
 * @param {World} world
 * @param {Thing} thing
 * @param {Decision | null} decision
 * @param {boolean} past
 * @returns {Told}
 */
function ofThing(world, thing, decision, past) {
  const { id, kind } = thing;
  const part = linesAbout(decision, id);
  const change = removing(thing);
  const called = calledOf(world, thing);
  return {
    kind,
    title: nounOf(thing),
    note: id,
    lines: [
      [placeWords(world, thing.cell), metres(world, thing.cell), headingWords(thing)].filter(Boolean).join(" · "),
      ...(part.length > 0 ? part : [t("bubble.no_part")]),
    ],
    moves: [],
    offers: [
      ...(decision && part.length > 0 ? [asking(t("bubble.ask_why"), decision)] : []),
      {
        text: t("bubble.what_if_gone"),
        ...(past ? {} : { act: { actions: [{ do: "ask", about: "what_if", change }], label: t("ask.what_if_gone", { id: called }) } }),
        pick: { kind: "change", tick: past ? world.tick : null, actions: change, label: t("counterfactual.without", { things: called }) },
      },
      ...(past ? [] : [{ text: t("bubble.remove"), act: { actions: change, label: t("edit.remove", { id: called }), quiet: true } }]),
    ],
  };
}

/**
 * @param {World} world
 * @param {Thing} ego
 * @param {Decision | null} decision
 * @param {string | null} narration
 * @param {boolean} past
 * @returns {Told}
 */
function ofEgo(world, ego, decision, narration, past) {
  return {
    kind: "av",
    title: world.mode === "manual" ? t("bubble.manual") : nameOf(ego),
    note: ego.id,
    lines: [placeWords(world, ego.cell), decision?.narration ?? narration ?? t("bubble.undecided")],
    moves: rejected(decision),
    offers: [...(decision ? [asking(t("bubble.ask_why"), decision)] : []), ...(past ? [] : [steering(world)])],
  };
}

/** Who drives. @param {World} world @returns {Offer} */
function steering({ mode }) {
  const next = mode === "manual" ? "auto" : "manual";
  const text = t(`drive.${next}`);
  return { text, act: { actions: [{ do: "mode", mode: next }], label: text, quiet: true } };
}

/** @param {World} world @param {Cell} cell @param {Decision | null} decision @param {boolean} past @returns {Told} */
function ofFree(world, cell, decision, past) {
  const option = optionTo(decision, cell);
  /** @type {Offer[]} */
  const offers = [];
  if (decision && option && option.move !== decision.move) {
    const { move } = option;
    offers.push({ text: t("bubble.what_if_here"), pick: { kind: "move", tick: decision.tick, move } });
    offers.push(asking(t("bubble.ask_why_not"), decision, move));
  }
  for (const { kind } of TOOLS) {
    if (past || hindrance(world, kind, cell) !== null) continue;
    const label = t("edit.put_here", { thing: nameOf({ kind }) });
    offers.push({ text: nounOf({ kind }), small: true, act: { actions: placing(kind, cell), label, quiet: true } });
  }
  return {
    kind: "free",
    title: t("bubble.free"),
    note: "",
    lines: [[placeWords(world, cell), metres(world, cell)].filter(Boolean).join(" · "), ...(option ? [optionLine(option)] : [])],
    moves: [],
    offers,
  };
}

/** @param {number} tick @param {Decision | null} decision @returns {Told} */
function ofDecision(tick, decision) {
  return {
    kind: "decision",
    title: decision ? moveName(decision.move) : t("bubble.decision"),
    note: t("bubble.tick", { tick }),
    lines: [decision?.narration ?? "…"],
    moves: rejected(decision),
    offers: decision ? [asking(t("bubble.ask_why"), decision)] : [],
  };
}

/** @param {string} text @param {Decision} decision @param {Option["move"]} [not]  the move that was not made @returns {Offer} */
function asking(text, { tick, move }, not) {
  const label = t(not ? "ask.why_not" : "ask.why", { move: moveName(not ?? move), tick });
  /** @type {Action} */
  const question = not ? { do: "ask", about: "why_not", tick, move: not } : { do: "ask", about: "why", tick };
  return { text, act: { actions: [question], label } };
}

/** Moves that could have been driven, and were not. @param {Decision | null} decision */
function rejected(decision) {
  return (decision?.options ?? []).filter(({ move, cell }) => cell && move !== decision?.move);
}

/** What the latest decision made of a thing: its narration, and each move that the thing ruled out. @param {Decision | null} decision @param {string} id */
export function linesAbout(decision, id) {
  if (decision === null) return [];
  const ruled = (decision.options ?? []).filter(({ causes }) => causes?.includes(id));
  if (ruled.length === 0 && !decision.causes?.includes(id)) return [];
  return [...ruled.map(optionLine), ...(decision.narration ? [decision.narration] : [])];
}

/** The move that leads to a cell. @param {Decision | null} decision @param {Cell} cell */
export function optionTo(decision, cell) {
  return decision?.options?.find((each) => same(cell, each.cell)) ?? null;
}

/** @param {World} world @param {Cell} cell */
function metres(world, cell) {
  const ego = egoOf(world);
  const cells = ego ? Math.max(Math.abs(cell[0] - ego.cell[0]), Math.abs(cell[1] - ego.cell[1])) : 0;
  return cells === 0 ? "" : t("units.metres", { value: cells * 5 });
}
