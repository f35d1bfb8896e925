// @ts-check
/** The dialog of the sessions that the service keeps: gone to, deleted. */

import { html, nothing, repeat } from "../../vendor/lit-html.js";
import { hashOf } from "../core/address.js";
import { ask, askJson, errorText } from "../core/http.js";
import { newestOnly } from "../core/latest.js";
import { SESSIONS_PATH, sessionPath } from "../core/protocol.js";
import { dateText, t } from "../core/texts.js";
import { themeSeen } from "../core/theme.js";
import { dialogSlot, makeDialog } from "../ui/dialog.js";
import { renameSession } from "./shareMoment.js";

/** @import { Page } from "../core/page.js" */
/** @import { SessionPage, SessionSummary } from "../core/wire.js" */

const PAGE_SESSIONS = 20;

/**
 * @typedef {object} Shown
 * @property {SessionSummary[]} sessions
 * @property {string | null} after  where the next page begins
 * @property {boolean} more
 * @property {{text: string, bad: boolean}} note
 * @property {{id: string, busy: boolean} | null} deleting  the session that is about to be deleted, if that is confirmed
 * @property {string | null} naming  the session that is given another name
 */

/** @type {Shown} */
const NOTHING = { sessions: [], after: null, more: false, note: { text: "", bad: false }, deleting: null, naming: null };

/** @param {Page} page @returns {(naming?: string | null) => Promise<void>} opens it, with the name of a session to be changed */
export function createSessionsDialog(page) {
  const dialog = makeDialog(t("sessions.title"));
  const body = dialogSlot(dialog);
  let shown = NOTHING;
  const asking = newestOnly();
  const does = {
    close: () => dialog.close(),
    more: () => void next(),
    fresh() {
      dialog.close();
      page.startSession();
    },
    confirm(/** @type {string | null} */ id) {
      show({ deleting: id === null ? null : { id, busy: false } });
      focus(id === null ? "[data-do=fresh]" : "[data-do=keep]");
    },
    remove: (/** @type {SessionSummary} */ session) => void remove(session),
    naming(/** @type {string | null} */ id) {
      show({ naming: id });
      focus(id === null ? "[data-do=fresh]" : "[data-do=name] input");
    },
    rename: (/** @type {SessionSummary} */ session, /** @type {string} */ name) => void renamed(session, name, shown.sessions).then(show).then(() => shown.naming === null && focus("[data-do=fresh]")),
  };

  /** @param {Partial<Shown>} change */
  function show(change) {
    shown = { ...shown, ...change };
    body(content(shown, page.state().session, does));
  }

  /** @param {string} selector */
  const focus = (selector) => /** @type {HTMLElement | null} */ (dialog.querySelector(selector))?.focus();

  async function next() {
    const newest = asking();
    try {
      const from = shown.after === null ? "" : `&after=${shown.after}`;
      /** @type {SessionPage} */
      const { items, after, more } = await askJson(`${SESSIONS_PATH}?limit=${PAGE_SESSIONS}${from}`);
      if (newest()) show({ sessions: [...shown.sessions, ...items], after, more }); // else opened anew, or asked for twice
    } catch (error) {
      if (newest()) show({ note: { text: errorText(error), bad: true } });
    }
  }

  /** @param {SessionSummary} session */
  async function remove(session) {
    const name = nameOf(session);
    show({ deleting: { id: session.id, busy: true } }); // once is enough
    try {
      await ask(sessionPath(session.id), { method: "DELETE" });
      const sessions = shown.sessions.filter(({ id }) => id !== session.id);
      show({ sessions, deleting: null, note: { text: t("sessions.deleted", { name }), bad: false } });
      focus("[data-do=fresh]");
    } catch (error) {
      const text = t("sessions.not_deleted", { name, reason: errorText(error) });
      show({ deleting: { id: session.id, busy: false }, note: { text, bad: true } });
    }
  }

  return async (naming = null) => {
    show(NOTHING);
    dialog.showModal();
    await next();
    if (naming !== null) does.naming(naming);
  };
}

/** What is shown once a session has another name, or has been refused it. @param {SessionSummary} session @param {string} wanted @param {SessionSummary[]} all @returns {Promise<Partial<Shown>>} */
async function renamed(session, wanted, all) {
  try {
    const name = await renameSession(session.id, wanted);
    const sessions = all.map((each) => (each.id === session.id ? { ...each, name } : each));
    return { sessions, naming: null, note: { text: t("sessions.renamed", { name: nameOf({ ...session, name }) }), bad: false } };
  } catch (error) {
    return { note: { text: errorText(error), bad: true } };
  }
}

/** @param {SessionSummary} session */
function nameOf({ id, name }) {
  return name ?? t("sessions.session", { id: id.slice(0, 6) });
}

/**
 * @typedef {object} Does
 * @property {() => void} close
 * @property {() => void} more
 * @property {() => void} fresh
 * @property {(id: string | null) => void} confirm
 * @property {(session: SessionSummary) => void} remove
 * @property {(id: string | null) => void} naming
 * @property {(session: SessionSummary, name: string) => void} rename
 */

/** @param {Shown} shown @param {string | null} here @param {Does} does */
function content({ sessions, more, note, deleting, naming }, here, does) {
  return html`<p class="dialog-note" role="status" data-tone=${note.bad ? "bad" : "plain"}>${note.text}</p>
    <ul class="rows">
      ${repeat(sessions, ({ id }) => id, (session) => row(session, session.id === here, deleting?.id === session.id ? deleting : null, naming === session.id, does))}
    </ul>
    <div class="form-end">
      ${more ? html`<button class="button small" type="button" @click=${does.more}>${t("sessions.more")}</button>` : nothing}
      <button class="button" type="button" data-do="fresh" @click=${does.fresh}>${t("session.new")}</button>
    </div>`;
}

/** @param {SessionSummary} session @param {boolean} here @param {{busy: boolean} | null} deleting @param {boolean} naming @param {Does} does */
function row(session, here, deleting, naming, does) {
  const { id, tick, seed, created_at: created } = session;
  const name = nameOf(session);
  const when = dateText(new Date(created));
  // A picture wakes no session that sleeps.
  const picture = session.live ? html`<img class="row-thumb" src="${sessionPath(id)}/frame?format=webp&theme=${themeSeen()}&boxes=false&figures=false" alt="" loading="lazy" width="48" height="48">` : html`<span class="row-thumb"></span>`;
  if (naming) return html`<li class="row" data-session=${id}>${picture}${namingForm(session, does)}</li>`;
  return html`<li class="row" data-session=${id}>
    ${picture}
    <a class="row-name" href=${hashOf(id)} aria-current=${here ? "true" : nothing} @click=${does.close}>${name}${here ? html`<span class="row-here">${t("sessions.here")}</span>` : nothing}</a>
    <span class="row-note">${t("sessions.about", { tick, seed, when })}</span>
    <span class="row-do">${
      deleting
        ? html`<button class="button small" type="button" data-do="keep" @click=${() => does.confirm(null)}>${t("sessions.keep")}</button>
            <button class="button small danger" type="button" aria-label=${t("sessions.delete_sure_named", { name })} ?disabled=${deleting.busy} @click=${() => does.remove(session)}>${t("sessions.delete_sure")}</button>`
        : html`<button class="button small" type="button" data-do="rename" aria-label=${t("sessions.rename_named", { name })} @click=${() => does.naming(id)}>${t("sessions.rename")}</button>
            <button class="button small" type="button" aria-label=${t("sessions.delete_named", { name })} @click=${() => does.confirm(id)}>${t("sessions.delete")}</button>`
    }</span>
  </li>`;
}

/** @param {SessionSummary} session @param {Does} does */
function namingForm(session, { naming, rename }) {
  /** @param {SubmitEvent} event */
  const submit = (event) => {
    event.preventDefault();
    rename(session, String(new FormData(/** @type {HTMLFormElement} */ (event.currentTarget)).get("name") ?? "").trim());
  };
  return html`<form class="form-line row-naming" data-do="name" @submit=${submit}>
    <input class="field" name="name" maxlength="80" aria-label=${t("sessions.new_name")} .value=${session.name ?? ""}>
    <button class="button small strong" type="submit">${t("sessions.rename")}</button>
    <button class="button small" type="button" @click=${() => naming(null)}>${t("sessions.keep_name")}</button>
  </form>`;
}
