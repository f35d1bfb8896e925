// @ts-check
/** What is told of a cell, a thing or a past decision, and what can be done about it. Pure. */

import { hindrance, placing, removing, TOOLS } from "../road/edit.js";
import { decidedAbout, decidedOn, headingWords, moveName, nameOf, placeWords, thingIn } from "../road/hitTest.js";
import { labelOf } from "./alternatives.js";
import { egoOf } from "../road/world.js";

/** @import { Otherwise } from "./alternatives.js" */
/** @import { Action, Cell, Decision, Option } from "../core/protocol.js" */
/** @import { State } from "../core/state.js" */
/** @import { World, Thing } from "../road/world.js" */

/**
 * @typedef {object} Offer  a button
 * @property {string} text
 * @property {boolean} [small]  one of several alike
 * @property {{actions: Action[], label: string, quiet?: boolean}} [act]
 * @property {Otherwise} [pick]  what would have been
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
  const part = decidedAbout(decision, id);
  const change = removing(thing);
  return {
    kind,
    title: nameOf(thing).replace(/^an? /, ""),
    note: id,
    lines: [
      [placeWords(world, thing.cell), metres(world, thing.cell), headingWords(thing)].filter(Boolean).join(" · "),
      part ?? "It had no part in the latest decision.",
    ],
    moves: [],
    offers: [
      ...(decision && part ? [asking("Ask why", decision)] : []),
      {
        text: "What if it weren't there?",
        ...(past ? {} : { act: { actions: [{ do: "ask", about: "what_if", change }], label: `What if ${id} weren't there?` } }),
        pick: { kind: "change", tick: past ? world.tick : null, actions: change, label: labelOf(change) },
      },
      ...(past ? [] : [{ text: "Remove", act: { actions: change, label: `Remove ${id}`, quiet: true } }]),
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
    title: world.mode === "manual" ? "the vehicle you drive" : nameOf(ego),
    note: ego.id,
    lines: [placeWords(world, ego.cell), decision?.narration ?? narration ?? "It has not decided anything yet."],
    moves: rejected(decision),
    offers: [
      ...(decision ? [asking("Ask why", decision)] : []),
      ...(past ? [] : [steering(world)]),
    ],
  };
}

/** Who drives. @param {World} world @returns {Offer} */
function steering({ mode }) {
  return mode === "manual"
    ? { text: "Let it drive itself", act: { actions: [{ do: "mode", mode: "auto" }], label: "Let it drive itself", quiet: true } }
    : { text: "Drive by hand", act: { actions: [{ do: "mode", mode: "manual" }], label: "Drive by hand", quiet: true } };
}

/** @param {World} world @param {Cell} cell @param {Decision | null} decision @param {boolean} past @returns {Told} */
function ofFree(world, cell, decision, past) {
  const on = decidedOn(decision, cell);
  /** @type {Offer[]} */
  const offers = [];
  if (decision && on && !on.taken) {
    const { move } = on.option;
    offers.push({ text: "What if it had gone here?", pick: { kind: "move", tick: decision.tick, move } });
    offers.push(asking("Ask why not", decision, move));
  }
  for (const { kind, name } of TOOLS) {
    if (past || hindrance(world, kind, cell) !== null) continue;
    const label = `Put a ${name.toLowerCase()} here`;
    offers.push({ text: name, small: true, act: { actions: placing(kind, cell), label, quiet: true } });
  }
  return {
    kind: "free",
    title: "free road",
    note: "",
    lines: [[placeWords(world, cell), metres(world, cell)].filter(Boolean).join(" · "), ...(on ? [on.text] : [])],
    moves: [],
    offers,
  };
}

/** @param {number} tick @param {Decision | null} decision @returns {Told} */
function ofDecision(tick, decision) {
  return {
    kind: "decision",
    title: decision ? moveName(decision.move) : "decision",
    note: `tick ${tick}`,
    lines: [decision?.narration ?? "…"],
    moves: rejected(decision),
    offers: decision ? [asking("Ask why", decision)] : [],
  };
}

/** @param {string} text @param {Decision} decision @param {Option["move"]} [not]  the move that was not made @returns {Offer} */
function asking(text, { tick, move }, not) {
  const label = not ? `Why not ${moveName(not)} at tick ${tick}?` : `Why ${moveName(move)} at tick ${tick}?`;
  const question = not ? { do: "ask", about: "why_not", tick, move: not } : { do: "ask", about: "why", tick };
  return { text, act: { actions: [question], label } };
}

/** Moves that could have been driven, and were not. @param {Decision | null} decision */
function rejected(decision) {
  return (decision?.options ?? []).filter(({ move, cell }) => cell && move !== decision?.move);
}

/** @param {World} world @param {Cell} cell */
function metres(world, cell) {
  const ego = egoOf(world);
  const cells = ego ? Math.max(Math.abs(cell[0] - ego.cell[0]), Math.abs(cell[1] - ego.cell[1])) : 0;
  return cells === 0 ? "" : `${cells * 5} m`;
}
