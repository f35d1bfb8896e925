// @ts-check
/** Files out of the page and back into it: a picture, the recording; fetched when one is first wanted. */

import { fetched, fileName, recordingIn, recordingPath, save } from "./downloads.js";
import { words } from "../core/http.js";
import { hashOf, openRecording } from "./links.js";

/** @import { Page } from "../main.js" */
/** @import { Looking } from "./past.js" */

/** @param {HTMLElement} road  where the road's canvas is @param {Page} page @param {Looking} looking */
export function createFiles(road, page, looking) {
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
    const { session } = page.state();
    page.tell({ text: `Opening “${file.name}”. A long run takes a moment to replay.` });
    try {
      const { id } = await openRecording(recordingIn(await file.text(), file.name));
      const go = () => void (location.hash = hashOf(id));
      const here = page.state().session === session; // else somebody has gone elsewhere meanwhile, and stays there
      if (here) go();
      page.tell({ text: `“${file.name}” is open as a session of its own, paused where it ends.`, ...(here ? {} : { offer: { label: "Go there", run: go } }) });
    } catch (error) {
      page.tell({ text: `${words(error)} The session here is as it was.`, tone: "bad" });
    }
  }

  return { picture, recording, open };
}
