// @ts-check
/** A moment handed on: forked into a session of its own, gone back to, or put into a link. */

import { make } from "../ui/dom.js";
import { askJson, words } from "../core/http.js";
import { icon } from "../ui/icons.js";
import { onDemand, styled } from "../core/lazy.js";
import { forkAt, forks, hashOf, noteFork, shareLink } from "./links.js";
import { createMenu } from "../ui/menu.js";
import { sessionPath } from "../core/protocol.js";
import { browserStorage } from "../core/storage.js";

/** @import { Act } from "../core/commands.js" */
/** @import { Page } from "../main.js" */
/** @import { Looking } from "./past.js" */
/** @import { Panel } from "../panels/index.js" */

/** What stands in the session's menu, in this order; null is a line. */
const MENU = [
  "share", "fork", "open-fork", "rewind", "origin", null, "save-moment", "moments", null,
  "picture", "film", "recording", "open-recording", null, "sessions", "new-session",
];

/**
 * @param {HTMLElement} host
 * @param {Page} page
 * @param {Looking} looking
 * @returns {Panel}
 */
export function createShare(host, page, looking) {
  const origin = make("a", { class: "origin", hidden: true }, icon("fork"), make("span", { class: "origin-text" }));
  host.parentElement?.prepend(origin);
  createMenu(host, "Session", () => {
    const acts = page.acts();
    const items = MENU.map((name) => {
      if (name === null) return null;
      const act = acts.find((each) => each.name === name);
      const doing = act?.now(page.state());
      return act && doing ? { name, label: doing.label, keyName: act.keyName, run: () => doing.run?.(page) } : undefined;
    });
    return items.filter((item) => item !== undefined);
  });

  const names = onDemand(page, async () => {
    const [{ linkDialog, momentsDialog, sessionsDialog }] = await Promise.all([import("./bookmarkDialogs.js"), styled("dialog")]);
    return { link: linkDialog(), moments: momentsDialog(page, looking), sessions: sessionsDialog(page) };
  });
  /** @type {(() => void) | null} */ let refresh = null;

  /** @param {(session: string, tick: number | null) => Promise<void>} work */
  async function doing(work) {
    const { session } = page.state();
    if (!session) return;
    try {
      await work(session, looking.tick);
    } catch (error) {
      page.tell({ text: words(error), tone: "bad" });
    }
  }

  const share = () =>
    doing(async (session, wanted) => {
      const { url, tick, carries } = await shareLink(location, session, wanted);
      const what = carries ? "It carries the whole run." : "It works while this service keeps the session.";
      try {
        await navigator.clipboard.writeText(url);
        page.tell({ text: `Link to tick ${tick} copied. ${what}` });
      } catch {
        names(({ link }) => link.open(url, what)); // not allowed, or no clipboard here
      }
    });

  const fork = () =>
    doing(async (session, wanted) => {
      const made = await forkAt(session, wanted, wanted === null ? undefined : true);
      noteFork(browserStorage(), { child: made.id, parent: session, tick: made.tick });
      const open = () => void (location.hash = hashOf(made.id));
      // Whoever has gone to another session meanwhile is not taken away from there.
      if (page.state().session !== session) return page.tell({ text: `The other session was forked at tick ${made.tick}.`, offer: { label: "Open", run: open } });
      history.replaceState(null, "", hashOf(session, wanted)); // the browser's way back leads to this moment
      open();
      page.tell({ text: `Forked at tick ${made.tick}. It goes its own way from here.` });
    });

  const rewind = () =>
    doing(async (session, wanted) => {
      if (wanted === null) return;
      await askJson(`${sessionPath(session)}/rewind`, { method: "POST", body: { tick: wanted } });
      const here = () => page.state().session === session;
      if (!here()) return;
      looking.live();
      const undo = () => void (here() ? page.act([{ do: "undo" }], "Undo", true) : page.tell({ text: "That was another session, which stays as it is." }));
      page.tell({ text: `Back at tick ${wanted}. What came after it can be had back by one undo.`, offer: { label: "Undo", run: undo } });
    });

  /** @param {string | null} session */
  const parentOf = (session) => forks(browserStorage()).findLast(({ child }) => child === session);

  return {
    acts: [
      ...shareActs({ share, fork, rewind, parentOf }),
      ...nameActs(page, (naming) =>
        names(({ moments }) => {
          refresh = moments.refresh;
          void moments.open(naming);
        }),
        () => names(({ sessions }) => void sessions.open()),
      ),
    ],

    update({ session, talk }, before) {
      if (talk !== before.talk) refresh?.();
      if (session === before.session) return;
      const from = parentOf(session);
      origin.hidden = !from;
      if (!from) return;
      origin.href = hashOf(from.parent, from.tick);
      const text = `Forked at tick ${from.tick}`;
      origin.title = `${text} of another session: go back to it`;
      origin.setAttribute("aria-label", origin.title);
      origin.lastElementChild?.replaceChildren(text);
    },
  };
}

/**
 * @param {object} ways
 * @param {() => Promise<void>} ways.share
 * @param {() => Promise<void>} ways.fork
 * @param {() => Promise<void>} ways.rewind
 * @param {(session: string | null) => import("./links.js").Fork | undefined} ways.parentOf
 * @returns {Act[]}
 */
function shareActs({ share, fork, rewind, parentOf }) {
  const group = "Session";
  return [
    { name: "share", group, key: "l", keyName: "L", now: ({ past }) => ({ label: past ? `Share a link to tick ${past.world.tick}` : "Share a link to this moment", run: () => void share() }) },
    { name: "fork", group, key: "f", keyName: "F", now: ({ past }) => ({ label: past ? `Fork at tick ${past.world.tick}` : "Fork from here", run: () => void fork() }) },
    {
      name: "open-fork", group,
      now({ past, session }) {
        const made = past && forks(browserStorage()).findLast(({ parent, tick }) => parent === session && tick === past.world.tick);
        return made ? { label: "Open the fork made here", run: () => (location.hash = hashOf(made.child)) } : null;
      },
    },
    { name: "rewind", group, now: ({ past }) => past && { label: `Rewind to tick ${past.world.tick}`, run: () => void rewind() } },
    {
      name: "origin", group,
      now({ session }) {
        const from = parentOf(session);
        return from ? { label: `Go back to the session it was forked from`, run: () => (location.hash = hashOf(from.parent, from.tick)) } : null;
      },
    },
  ];
}

/**
 * @param {Page} page
 * @param {(naming: boolean) => void} moments
 * @param {() => void} sessions
 * @returns {Act[]}
 */
function nameActs(page, moments, sessions) {
  const group = "Session";
  return [
    { name: "save-moment", group, now: () => ({ label: "Save this moment as…", run: () => moments(true) }) },
    { name: "moments", group, now: () => ({ label: "Saved moments…", run: () => moments(false) }) },
    { name: "sessions", group, now: () => ({ label: "Sessions…", run: sessions }) },
    { name: "new-session", group, now: () => ({ label: "New session", run: () => page.startSession() }) },
  ];
}
