// @ts-check
/**
 * The road by keyboard: while it has the focus, the arrows move a cursor from cell to cell, and what is there is said.
 *
 * Enter opens the bubble, letters put things there, Delete takes them away, M takes hold of a thing and lets it go
 * again. Where a person drives, the arrows drive instead (`driving.js`).
 */

import { make, setText } from "../ui/dom.js";
import { hindrance, isLoose, moving, placing, removing, TOOLS } from "./edit.js";
import { capital, cellWords, nameOf, onRoad, placeWords, thingIn } from "./hitTest.js";
import { sceneOf } from "../core/state.js";
import { egoOf } from "./world.js";
import { lay } from "../why/bubbleLoader.js";
import { portrait } from "./tray.js";

/** @import { Places } from "./hitTest.js" */
/** @import { Page } from "../main.js" */
/** @import { Cell } from "../core/protocol.js" */
/** @import { Thing, World } from "./world.js" */
/** @import { Card } from "../why/bubbleLoader.js" */
/** @import { Panel } from "../panels/index.js" */
/** @import { Hands } from "./dragDrop.js" */

const STEPS = /** @type {Record<string, Cell>} */ ({
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  PageUp: [0, -4],
  PageDown: [0, 4],
});
const REST_MS = 300;
const HINT = [
  ["↑ ↓ ← →", "cell"],
  ["Enter", "what is it"],
  ...TOOLS.map(({ key, name }) => [key.toUpperCase(), name.toLowerCase()]),
  ["M", "move"],
  ["Del", "remove"],
];

/**
 * @param {HTMLElement} host  what lies over the road's picture and takes the focus
 * @param {Places} places
 * @param {Page} page
 * @param {Card} card
 * @param {Hands} hands
 * @returns {Panel}
 */
export function createCursor(host, places, page, card, hands) {
  const mark = make("div", { class: "cell-cursor", hidden: true });
  const spoken = make("p", { class: "unseen", "aria-live": "polite" });
  const hint = make(
    "p",
    { class: "cursor-hint", id: "cursor-hint" },
    ...HINT.map(([key, what]) => make("span", {}, make("kbd", {}, key), ` ${what}`)),
  );
  host.after(mark, spoken, hint);
  host.tabIndex = 0;
  host.setAttribute("role", "application");
  host.setAttribute("aria-label", "The road, cell by cell");
  host.setAttribute("aria-describedby", "cursor-hint");

  /** @type {Cell | null} */ let cell = null;
  /** @type {Thing | null} */ let grabbed = null;
  let rest = 0;
  /** Whether the keys were used last: the pointer has a mark of its own. */
  let byKeys = false;

  /** @param {Cell} next @param {boolean} [aloud] */
  function go(next, aloud = true) {
    const { world } = sceneOf(page.state());
    if (world === null) return;
    cell = [clamp(next[0], world.columns - 1), clamp(next[1], world.rows - 1)];
    place();
    if (!aloud) return;
    setText(spoken, capital(cellWords(world, cell)));
    card.hide();
    clearTimeout(rest);
    if (grabbed === null) rest = setTimeout(tellMore, REST_MS);
  }

  /** @param {boolean} [pin] */
  function tellMore(pin = false) {
    const { world } = sceneOf(page.state());
    if (world === null || cell === null || (!pin && document.activeElement !== host)) return;
    card.show({ kind: "cell", cell, id: thingIn(world, cell)?.id ?? null, places, frame: host }, pin, pin);
  }

  function place() {
    const at = cell && places.placeOf(cell);
    const shown = !!at && byKeys && document.activeElement === host && sceneOf(page.state()).world?.mode !== "manual";
    mark.hidden = !shown;
    if (shown && at) lay(mark, at);
  }

  /** Where the cursor begins: before the vehicle. @param {World} world @returns {Cell} */
  function ahead(world) {
    const ego = egoOf(world);
    return ego ? [ego.cell[0], Math.max(0, ego.cell[1] - 2)] : [0, world.rows - 1];
  }

  /** What left the view below is carried along with it. @param {World} world */
  function carry(world) {
    const frame = host.getBoundingClientRect();
    const lowest = places.cellAt(frame.left, frame.bottom - 8);
    const highest = places.cellAt(frame.left, frame.top + 8);
    if (cell === null || !lowest || !highest || cell[1] >= world.rows) return;
    const row = Math.max(highest[1], Math.min(lowest[1], cell[1]));
    if (row !== cell[1]) go([cell[0], row], false);
  }

  function reach() {
    host.focus({ preventScroll: true });
    const { world } = sceneOf(page.state());
    if (world === null || world.mode === "manual") return;
    byKeys = true;
    go(cell !== null && onRoad(world, cell) ? cell : ahead(world));
  }

  /** Escape while holding: it stays where it is. */
  function letGo() {
    grabbed = null;
    mark.removeAttribute("data-holding");
    mark.replaceChildren();
  }

  /** @param {World} world @param {Cell} at */
  function takeOrPut(world, at) {
    if (grabbed === null) {
      const thing = thingIn(world, at);
      if (!isLoose(thing)) return say(thing ? "It drives itself and cannot be moved." : "There is nothing to move here.");
      grabbed = thing;
      mark.setAttribute("data-holding", "");
      mark.replaceChildren(portrait(places, thing.kind, thing.id));
      card.hide();
      return say(`Holding ${thing.id}. Arrows move it, M or Enter puts it down, Escape leaves it.`);
    }
    const thing = world.things.get(grabbed.id);
    if (!thing) {
      letGo();
      return say("It is not on the road any more.");
    }
    const why = hindrance(world, thing.kind, at, thing.id);
    if (why !== null) return say(why);
    letGo();
    if (thing.cell[0] !== at[0] || thing.cell[1] !== at[1]) hands.doing(moving(thing, at), `Move ${thing.id} to ${placeWords(world, at)}`);
  }

  /** @param {string} text */
  function say(text) {
    clearTimeout(rest);
    hands.tell(text);
  }

  /** @param {KeyboardEvent} event @param {World} world @returns {boolean} whether the key was for the cursor */
  function pressed({ key, repeat }, world) {
    const at = cell ?? ahead(world);
    const step = STEPS[key];
    const tool = TOOLS.find((each) => each.key === key.toLowerCase());
    if (step) go(cell === null ? at : [at[0] + step[0], at[1] + step[1]]);
    else if (key === "Home") go(ahead(world));
    else if (repeat) return tool !== undefined;
    else if (key === "Escape" && grabbed !== null) {
      const { id } = grabbed;
      letGo();
      say(`${capital(id)} stays where it is.`);
    } else if (key === "m" || key === "M" || (key === "Enter" && grabbed !== null)) takeOrPut(world, at);
    else if (key === "Enter") {
      clearTimeout(rest);
      go(at, false);
      tellMore(true);
    } else if (key === "Delete" || key === "Backspace") {
      const thing = thingIn(world, at);
      if (isLoose(thing)) hands.doing(removing(thing), `Take ${thing.id} off the road`);
      else say(thing ? "It drives itself and cannot be taken away." : "There is nothing to take away here.");
    } else if (tool) {
      const why = hindrance(world, tool.kind, at);
      if (why !== null) say(why);
      else hands.doing(placing(tool.kind, at), `Put ${nameOf(tool)} in ${placeWords(world, at)}`);
    } else return false;
    return true;
  }

  host.addEventListener("keydown", (event) => {
    const { world } = sceneOf(page.state());
    if (event.target !== host || event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
    if (world === null || world.mode === "manual") return;
    byKeys = true;
    if (!pressed(event, world)) return;
    event.preventDefault();
    event.stopPropagation();
  });
  host.addEventListener("focus", () => {
    const { world } = sceneOf(page.state());
    if (world === null || !host.matches(":focus-visible")) return;
    byKeys = true;
    go(cell !== null && onRoad(world, cell) ? cell : ahead(world), world.mode !== "manual");
  });
  host.addEventListener("pointerdown", ({ clientX, clientY }) => {
    byKeys = false;
    letGo();
    const { world } = sceneOf(page.state());
    const at = places.cellAt(clientX, clientY);
    if (world !== null && at !== null && onRoad(world, at)) cell = at;
    place();
  });
  host.addEventListener("blur", () => {
    clearTimeout(rest);
    letGo();
    place();
    card.leave();
  });

  return {
    acts: [
      {
        name: "cursor",
        group: "Road",
        key: "g",
        keyName: "G",
        now: ({ world }) => world && { label: "Go over the road cell by cell", run: reach },
      },
    ],
    update({ world, session }, before) {
      if (session !== before.session) {
        cell = null;
        letGo();
      }
      if (world === null || cell === null || document.activeElement !== host) return;
      carry(world);
    },
    draw() {
      if (cell !== null && byKeys) place();
      return false;
    },
  };
}

/** @param {number} value @param {number} most */
function clamp(value, most) {
  return Math.max(0, Math.min(most, value));
}
