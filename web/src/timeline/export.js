// @ts-check
/** Things to take away (a picture, the recording, a film) and a recording brought back, also by dropping it. */

import { make } from "../ui/dom.js";
import { onDemand, styled } from "../core/lazy.js";

/** @import { Act } from "../core/commands.js" */
/** @import { Page } from "../main.js" */
/** @import { Looking } from "./past.js" */
/** @import { Panel } from "../panels/index.js" */

/** @param {HTMLElement} road  where the road's canvas is @param {Page} page @param {Looking} looking @returns {Panel} */
export function createExport(road, page, looking) {
  const film = onDemand(page, async () => {
    const [{ filmDialog }] = await Promise.all([import("./videoDialog.js"), styled("dialog")]);
    return filmDialog(page, looking);
  });
  const files = onDemand(page, async () => (await import("./files.js")).createFiles(road, page, looking));
  const chooser = make("input", { type: "file", accept: ".json,application/json", hidden: true, "aria-label": "Recording" });
  const over = make("div", { class: "drop", hidden: true }, make("p", {}, "Drop a recording to open it as a new session"));
  document.body.append(chooser, over);

  chooser.addEventListener("change", () => {
    const file = chooser.files?.[0];
    files(({ open }) => void open(file));
    chooser.value = "";
  });

  // Files alone: what is dragged within the page is somebody else's.
  /** @param {DragEvent} event */
  const brings = (event) => event.dataTransfer?.types.includes("Files") ?? false;
  addEventListener("dragover", (event) => {
    if (!brings(event)) return;
    event.preventDefault();
    over.hidden = false;
  });
  addEventListener("dragleave", (event) => {
    if (event.relatedTarget === null) over.hidden = true;
  });
  addEventListener("drop", (event) => {
    over.hidden = true;
    if (!brings(event)) return;
    event.preventDefault();
    const file = event.dataTransfer?.files[0];
    files(({ open }) => void open(file));
  });

  const group = "Session";
  /** @type {Act[]} */
  const acts = [
    { name: "picture", group, now: ({ past }) => ({ label: past ? `Save a picture of tick ${past.world.tick}` : "Save a picture of the road", run: () => files((all) => all.picture()) }) },
    { name: "film", group, now: () => ({ label: "Make a film…", run: () => film((dialog) => dialog.open()) }) },
    { name: "recording", group, now: () => ({ label: "Save the recording", run: () => files((all) => void all.recording()) }) },
    { name: "open-recording", group, now: () => ({ label: "Open a recording…", run: () => chooser.click() }) },
  ];
  return { acts };
}
