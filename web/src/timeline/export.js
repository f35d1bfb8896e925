// @ts-check
/** Panel with the export commands (picture, recording, video) and the drop target that opens a recording. */

import { html, nothing, render } from "../../vendor/lit-html.js";
import { onDemand, styled } from "../core/lazy.js";
import { t } from "../core/texts.js";
import { find } from "../ui/slot.js";

/** @import { Command } from "../core/commands.js" */
/** @import { Page } from "../core/page.js" */
/** @import { Panel } from "../panels/index.js" */

/** @typedef {{picture: () => void, recording: () => Promise<void>, open: (file: File | undefined) => Promise<void>}} Files */

/** @param {HTMLElement} host @param {Page} page @returns {Panel} */
export function createExport(host, page) {
  const video = onDemand(page, async () => {
    const [{ createVideoDialog }] = await Promise.all([import("./videoDialog.js"), styled("dialog")]);
    return createVideoDialog(page);
  });
  /** @type {(use: (files: Files) => void) => void} */
  const files = onDemand(page, async () => (await import("./files.js")).createFiles(page));
  const open = (/** @type {File | undefined} */ file) => files((all) => void all.open(file));
  const show = (/** @type {boolean} */ over) => render(content(over, open), host);
  show(false);
  watchDrops(show, open);

  const group = t("groups.session");
  /** @type {Command[]} */
  const commands = [
    { name: "picture", group, now: ({ past }) => ({ label: past ? t("session.picture_tick", past.world) : t("session.picture"), run: () => files((all) => all.picture()) }) },
    { name: "video", group, now: () => ({ label: t("session.video"), run: () => video((show) => show()) }) },
    { name: "recording", group, now: () => ({ label: t("session.recording"), run: () => files((all) => void all.recording()) }) },
    { name: "open-recording", group, now: () => ({ label: t("session.open_recording"), run: () => find(host, "input").click() }) },
  ];
  return { commands };
}

/** @param {boolean} over  whether a file is held over the page @param {(file: File | undefined) => void} open */
function content(over, open) {
  /** @param {Event} event */
  const chosen = ({ target }) => {
    const chooser = /** @type {HTMLInputElement} */ (target);
    open(chooser.files?.[0]);
    chooser.value = "";
  };
  return html`<input type="file" accept=".json,application/json" hidden aria-label=${t("session.recording_label")} @change=${chosen}>
    ${over ? html`<div class="drop"><p>${t("session.drop")}</p></div>` : nothing}`;
}

/**
 * Files alone: what is dragged within the page is somebody else's.
 * @param {(over: boolean) => void} show
 * @param {(file: File | undefined) => void} open
 */
function watchDrops(show, open) {
  /** @param {DragEvent} event */
  const brings = (event) => event.dataTransfer?.types.includes("Files") ?? false;
  addEventListener("dragover", (event) => {
    if (!brings(event)) return;
    event.preventDefault();
    show(true);
  });
  addEventListener("dragleave", (event) => {
    if (event.relatedTarget === null) show(false);
  });
  addEventListener("drop", (event) => {
    show(false);
    if (!brings(event)) return;
    event.preventDefault();
    open(event.dataTransfer?.files[0]);
  });
}
