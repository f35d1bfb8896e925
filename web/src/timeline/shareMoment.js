// @ts-check
/** A moment handed on: put into a link, forked into a session of its own, gone back to. */

import { hashOf } from "../core/address.js";
import { askJson, errorText } from "../core/http.js";
import { sessionPath } from "../core/protocol.js";
import { browserStorage } from "../core/preferences.js";
import { t } from "../core/texts.js";
import { forkAt, noteFork, shareLink } from "./links.js";

/** @import { Page } from "../core/page.js" */

/**
 * What is done to the session and tick that are looked at; what goes wrong is told.
 * @param {Page} page
 * @param {(session: string, tick: number | null) => Promise<void>} work
 */
async function doing(page, work) {
  const { look, session } = page.state();
  if (!session) return;
  try {
    await work(session, look.tick);
  } catch (error) {
    page.tell({ text: errorText(error), tone: "bad" });
  }
}

/** @param {Page} page @param {(url: string, what: string) => void} byHand  where the page may not copy */
export function shareMoment(page, byHand) {
  return doing(page, async (session, wanted) => {
    const { url, tick, carries } = await shareLink(location, session, wanted);
    const what = t(carries ? "session.carries" : "session.works");
    try {
      await navigator.clipboard.writeText(url);
      page.tell({ text: t("session.shared", { tick, what }) });
    } catch {
      byHand(url, what); // not allowed, or no clipboard here
    }
  });
}

/** How large the frame is, where the page that embeds it says nothing else [px]. */
const FRAME = { width: 480, height: 560 };

/** A snippet that shows the run, up to what is looked at, in a frame of another page. @param {Page} page @param {(url: string, what: string) => void} show */
export function embedMoment(page, show) {
  return doing(page, async (session, wanted) => {
    const { url, carries } = await shareLink(location, session, wanted);
    const framed = new URL(`embed${new URL(url).hash}`, location.href.replace(/[?#].*/, ""));
    const size = `width="${FRAME.width}" height="${FRAME.height}"`;
    show(`<iframe src="${framed.href}" ${size} style="border:0" title="Roadtalk"></iframe>`, t(carries ? "session.carries" : "session.works"));
  });
}

/** @param {Page} page */
export function forkHere(page) {
  return doing(page, async (session, wanted) => {
    const { id, tick } = await forkAt(session, wanted, wanted === null ? undefined : true);
    noteFork(browserStorage(), { child: id, parent: session, tick });
    const open = () => void (location.hash = hashOf(id));
    // Whoever has gone to another session meanwhile is not taken away from there.
    if (page.state().session !== session) {
      return page.tell({ text: t("session.forked_elsewhere", { tick }), offer: { label: t("session.open"), run: open } });
    }
    history.replaceState(null, "", hashOf(session, wanted)); // the browser's way back leads to this moment
    open();
    page.tell({ text: t("session.forked", { tick }) });
  });
}

/** @param {Page} page */
export function rewindHere(page) {
  return doing(page, async (session, tick) => {
    if (tick === null) return;
    await askJson(`${sessionPath(session)}/rewind`, { method: "POST", body: { tick } });
    const here = () => page.state().session === session;
    if (!here()) return;
    page.timeTravel.live();
    const undo = () => void (here() ? page.act([{ do: "undo" }], t("clock.undo"), true) : page.tell({ text: t("session.other") }));
    page.tell({ text: t("session.rewound", { tick }), offer: { label: t("clock.undo"), run: undo } });
  });
}

/**
 * Gives a session another name; an empty one takes it away. Throws `Refused`.
 * @param {string} session
 * @param {string} wanted
 * @returns {Promise<string | null>}
 */
export async function renameSession(session, wanted) {
  const { name } = await askJson(sessionPath(session), { method: "PATCH", body: { name: wanted === "" ? null : wanted } });
  return name;
}

/** The session that is seen gets a name, and that is told. @param {Page} page @param {string} wanted */
export function renameHere(page, wanted) {
  return doing(page, async (session) => {
    page.tell({ text: t("sessions.renamed", { name: (await renameSession(session, wanted)) ?? t("sessions.session", { id: session.slice(0, 6) }) }) });
  });
}
