// @ts-check
/** The dialog in which a film of a stretch of ticks is asked for; fetched when it is first opened. */

import { makeDialog } from "../ui/dialog.js";
import { make, setText } from "../ui/dom.js";
import { fetched, fileName, filmPath, save, sizeWords, stretch } from "./downloads.js";
import { words } from "../core/http.js";
import { counted } from "../core/words.js";

/** @import { Page } from "../main.js" */
/** @import { Looking } from "./past.js" */

/**
 * @param {string} label
 * @param {HTMLElement} control
 */
function row(label, control) {
  return make("label", { class: "form-row" }, make("span", {}, label), control);
}

/** @param {[string, string][]} options @param {string} name */
function choice(options, name) {
  return make("select", { class: "field", name }, ...options.map(([value, label]) => make("option", { value }, label)));
}

/** @param {Page} page @param {Looking} looking */
export function filmDialog(page, looking) {
  const from = make("input", { class: "field", type: "number", min: "0", required: true });
  const to = make("input", { class: "field", type: "number", min: "0", required: true });
  const view = choice([["road", "The road"], ["schematic", "Its plan"]], "view");
  const format = choice([["gif", "GIF"], ["mp4", "MP4"]], "format");
  const side = choice([["320", "Small · 320"], ["480", "Middle · 480"], ["720", "Large · 720"]], "side");
  side.value = "480";
  const told = make("p", { class: "dialog-note", role: "status" });
  const progress = make("progress", { class: "progress", hidden: true, "aria-label": "Making the film" });
  const start = make("button", { class: "button strong", type: "submit" }, "Make film");
  const cancel = make("button", { class: "button", type: "button", hidden: true, onclick: () => making?.abort() }, "Cancel");
  const form = make(
    "form",
    { class: "form" },
    make("div", { class: "form-pair" }, row("From tick", from), row("To tick", to)),
    row("Show", view),
    make("div", { class: "form-pair" }, row("Format", format), row("Size", side)),
    told,
    progress,
    make("div", { class: "form-end" }, cancel, start),
  );
  const dialog = makeDialog("Make a film", form);
  /** @type {AbortController | null} */ let making = null;

  function length() {
    const ticks = to.valueAsNumber - from.valueAsNumber;
    const stepS = page.state().world?.stepS ?? 0.5;
    told.dataset.tone = "plain";
    setText(told, ticks > 0 ? `${counted(ticks, "tick")}, ${(ticks * stepS).toFixed(1)} s long.` : "");
  }
  form.addEventListener("input", length);
  dialog.addEventListener("close", () => making?.abort());

  form.addEventListener("submit", async (event) => {
    event.preventDefault();
    const { session, world } = page.state();
    if (!session || !world || making) return;
    making = new AbortController();
    const { signal } = making;
    const wish = /** @type {import("./downloads.js").FilmWish} */ ({
      from: from.valueAsNumber, to: to.valueAsNumber, format: format.value, view: view.value, side: Number(side.value),
    });
    const began = performance.now();
    const say = () => setText(told, `Drawing ${counted(wish.to - wish.from, "tick")}: ${Math.round((performance.now() - began) / 1000)} s`);
    told.dataset.tone = "plain";
    say();
    const clock = setInterval(say, 1_000);
    show(true);
    try {
      const data = await fetched(filmPath(session, wish, world.stepS), signal);
      save(data, fileName(session, `${wish.from}-${wish.to}`, wish.format));
      setText(told, `Saved: ${sizeWords(data.size)}.`);
    } catch (error) {
      told.dataset.tone = signal.aborted ? "plain" : "bad";
      setText(told, signal.aborted ? "Cancelled." : words(error));
    } finally {
      clearInterval(clock);
      making = null;
      show(false);
    }
  });

  /** @param {boolean} busy */
  function show(busy) {
    progress.hidden = cancel.hidden = !busy;
    start.disabled = busy;
  }

  function open() {
    const { world } = page.state();
    const now = world?.tick ?? 0;
    const part = stretch(now, looking.tick);
    from.value = `${part.from}`;
    to.value = `${part.to}`;
    from.max = to.max = `${now}`;
    length();
    dialog.showModal();
    start.focus();
  }
  return { open };
}
