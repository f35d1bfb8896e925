// @ts-check
/** The road lane by lane: what stands and moves from beside the vehicle to as far as is seen. */

import { t } from "../core/texts.js";
import { moveName } from "../core/words.js";
import { headingWords, nameOf } from "./placeTexts.js";
import { egoOf } from "./world.js";

/** @import { Decision } from "../core/protocol.js" */
/** @import { Thing, World } from "./world.js" */

/**
 * @param {World} world
 * @param {Decision | null} decision  the latest
 * @returns {string[]}
 */
export function roadWords(world, decision) {
  const ego = egoOf(world);
  if (!ego) return [t("road.no_vehicle")];
  const [own, row] = ego.cell;
  const first = t("lanes.first", { tick: world.tick, lane: own + 1, columns: world.columns, count: row });
  const moved = decision ? ` ${t("lanes.moved", { move: moveName(decision.move) })}` : "";
  const lanes = Array.from({ length: world.columns }, (_, column) => {
    const there = [...world.things.values()]
      .filter(({ kind, cell }) => kind !== "av" && cell[0] === column && row - cell[1] >= 0 && row - cell[1] <= world.visibleRows)
      .sort((a, b) => b.cell[1] - a.cell[1]);
    const things = there.map((thing) => thingText(thing, row)).join("; ") || t("lanes.free");
    return t(column === own ? "lanes.own" : "lanes.lane", { lane: column + 1, things });
  });
  return [first + moved, ...lanes];
}

/** @param {Thing} thing @param {number} row  the vehicle's */
function thingText(thing, row) {
  const ahead = row - thing.cell[1];
  const there = t(ahead === 0 ? "lanes.beside" : "lanes.ahead", { thing: nameOf(thing), count: ahead });
  return [there, headingWords(thing)].filter(Boolean).join(", ");
}
