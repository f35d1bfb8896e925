// @ts-check
/**
 * Everything the page knows, in one object, and the pure functions that compute the next state.
 *
 * `reduce(state, event)` answers the next state and changes nothing; an event is a message of the
 * service or something the person did here. Panels only read. What moves between ticks is not here:
 * it is presentation, and belongs to the road's own stage (`motion.js`).
 */

import { logChange, logEvents, logJump, logTick } from "../talk/journal.js";
import { helloNote } from "./helloNote.js";
import { NO_STEPS, stepsAfter } from "./undoStack.js";
import { answerExchange, answerHere, beginExchange, endUnanswered, refuseExchange, withQuestion } from "../talk/exchanges.js";
import { withPastLines } from "../talk/pastLines.js";
import { shownBy } from "../talk/shown.js";
import { NO_TIMELINE, timelineAfter } from "../timeline/timelineState.js";
import { INITIAL_VIEWS, viewsAfter } from "../ui/views.js";
import { NOT_CONNECTED } from "../talk/notConnected.js";
import { queueAfter } from "../road/moveQueue.js";
import { worldAfter, worldOf } from "../road/world.js";
import { decisionAfter, withDecision } from "../why/knownDecision.js";
import { NO_REGRET, regretAfter } from "../why/regret.js";

/** @import { Foresight } from "../why/forecast.js" */
/** @import { Line } from "../talk/journal.js" */
/** @import { ServerMessage, Decision, Cell, HelloMessage, TickMessage } from "./protocol.js" */
/** @import { Phase } from "./socket.js" */
/** @import { Steps } from "./undoStack.js" */
/** @import { Exchange } from "../talk/exchanges.js" */
/** @import { Told } from "../talk/pastLines.js" */
/** @import { RoadChange } from "./wire.js" */
/** @import { LoaderEvent, Timeline } from "../timeline/timelineState.js" */
/** @import { Regret, RegretEvent } from "../why/regret.js" */
/** @import { Hypothesis } from "../why/alternatives.js" */
/** @import { Views } from "../ui/views.js" */
/** @import { World } from "../road/world.js" */

/**
 * @typedef {object} State
 * @property {Phase} connection  how the stream stands; while it is not "live" the rest is stale
 * @property {string | null} session  the session's id
 * @property {string | null} parent  the session it was forked from
 * @property {string | null} trouble  a sentence when no session could be opened
 * @property {World | null} world  the road at the latest tick heard of
 * @property {Decision | null} decision  the latest, as far as the stream tells it
 * @property {string | null} narration  the latest decision in words
 * @property {Line[]} log  newest last, at most `LOG_LINES`
 * @property {Exchange[]} talk  what was said here and answered, newest last
 * @property {Highlight | null} highlight  what the reader points at
 * @property {string | null} announcement  the latest sentence worth reading aloud
 * @property {string | null} fault  what the service last said against a message that was neither said nor done
 * @property {Timeline} timeline  the whole run, as far as it is known
 * @property {Notice | null} notice  the latest thing worth a passing line over the page
 * @property {World | null} prior  the road at the tick before, as long as nothing but that tick has changed it
 * @property {Foresight | null} foresight  what was last told to be about to happen
 * @property {Views} views  what is shown
 * @property {string | null} large  the part of the page that is enlarged
 * @property {Steps} steps  which changes can be taken back
 * @property {string[]} queue  moves that wait to be made, of a person who drives
 * @property {RoadChange[] | null} roadChanges  what was said and stands, as it was last told
 * @property {Regret} regret  how good and how tight decisions were
 * @property {Look} look  which tick is looked at
 * @property {Past | null} past  that tick, as soon as it has come; null: the present is looked at
 * @property {Draft | null} draft  the latest sentence that was offered to stand in the box
 * @property {{other: Hypothesis} | null} comparison  the latest request to see what would have been; a new object each time
 */

/** @typedef {{world: World, decision: Decision | null, narration: string | null, led: string | null}} Past  a tick, what was decided there, and what had led there */

/** @typedef {{tick: number | null, playing: boolean}} Look  null: the present; playing: it goes on by itself */

/** @typedef {{text: string}} Draft  another object each time, though the text be the same */

/** @typedef {{ids: string[], cells: Cell[]}} Highlight */

/**
 * @typedef {object} Notice
 * @property {string} text
 * @property {"bad"} [tone]
 * @property {boolean} [aloud]  only read aloud, since it shows by itself
 * @property {{label: string, run: () => void}} [offer]
 */

/**
 * @typedef {{type: "session", id: string}
 *   | {type: "phase", phase: Phase}
 *   | {type: "trouble", text: string}
 *   | {type: "said", id: string, text: string, quiet: boolean, asks?: boolean}
 *   | {type: "unsent", id: string}
 *   | {type: "highlight", highlight: Highlight | null}
 *   | {type: "notice", notice: Notice | null}
 *   | {type: "foresight", foresight: Foresight}
 *   | {type: "views", views?: Views, large?: string | null}
 *   | {type: "look", tick: number | null, playing: boolean}
 *   | {type: "past", past: Past}
 *   | {type: "draft", text: string}
 *   | {type: "comparison", other: Hypothesis}
 *   | {type: "done-here", id: string, text: string, reply: string}
 *   | {type: "talk", session: string, talk: Exchange[]}
 *   | {type: "decision", session: string, decision: Decision}
 *   | {type: "past-lines", decisions: Told[], changes: RoadChange[]}
 *   | LoaderEvent | RegretEvent} PageEvent  what happened on this side of the wire
 */

/** @typedef {ServerMessage | PageEvent} Event */

/** @type {State} before anything has been heard */
export const INITIAL = {
  connection: { phase: "opening" },
  session: null,
  parent: null,
  trouble: null,
  world: null,
  decision: null,
  narration: null,
  log: [],
  talk: [],
  highlight: null,
  announcement: null,
  fault: null,
  timeline: NO_TIMELINE,
  notice: null,
  prior: null,
  foresight: null,
  views: INITIAL_VIEWS,
  large: null,
  steps: NO_STEPS,
  queue: [],
  roadChanges: null,
  regret: NO_REGRET,
  look: { tick: null, playing: false },
  past: null,
  draft: null,
  comparison: null,
};

/** Event types that are worth saying aloud, not only writing down. */
const SPOKEN = new Set(["crashed", "arrived", "stuck", "no_way"]);

/** @param {State} state @param {Event} event @returns {State} */
export function reduce(state, event) {
  const next = after(state, event);
  if (event.type === "session") return next;
  const timeline = timelineAfter(state.timeline, /** @type {ServerMessage | LoaderEvent} */ (event), state.world);
  const regret = regretAfter(state.regret, /** @type {ServerMessage | RegretEvent} */ (event), next, state);
  return timeline === state.timeline && regret === state.regret ? next : { ...next, timeline, regret };
}

/** @param {State} state @param {Event} event @returns {State} */
function after(state, event) {
  return afterMessage(afterDoing(state, event), event);
}

/** What happened on this side of the wire. @param {State} state @param {Event} event @returns {State} */
function afterDoing(state, event) {
  switch (event.type) {
    case "session":
      return { ...INITIAL, session: event.id, notice: state.notice, views: state.views, large: state.large };
    case "phase":
      return afterPhase(state, event.phase);
    case "trouble":
      return { ...state, trouble: event.text };
    case "said":
      return { ...state, talk: beginExchange(state.talk, event), highlight: null };
    case "unsent":
      return { ...state, talk: refuseExchange(state.talk, event.id, NOT_CONNECTED) };
    case "done-here":
      return { ...state, talk: answerHere(state.talk, event), announcement: event.reply };
    case "highlight":
      return { ...state, highlight: event.highlight };
    case "notice":
      return { ...state, notice: event.notice, announcement: event.notice?.text ?? state.announcement };
    case "foresight":
      return { ...state, foresight: event.foresight };
    case "views":
      return arranged(state, event.views, event.large);
    case "look":
      return afterLook(state, event);
    case "past":
      return { ...state, past: event.past, highlight: null };
    case "draft":
      return { ...state, draft: { text: event.text } };
    case "comparison":
      return { ...state, comparison: { other: event.other } };
    case "talk":
      return event.session === state.session ? { ...state, talk: event.talk } : state;
    case "timeline-changes":
      return { ...state, roadChanges: event.items };
    case "decision":
      return withDecision(state, event.session, event.decision);
    case "past-lines":
      return { ...state, log: withPastLines(state.log, event.decisions, event.changes, state.talk) };
    default:
      return state;
  }
}

/** What the service has sent. @param {State} state @param {Event} event @returns {State} */
function afterMessage(state, event) {
  switch (event.type) {
    case "hello":
      return afterHello(state, event);
    case "tick":
      return afterTick(state, event);
    case "changed":
      if (event.views && !event.changes?.length) return arranged(state, event.views);
      return {
        ...(event.views ? arranged(state, event.views) : state),
        ...decisionAfter(state, event.state),
        steps: stepsAfter(state.steps, event.state.undo, event.sequence),
        world: worldOf(event.state),
        queue: queueAfter(state.queue, event.changes ?? []),
        prior: null,
        log: logChange(logJump(state, event.state), event),
        highlight: null,
        ...(event.text === null && SPOKEN.has(String(event.events?.at(-1)?.type)) ? { announcement: event.reply } : {}),
      };
    case "state":
      return { ...state, world: worldOf(event.state), prior: null, steps: stepsAfter(state.steps, event.state.undo, null) };
    case "result":
      return {
        ...state,
        talk: answerExchange(state.talk, event.id, event.result),
        highlight: shownBy(event.result.answer) ?? state.highlight,
        announcement: event.result.reply,
      };
    case "problem":
      return {
        ...state,
        talk: refuseExchange(state.talk, event.id, event.problem),
        announcement: event.problem.detail,
      };
    case "error":
      return { ...state, announcement: event.problem.detail, fault: event.problem.detail };
    default:
      return state;
  }
}

/** @param {State} state @param {Look} look @returns {State} */
function afterLook(state, { tick, playing }) {
  const look = { tick, playing };
  return tick === null && state.past !== null ? { ...state, look, past: null, highlight: null } : { ...state, look };
}

/** @param {State} state @param {Phase} phase @returns {State} */
function afterPhase(state, phase) {
  if (phase.phase !== "lost") return { ...state, connection: phase };
  return { ...state, connection: phase, talk: endUnanswered(state.talk) };
}

/**
 * With some views shown or hidden. What is enlarged goes back when something else is to be seen.
 * @param {State} state
 * @param {Views} [change]
 * @param {string | null} [large]
 * @returns {State}
 */
function arranged(state, change, large = state.large) {
  const views = viewsAfter(state.views, change);
  const covered = large !== null && (!(views[large] ?? true) || Object.keys(change ?? {}).some((name) => views[name] && name !== large));
  return { ...state, views, large: covered ? null : large };
}

/** @param {State} state @param {HelloMessage} hello @returns {State} */
function afterHello(state, hello) {
  const note = helloNote(state, hello);
  return {
    ...state,
    ...(note === null ? {} : { notice: { text: note }, announcement: note }),
    session: hello.session.id,
    parent: hello.session.parent?.id ?? null,
    talk: withQuestion(state.talk, hello.session.pending),
    trouble: null,
    world: worldOf(hello.state),
    prior: null,
    decision: hello.decision ?? null,
    narration: hello.decision?.narration ?? null,
    log: logEvents(state.log, hello.log ?? []),
    steps: stepsAfter(state.steps, hello.state.undo, null),
    past: null,
  };
}

/**
 * The state as it is to be shown: the present, or with the road of the tick that is looked at. The clock is the
 * present one's: it runs on meanwhile.
 * @param {State} state
 * @returns {State}
 */
export function sceneOf(state) {
  const { past, world } = state;
  if (past === null || world === null) return state;
  const { paused, mode } = world;
  let seen = SEEN.get(past.world);
  if (seen?.paused !== paused || seen.mode !== mode) {
    seen = { ...past.world, paused, mode };
    SEEN.set(past.world, seen);
  }
  return { ...state, ...past, world: seen };
}

/**
 * Past worlds as they are shown: the same one as long as nothing of it changes, or it would be drawn anew each time.
 * @type {WeakMap<World, World>}
 */
const SEEN = new WeakMap();

/** @param {State} state @param {TickMessage} message @returns {State} */
function afterTick(state, message) {
  if (state.world === null) return state;
  const spoken = (message.events ?? []).findLast((event) => SPOKEN.has(event.type));
  return {
    ...state,
    world: worldAfter(state.world, message),
    prior: state.world,
    queue: state.queue.slice(1),
    decision: message.decision ?? null,
    narration: message.narration ?? null,
    log: logTick(state.log, message),
    announcement: spoken ? spoken.text : state.announcement,
  };
}
