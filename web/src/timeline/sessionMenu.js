// @ts-check
/** The session's menu: fork, rewind to or share a moment; saved moments and sessions. */

import { html, nothing } from "../../vendor/lit-html.js";
import { hashOf } from "../core/address.js";
import { onDemand, styled } from "../core/lazy.js";
import { browserStorage } from "../core/preferences.js";
import { t } from "../core/texts.js";
import { icon } from "../ui/icons.js";
import { createMenu } from "../ui/menu.js";
import { createSlot } from "../ui/slot.js";
import { forks } from "./links.js";

/** @import { Command } from "../core/commands.js" */
/** @import { Page } from "../core/page.js" */
/** @import { Panel } from "../panels/index.js" */

/** What stands in the session's menu, in this order; null is a line. */
const MENU = [
  "share", "embed", "fork", "open-fork", "rewind", "origin", null, "save-moment", "moments", null,
  "picture", "video", "recording", "open-recording", null, "quiz", "settings", null, "gallery", "sessions", "rename", "new-session",
];

/** @typedef {{link: (url: string, what: string) => void, embed: (snippet: string, what: string) => void, moments: (naming: boolean) => void, sessions: (naming?: string | null) => void}} Dialogs */

/** @param {HTMLElement} host @param {Page} page @returns {Panel} */
export function createSessionMenu(host, page) {
  const origin = createSlot(/** @type {HTMLElement} */ (host.parentElement), host.parentElement?.firstChild ?? null);
  createMenu(host, t("session.label"), () => menuItems(page));
  const dialogs = onDemand(page, async () => {
    const [{ createDialogs }] = await Promise.all([import("./dialogs.js"), styled("dialog")]);
    return createDialogs(page);
  });
  const moments = onDemand(page, () => import("./shareMoment.js"));

  return {
    commands: [...momentCommands(page, moments, dialogs), ...forkCommands(), ...keptCommands(page, dialogs), renameCommand(moments, dialogs)],

    update({ session }, before) {
      if (session !== before.session) origin(originLink(session));
    },
  };
}

/** @param {Page} page */
function menuItems(page) {
  const commands = page.commands();
  return MENU.flatMap((name) => {
    if (name === null) return [null];
    const act = commands.find((each) => each.name === name);
    const doing = act?.now(page.state());
    return act && doing ? [{ name, label: doing.label, keyName: act.keyName, run: () => doing.run?.(page) }] : [];
  });
}

/** @param {string | null} session */
function parentOf(session) {
  return forks(browserStorage()).findLast(({ child }) => child === session);
}

/** Where a forked session is from. @param {string | null} session */
function originLink(session) {
  const from = parentOf(session);
  if (!from) return nothing;
  const text = t("session.origin_tick", { tick: from.tick });
  const title = t("session.origin_title", { text });
  return html`<a class="origin" href=${hashOf(from.parent, from.tick)} title=${title} aria-label=${title}>
    ${icon("fork")}<span class="origin-text">${text}</span>
  </a>`;
}

/**
 * @param {Page} page
 * @param {(use: (module: typeof import("./shareMoment.js")) => void) => void} moments
 * @param {(use: (dialogs: Dialogs) => void) => void} dialogs
 * @returns {Command[]}
 */
function momentCommands(page, moments, dialogs) {
  const group = t("groups.session");
  const byHand = (/** @type {string} */ url, /** @type {string} */ what) => dialogs(({ link }) => link(url, what));
  return [
    { name: "share", group, key: "l", keyName: "L", now: ({ past }) => ({ label: past ? t("session.share_tick", past.world) : t("session.share"), run: () => moments((made) => void made.shareMoment(page, byHand)) }) },
    { name: "embed", group, now: () => ({ label: t("embed.menu"), run: () => moments((made) => void made.embedMoment(page, (snippet, what) => dialogs(({ embed }) => embed(snippet, what)))) }) },
    { name: "fork", group, key: "f", keyName: "F", now: ({ past }) => ({ label: past ? t("session.fork_tick", past.world) : t("session.fork"), run: () => moments((made) => void made.forkHere(page)) }) },
    { name: "rewind", group, now: ({ past }) => past && { label: t("session.rewind", past.world), run: () => moments((made) => void made.rewindHere(page)) } },
  ];
}

/** @returns {Command[]} */
function forkCommands() {
  const group = t("groups.session");
  return [
    {
      name: "open-fork", group,
      now({ past, session }) {
        const made = past && forks(browserStorage()).findLast(({ parent, tick }) => parent === session && tick === past.world.tick);
        return made ? { label: t("session.open_fork"), run: () => (location.hash = hashOf(made.child)) } : null;
      },
    },
    {
      name: "origin", group,
      now({ session }) {
        const from = parentOf(session);
        return from ? { label: t("session.origin"), run: () => (location.hash = hashOf(from.parent, from.tick)) } : null;
      },
    },
  ];
}

/**
 * @param {(use: (module: typeof import("./shareMoment.js")) => void) => void} moments
 * @param {(use: (dialogs: Dialogs) => void) => void} dialogs
 * @returns {Command}
 */
function renameCommand(moments, dialogs) {
  return {
    name: "rename",
    group: t("groups.session"),
    now: ({ session }) => session === null ? null : { label: t("sessions.rename_here"), run: () => dialogs(({ sessions }) => sessions(session)) },
    named: (name) => ({ label: t("sessions.rename_to", { name }), run: (page) => moments((made) => void made.renameHere(page, name)) }),
  };
}

/** @type {ReturnType<typeof onDemand<() => void>> | null} */ let gallery = null;

/** @param {Page} page */
export function openGallery(page) {
  gallery ??= onDemand(page, async () => {
    const [{ createGallery }] = await Promise.all([import("./galleryDialog.js"), styled("dialog"), styled("gallery")]);
    return createGallery();
  });
  void gallery((open) => open());
}

/** @param {Page} page @param {(use: (dialogs: Dialogs) => void) => void} dialogs @returns {Command[]} */
function keptCommands(page, dialogs) {
  const group = t("groups.session");
  return [
    { name: "save-moment", group, now: () => ({ label: t("session.save_moment"), run: () => dialogs(({ moments }) => moments(true)) }) },
    { name: "moments", group, now: () => ({ label: t("session.moments"), run: () => dialogs(({ moments }) => moments(false)) }) },
    { name: "sessions", group, now: () => ({ label: t("session.sessions"), run: () => dialogs(({ sessions }) => sessions()) }) },
    { name: "gallery", group, now: () => ({ label: t("gallery.open"), run: () => void openGallery(page) }) },
    { name: "new-session", group, now: () => ({ label: t("session.new"), run: () => page.startSession() }) },
  ];
}
