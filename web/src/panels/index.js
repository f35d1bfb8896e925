// @ts-check
/** The panels of the page, each in a file of its own; a new panel is a file and a line here. */

import { byId } from "../ui/dom.js";
import { createAppearance } from "./appearance.js";
import { createAnnouncer } from "../talk/announcer.js";
import { createCaption } from "../road/caption.js";
import { createCard } from "../why/bubbleLoader.js";
import { createCommand } from "../talk/commandBox.js";
import { createCounterfactual } from "../why/counterfactualLoader.js";
import { createConnectionBadge } from "./connection.js";
import { createControls } from "./controls.js";
import { createHelpLoader, createPaletteLoader } from "../talk/dialogLoader.js";
import { createDriving } from "../road/driving.js";
import { createExport } from "../timeline/export.js";
import { createForesight } from "../why/forecastPoller.js";
import { createLanes } from "../road/laneList.js";
import { createLog } from "./log.js";
import { createNotice } from "../ui/notice.js";
import { createOccupancy } from "./occupancy.js";
import { createPast } from "../timeline/pastBar.js";
import { createServerVideo } from "../road/serverVideoLoader.js";
import { createPerspective } from "../road/perspectiveLoader.js";
import { createPlan } from "./plan.js";
import { createRoad } from "../road/road.js";
import { createSchematic } from "./schematic.js";
import { createSettings } from "./settingsLoader.js";
import { createSessionMenu } from "../timeline/sessionMenu.js";
import { createQuizLoader } from "../talk/quizLoader.js";
import { createRules } from "./rules.js";
import { createReader } from "../talk/speech.js";
import { createStatus } from "./status.js";
import { createTabs } from "./tabs.js";
import { createTalk } from "../talk/conversation.js";
import { createTourLoader } from "./tourLoader.js";
import { createStripLoader } from "../timeline/stripLoader.js";
import { createTimeline } from "../timeline/timeline.js";
import { createVerdict } from "./verdict.js";
import { createViews } from "./views.js";

/** @import { Command } from "../core/commands.js" */
/** @import { Page } from "../core/page.js" */
/** @import { State } from "../core/state.js" */

/**
 * @typedef {object} Panel  any of these; all are called at most once a frame
 * @property {(state: State, before: State) => void} [update]  the state has changed
 * @property {(now: number) => boolean} [draw]  draw what moves; whether there is more to come
 * @property {() => void} [repaint]  size or colours have changed
 * @property {Command[]} [commands]  what can be done with it by a key or from the palette
 */

/** @param {Page} page @returns {{panels: Panel[], later: () => Promise<Panel[]>}}  `later`: those that the first frame does without */
export function createPanels(page) {
  byId("new-session").addEventListener("click", () => page.startSession());
  const road = createRoad(byId("road"));
  const card = createCard(byId("bubble"), page);
  const panels = [
    road,
    createVerdict(byId("road"), page, road.places),
    createTimeline(byId("timeline"), page),
    createStripLoader(byId("strip"), page),
    createPast(byId("past"), page),
    createSessionMenu(byId("session-menu"), page),
    createExport(byId("files"), page),
    createNotice(byId("notice"), page),
    createSchematic(byId("schematic"), road.places),
    createStatus(byId("status"), page),
    createCaption(byId("caption")),
    createControls(byId("controls"), page),
    createLog(byId("log")),
    createRules(byId("rules"), page),
    createTalk(byId("talk"), page),
    createCommand(byId("command"), page),
    createConnectionBadge(byId("connection"), page),
    createAnnouncer(byId("announcer")),
    createCounterfactual(byId("beside"), page),
    card,
    createDriving(byId("road"), byId("driving"), page),
    createViews(byId("views-menu"), page),
    createTabs(byId("tabs"), page),
    createAppearance(),
    createSettings(page),
    createTourLoader(page),
    createServerVideo(byId("road"), page),
    createPerspective(road, page),
    createLanes(byId("road")),
    createForesight(page),
    createPlan(byId("plan"), byId("plan-when"), page),
    createOccupancy(byId("occupancy")),
    createReader(),
    createQuizLoader(page),
    createPaletteLoader(/** @type {HTMLDialogElement} */ (byId("palette")), page),
    createHelpLoader(byId("help"), /** @type {HTMLDialogElement} */ (byId("help-dialog")), page),
  ];
  return {
    panels,
    async later() {
      const { createLaterPanels } = await import("./later.js");
      return createLaterPanels(page, road.places, card);
    },
  };
}
