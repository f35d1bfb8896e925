// @ts-check
/** The road in sentences, a lane each: what stands and moves from beside the vehicle to as far as is seen. */

import { headingWords, nameOf } from "./hitTest.js";
import { counted, MOVES } from "../core/words.js";
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
  if (!ego) return ["There is no autonomous vehicle."];
  const [lane, row] = ego.cell;
  const went = decision ? ` It last moved ${MOVES[decision.move].name}.` : "";
  const first = `Tick ${world.tick}. The vehicle is in lane ${lane + 1} of ${world.columns}, ${row} rows from the destination.${went}`;
  const lanes = Array.from({ length: world.columns }, (_, column) => {
    const there = [...world.things.values()]
      .filter(({ kind, cell }) => kind !== "av" && cell[0] === column && row - cell[1] >= 0 && row - cell[1] <= world.visibleRows)
      .sort((a, b) => b.cell[1] - a.cell[1]);
    const own = column === lane ? ", its own" : "";
    return `Lane ${column + 1}${own}: ${there.map((thing) => said(thing, row)).join("; ") || "free as far as is seen"}.`;
  });
  return [first, ...lanes];
}

/** @param {Thing} thing @param {number} row */
function said(thing, row) {
  const ahead = row - thing.cell[1];
  const where = ahead === 0 ? "beside it" : `${counted(ahead, "row")} ahead`;
  const heading = headingWords(thing);
  return `${nameOf(thing)} ${where}${heading ? `, ${heading}` : ""}`;
}
