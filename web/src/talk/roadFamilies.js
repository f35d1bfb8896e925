// @ts-check
/** New roads to choose from the palette, one of each family. */

import { t } from "../core/texts.js";
import { LAYOUTS, layoutName } from "../core/words.js";

/** @import { Scenario } from "../core/wire.js" */
/** @import { Panel } from "../panels/index.js" */

/** @returns {Panel} */
export function createRoads() {
  return {
    commands: LAYOUTS.map((layout) => ({
      name: `road-${layout}`,
      group: t("groups.new_road"),
      now: ({ past, world }) => (world === null || past ? null : { label: t("talk.new_road", { name: layoutName(layout) }), turns: [[{ do: "scenario", layout: /** @type {Scenario["layout"]} */ (layout) }]] }),
    })),
  };
}
