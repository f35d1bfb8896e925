// @ts-check
/** Things to take away (a picture, the recording, a film) and a recording brought back, also by dropping it. */

import { make } from "../dom.js";
import { fetched, fileName, recordingIn, recordingPath, save } from "../downloads.js";
import { words } from "../http.js";
import { onDemand } from "../lazy.js";
import { hashOf, openRecording } from "../links.js";

/** @import { Act } from "../acts.js" */
/** @import { Page } from "../main.js" */
/** @import { Looking } from "../past.js" */
/** @import { Panel } from "./index.js" */

/** @param {HTMLElement} road  where the road's canvas is @param {Page} page @param {Looking} looking @returns {Panel} */
export function createExport(road, page, looking) {
  const film = onDemand(page, async () => (await import("./film.js")).filmDialog(page, looking));
  const chooser = make("input", { type: "file", accept: ".json,application/json", hidden: true, "aria-label": "Recording" });
  const over = make("div", { class: "drop", hidden: true }, make("p", {}, "Drop a recording to open it as a new session"));
  document.body.append(chooser, over);

  function picture() {
    const { session, world } = page.state();
    const canvas = road.querySelector("canvas");
    if (!canvas || !session) return;
    canvas.toBlob((data) => {
      if (data) save(data, fileName(session, `tick-${looking.tick ?? world?.tick ?? 0}`, "png"));
      else page.tell({ text: "The picture could not be made.", tone: "bad" });
    }, "image/png");
  }

  async function recording() {
    const { session } = page.state();
    if (!session) return;
    try {
      save(await fetched(recordingPath(session)), fileName(session, "recording", "json"));
    } catch (error) {
      page.tell({ text: `The recording was not fetched. ${words(error)}`, tone: "bad" });
    }
  }

  /** @param {File | undefined} file */
  async function open(file) {
    if (!file) return;
    page.tell({ text: `Opening “${file.name}”. A long run takes a moment to replay.` });
    try {
      const { id } = await openRecording(recordingIn(await file.text(), file.name));
      location.hash = hashOf(id);
      page.tell({ text: `“${file.name}” is open as a session of its own, paused where it ends.` });
    } catch (error) {
      page.tell({ text: `${words(error)} The session here is as it was.`, tone: "bad" });
    }
  }

  chooser.addEventListener("change", () => {
    void open(chooser.files?.[0]);
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
    void open(event.dataTransfer?.files[0]);
  });

  const group = "Session";
  /** @type {Act[]} */
  const acts = [
    { name: "picture", group, now: ({ past }) => ({ label: past ? `Save a picture of tick ${past.world.tick}` : "Save a picture of the road", run: picture }) },
    { name: "film", group, now: () => ({ label: "Make a film…", run: () => film((dialog) => dialog.open()) }) },
    { name: "recording", group, now: () => ({ label: "Save the recording", run: () => void recording() }) },
    { name: "open-recording", group, now: () => ({ label: "Open a recording…", run: () => chooser.click() }) },
  ];
  return { acts };
}
