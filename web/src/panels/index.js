// @ts-check
/** The panels of the page, each in a file of its own; a new panel is a file and a line here. */

import { byId } from "../dom.js";
import { createAnnouncer } from "./announcer.js";
import { createCaption } from "./caption.js";
import { createCard } from "./card.js";
import { createCommand } from "./command.js";
import { createComparison } from "./comparison.js";
import { createConnectionBadge } from "./connection.js";
import { createControls } from "./controls.js";
import { createDriver } from "./driver.js";
import { createExport } from "./export.js";
import { createForesight } from "./foresight.js";
import { createHelp } from "./help.js";
import { createHands } from "./hands.js";
import { createLanes } from "./lanes.js";
import { createLog } from "./log.js";
import { createMetrics } from "./metrics.js";
import { createNotice } from "./notice.js";
import { createOccupancy } from "./occupancy.js";
import { createPalette } from "./palette.js";
import { createLooking, createPast } from "./past.js";
import { createPixels } from "./pixels.js";
import { createPlan } from "./plan.js";
import { createRoad } from "./road.js";
import { createRoads } from "./roads.js";
import { createSchematic } from "./schematic.js";
import { createShare } from "./share.js";
import { createReader } from "./speech.js";
import { createStatus } from "./status.js";
import { createTalk } from "./talk.js";
import { createTimeline } from "./timeline.js";
import { createVerdict } from "./verdict.js";
import { createViews } from "./views.js";

/** @import { Act } from "../acts.js" */
/** @import { Page } from "../main.js" */
/** @import { State } from "../state.js" */

/**
 * @typedef {object} Panel  any of these; all are called at most once a frame
 * @property {(state: State, before: State) => void} [update]  the state has changed
 * @property {(now: number) => boolean} [draw]  draw what moves; whether there is more to come
 * @property {() => void} [repaint]  size or colours have changed
 * @property {Act[]} [acts]  what can be done with it by a key or from the palette
 */

/** @param {Page} page @returns {Panel[]} */
export function createPanels(page) {
  byId("new-session").addEventListener("click", () => page.startSession());
  const looking = createLooking(page);
  const road = createRoad(byId("road"));
  const card = createCard(byId("bubble"), page);
  return [
    road,
    createVerdict(byId("road"), page),
    createTimeline(byId("timeline"), page, looking),
    createPast(byId("road"), page, looking),
    createShare(byId("session-menu"), page, looking),
    createExport(byId("road"), page, looking),
    createNotice(byId("notice"), page),
    createSchematic(byId("schematic"), road.places),
    createStatus(byId("status")),
    createDriver(byId("status"), page),
    createCaption(byId("caption")),
    createControls(byId("controls"), page),
    createLog(byId("log")),
    createTalk(byId("talk"), page),
    createCommand(byId("command"), page),
    createConnectionBadge(byId("connection"), page),
    createAnnouncer(byId("announcer")),
    createComparison(byId("beside"), page),
    card,
    ...createHands(byId("road"), road.places, byId("log"), page, card),
    createViews(byId("views-menu"), page),
    createPixels(byId("road"), page),
    createLanes(byId("road")),
    createForesight(page),
    createPlan(byId("plan"), page),
    createOccupancy(byId("occupancy")),
    createMetrics(byId("metrics"), page),
    createReader(),
    createRoads(),
    createPalette(/** @type {HTMLDialogElement} */ (byId("palette")), page),
    createHelp(byId("help"), page),
  ];
}
