// @ts-check
/** The dialogs of moments with a name and of the sessions that are kept; fetched when they are first opened. */

import { makeDialog } from "../ui/dialog.js";
import { make, setText } from "../ui/dom.js";
import { ask, askJson, words } from "../core/http.js";
import { turns } from "../core/latest.js";
import { hashOf } from "./links.js";
import { SESSIONS_PATH, sessionPath } from "../core/protocol.js";

/** @import { Page } from "../main.js" */
/** @import { Looking } from "./past.js" */

const LONGEST_NAME = 40;

/** @param {Page} page @param {Looking} looking */
export function momentsDialog(page, looking) {
  const name = make("input", { class: "field", maxLength: LONGEST_NAME, placeholder: "A name for this moment", "aria-label": "Name", required: true });
  const form = make("form", { class: "form-line" }, name, make("button", { class: "button strong", type: "submit" }, "Save"));
  const told = make("p", { class: "dialog-note", role: "status" });
  const list = make("ul", { class: "rows" });
  const dialog = makeDialog("Saved moments", form, told, list);
  /** @type {string | null} */ let waiting = null;
  /** @type {string | null} whose moments are listed */ let of = null;
  const asking = turns();

  form.addEventListener("submit", (event) => {
    event.preventDefault();
    const wanted = name.value.trim();
    if (wanted === "") return;
    waiting = page.act([{ do: "save", name: wanted }], `Save this moment as ${wanted}`, true);
  });

  async function show() {
    const { session } = page.state();
    if (!session) return;
    const newest = asking();
    if (session !== of) list.replaceChildren(); // those of another session are none here
    of = session;
    try {
      /** @type {{items: {name: string, tick: number}[]}} */
      const { items } = await askJson(`${sessionPath(session)}/saved`);
      if (!newest()) return;
      list.replaceChildren(...items.map(rowOf));
      if (items.length === 0) list.append(make("li", { class: "rows-none" }, "Nothing has been saved yet."));
    } catch (error) {
      if (newest()) tell(words(error), true);
    }
  }

  /** @param {{name: string, tick: number}} moment */
  function rowOf({ name: called, tick }) {
    const now = page.state().world?.tick ?? 0;
    const look = () => {
      dialog.close();
      void looking.at(tick);
    };
    const go = () => {
      dialog.close();
      looking.live();
      page.act([{ do: "load", name: called }], `Go to ${called}`, false);
    };
    return make(
      "li",
      { class: "row" },
      make("span", { class: "row-name", title: called }, called),
      make("span", { class: "row-note" }, `tick ${tick}`),
      make(
        "span",
        { class: "row-do" },
        tick < now && make("button", { class: "button small", type: "button", "aria-label": `Look at ${called}`, onclick: look }, "Look"),
        make("button", { class: "button small", type: "button", "aria-label": `Go back to ${called}`, title: "It becomes the present; one undo takes that back", onclick: go }, "Go back"),
      ),
    );
  }

  /** @param {string} text @param {boolean} bad */
  function tell(text, bad) {
    told.dataset.tone = bad ? "bad" : "plain";
    setText(told, text);
  }

  return {
    /** @param {boolean} naming */
    async open(naming) {
      // Only the present can be given a name: what is looked at is the past.
      if (naming) looking.live();
      tell("", false);
      name.value = "";
      dialog.showModal();
      if (naming) name.focus();
      await show();
    },

    refresh() {
      if (waiting === null) return;
      const exchange = page.state().talk.find(({ id }) => id === waiting);
      if (!exchange || exchange.standing === "pending") return;
      waiting = null;
      if (exchange.standing !== "done") return tell(exchange.problem?.detail ?? "The connection was lost before the answer came.", true);
      tell(exchange.result?.reply ?? "Saved.", false);
      name.value = "";
      void show();
    },
  };
}

/** @typedef {{id: string, name: string | null, created_at: string, seed: number, live: boolean, tick: number}} Kept */

/** @param {Page} page */
export function sessionsDialog(page) {
  const list = make("ul", { class: "rows" });
  const told = make("p", { class: "dialog-note", role: "status" });
  const more = make("button", { class: "button small", type: "button", hidden: true, onclick: () => void show() }, "More");
  const fresh = make("button", { class: "button", type: "button", onclick() {
    dialog.close();
    page.startSession();
  } }, "New session");
  const dialog = makeDialog("Sessions", told, list, make("div", { class: "form-end" }, more, fresh));
  /** @type {string | null} */ let after = null;
  const asking = turns();

  async function show() {
    const newest = asking();
    try {
      const found = await askJson(`${SESSIONS_PATH}?limit=20${after === null ? "" : `&after=${after}`}`);
      if (!newest()) return; // opened anew, or asked for twice
      list.append(...found.items.map(rowOf));
      after = found.after;
      more.hidden = !found.more;
    } catch (error) {
      if (!newest()) return;
      told.dataset.tone = "bad";
      setText(told, words(error));
    }
  }

  /** @param {Kept} kept */
  function rowOf({ id, name, created_at: created, tick, seed }) {
    const here = id === page.state().session;
    const called = name ?? `Session ${id.slice(0, 6)}`;
    const when = new Date(created).toLocaleString("en-GB", { day: "numeric", month: "short", hour: "2-digit", minute: "2-digit" });
    const remove = make("button", { class: "button small", type: "button", "aria-label": `Delete ${called}`, onclick: confirm }, "Delete");
    const row = make(
      "li",
      { class: "row", "data-session": id },
      make("a", { class: "row-name", href: hashOf(id), "aria-current": here ? "true" : undefined, onclick: () => dialog.close() }, called, here && make("span", { class: "row-here" }, "this one")),
      make("span", { class: "row-note" }, `tick ${tick} · seed ${seed} · ${when}`),
      make("span", { class: "row-do" }, remove),
    );

    function confirm() {
      const keep = make("button", { class: "button small", type: "button", onclick: () => asked.replaceWith(remove) }, "Keep");
      const sure = make("button", { class: "button small danger", type: "button", "aria-label": `Delete ${called} for good`, onclick: () => void gone(sure) }, "Delete for good");
      const asked = make("span", { class: "row-do" }, keep, sure);
      remove.replaceWith(asked);
      keep.focus();
    }

    async function gone(/** @type {HTMLButtonElement} */ sure) {
      sure.disabled = true; // once is enough
      try {
        await ask(sessionPath(id), { method: "DELETE" });
        row.remove();
        told.dataset.tone = "plain";
        setText(told, `${called} was deleted.`);
        fresh.focus();
      } catch (error) {
        sure.disabled = false;
        told.dataset.tone = "bad";
        setText(told, `${called} was not deleted. ${words(error)}`);
      }
    }
    return row;
  }

  return {
    async open() {
      after = null;
      list.replaceChildren();
      setText(told, "");
      dialog.showModal();
      await show();
    },
  };
}

/** A link that cannot be copied by the page, to be copied by hand. */
export function linkDialog() {
  const field = make("input", { class: "field", readOnly: true, "aria-label": "Link", onfocus: () => field.select() });
  const told = make("p", { class: "dialog-note" });
  const dialog = makeDialog("Copy this link", field, told);
  return {
    /** @param {string} url @param {string} what */
    open(url, what) {
      field.value = url;
      setText(told, `This browser does not let a page copy. ${what}`);
      dialog.showModal();
      field.focus();
    },
  };
}
