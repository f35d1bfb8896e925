// @ts-check
/** A gallery of roads: a picture of each, what it is and why it is worth a look; one press opens it as a new session. */

import { html } from "../../vendor/lit-html.js";
import { t } from "../core/texts.js";
import { quizRoad } from "../talk/quizRoad.js";
import { dialogSlot, makeDialog } from "../ui/dialog.js";
import { SCENARIOS } from "./scenarios.js";

/** @import { Scenario } from "./scenarios.js" */

/** @returns {() => void} opens it */
export function createGallery() {
  const dialog = makeDialog(t("gallery.title"));
  dialog.id = "gallery";
  dialog.classList.add("dialog-wide");
  const body = dialogSlot(dialog);
  return () => {
    body(html`<p class="dialog-note">${t("gallery.note")}</p>
      <ul class="gallery">${SCENARIOS.map((each) => html`<li>${card(each, () => dialog.close())}</li>`)}</ul>`);
    dialog.showModal();
  };
}

/** A link, so that it can be copied as well as pressed. @param {Scenario} scenario @param {() => void} close */
function card({ name, rows }, close) {
  return html`<a class="gallery-card" href="#/g/${name}" data-scenario=${name} @click=${close}>
    ${quizRoad(rows, t("quiz.picture"))}
    <span class="gallery-words">
      <b>${t(`gallery.names.${name}`)}</b>
      <span>${t(`gallery.about.${name}`)}</span>
      <span class="gallery-why">${t(`gallery.why.${name}`)}</span>
    </span>
  </a>`;
}
