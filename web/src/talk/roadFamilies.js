// @ts-check
/** New roads to choose from the palette, one of each family. */

import { LAYOUTS } from "../core/words.js";

/** @import { Panel } from "../panels/index.js" */

/** @returns {Panel} */
export function createRoads() {
  return {
    acts: Object.entries(LAYOUTS).map(([layout, words]) => ({
      name: `road-${layout}`,
      group: "New road",
      now: ({ past, world }) => (world === null || past ? null : { label: `New road: ${words}`, turns: [[{ do: "scenario", layout }]] }),
    })),
  };
}
