// @ts-check
/** The dialog of moments with a name: saved, looked at, gone back to. */

import { html, live, nothing } from "../../vendor/lit-html.js";
import { askJson, errorText } from "../core/http.js";
import { newestOnly } from "../core/latest.js";
import { sessionPath } from "../core/protocol.js";
import { t } from "../core/texts.js";
import { dialogSlot, makeDialog } from "../ui/dialog.js";

/** @import { Page } from "../core/page.js" */
/** @import { SavedMoment, SavedMoments } from "../core/wire.js" */
/** @import { Exchange } from "../talk/exchanges.js" */

const LONGEST_NAME = 40;

/** @typedef {{text: string, bad: boolean}} Note */
/** @typedef {{name: string, note: Note, moments: SavedMoment[] | null, session: string | null}} Shown  null: not known yet */

/** @param {Page} page @returns {(naming: boolean) => void} opens it */
export function createMomentsDialog(page) {
  const dialog = makeDialog(t("moments.title"));
  const body = dialogSlot(dialog);
  /** @type {Shown} */ let shown = { name: "", note: { text: "", bad: false }, moments: null, session: null };
  /** @type {string | null} the exchange whose answer is waited for */ let waiting = null;
  const asking = newestOnly();

  /** @param {Partial<Shown>} change */
  function show(change) {
    shown = { ...shown, ...change };
    body(content(shown, { page, close: () => dialog.close(), name: (name) => show({ name }), save }));
  }

  function save() {
    const name = shown.name.trim();
    if (name !== "") waiting = page.act([{ do: "save", name }], t("moments.save_as", { name }), true);
  }

  async function list() {
    const { session } = page.state();
    if (!session) return;
    const newest = asking();
    if (session !== shown.session) show({ session, moments: null }); // those of another session are none here
    try {
      /** @type {SavedMoments} */
      const { items } = await askJson(`${sessionPath(session)}/saved`);
      if (newest()) show({ moments: items });
    } catch (error) {
      if (newest()) show({ note: { text: errorText(error), bad: true } });
    }
  }

  page.subscribe(({ talk }, before) => {
    const exchange = waiting === null || talk === before.talk ? null : talk.find(({ id }) => id === waiting);
    if (!exchange || exchange.standing === "pending") return;
    waiting = null;
    show({ note: noteOf(exchange), ...(exchange.standing === "done" ? { name: "" } : {}) });
    if (exchange.standing === "done") void list();
  });

  return (naming) => {
    // Only the present can be given a name: what is looked at is the past.
    if (naming) page.timeTravel.live();
    show({ name: "", note: { text: "", bad: false } });
    dialog.showModal();
    if (naming) /** @type {HTMLElement | null} */ (dialog.querySelector("input"))?.focus();
    void list();
  };
}

/** @param {Exchange} exchange @returns {Note} */
function noteOf({ standing, problem, result }) {
  if (standing === "done") return { text: result?.reply ?? t("moments.saved"), bad: false };
  return { text: problem?.detail ?? t("moments.lost"), bad: true };
}

/**
 * @param {Shown} shown
 * @param {{page: Page, close: () => void, name: (name: string) => void, save: () => void}} does
 */
function content({ name, note, moments }, { page, close, name: rename, save }) {
  /** @param {SubmitEvent} event */
  const submit = (event) => {
    event.preventDefault();
    save();
  };
  /** @param {Event} event */
  const typed = ({ target }) => rename(/** @type {HTMLInputElement} */ (target).value);
  return html`<form class="form-line" @submit=${submit}>
      <input class="field" maxlength=${LONGEST_NAME} placeholder=${t("moments.placeholder")} aria-label=${t("moments.name")} required .value=${live(name)} @input=${typed}>
      <button class="button strong" type="submit">${t("moments.save")}</button>
    </form>
    <p class="dialog-note" role="status" data-tone=${note.bad ? "bad" : "plain"}>${note.text}</p>
    <ul class="rows">
      ${moments?.map((moment) => row(moment, page, close)) ?? nothing}
      ${moments?.length === 0 ? html`<li class="rows-none">${t("moments.none")}</li>` : nothing}
    </ul>`;
}

/** @param {SavedMoment} moment @param {Page} page @param {() => void} close */
function row({ name, tick }, page, close) {
  const look = () => {
    close();
    void page.timeTravel.at(tick);
  };
  const go = () => {
    close();
    page.timeTravel.live();
    page.act([{ do: "load", name }], t("moments.go_to", { name }), false);
  };
  const past = tick < (page.state().world?.tick ?? 0);
  return html`<li class="row">
    <span class="row-name" title=${name}>${name}</span>
    <span class="row-note">${t("moments.tick", { tick })}</span>
    <span class="row-do">
      ${past ? html`<button class="button small" type="button" aria-label=${t("moments.look_at", { name })} @click=${look}>${t("moments.look")}</button>` : nothing}
      <button class="button small" type="button" aria-label=${t("moments.go_back_to", { name })} title=${t("moments.go_title")} @click=${go}>${t("moments.go")}</button>
    </span>
  </li>`;
}
