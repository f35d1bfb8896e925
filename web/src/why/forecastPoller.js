// @ts-check
/** Asks what is about to happen, while anything on the page shows it: one question at a time, the newest first. */

import { foreseen, foresee, showsPath, underWay } from "./forecast.js";
import { Latest } from "../core/latest.js";

/** @import { Page } from "../core/page.js" */
/** @import { Panel } from "../panels/index.js" */

/** @param {Page} page @returns {Panel} */
export function createForesight(page) {
  const latest = new Latest({
    /** @param {{session: string, world: import("../road/world.js").World, past: boolean, path: boolean}} asked */
    ask: ({ session, world, past, path }) => foresee(session, world, past, { path }),
    tell: (foresight) => page.foresee(foresight),
    pauseMs: 0,
  });

  return {
    update(state, before) {
      const { views, world, session, past, prior, connection } = state;
      const same = world === before.world && views === before.views && past === before.past && connection === before.connection;
      if (same || !world || !session || connection.phase !== "live") return;
      const moving = underWay(state);
      const path = showsPath(state);
      const atOnce = views.forecast || path;
      const shown = ((views.plan || views.path) && !(moving && !world.paused)) || atOnce;
      const known = foreseen(state);
      if (!shown || (known && (known.path || !path))) return latest.drop();
      // After a step the plan first shows the move under way, and what comes next when that is made.
      latest.pauseMs = moving && !atOnce && world !== prior ? world.stepS * 900 : 0;
      latest.want({ session, world, past: past !== null, path });
    },
  };
}
