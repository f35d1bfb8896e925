// @ts-check
/** Files out of the page and back into it: a picture, the recording; fetched when one is first wanted. */

import { hashOf } from "../core/address.js";
import { errorText } from "../core/http.js";
import { t } from "../core/texts.js";
import { fetched, fileName, recordingIn, recordingPath, save } from "./downloads.js";
import { openRecording } from "./links.js";

/** @import { Page } from "../core/page.js" */
/** @import { Files } from "./export.js" */

/** @param {Page} page @returns {Files} */
export function createFiles(page) {
  return {
    picture() {
      const { look, session, world } = page.state();
      const canvas = /** @type {HTMLCanvasElement | null} */ (document.querySelector("#road canvas"));
      if (!canvas || !session) return;
      canvas.toBlob((data) => {
        const name = fileName(session, `tick-${look.tick ?? world?.tick ?? 0}`, "png");
        if (data) save(data, name);
        page.tell(data ? { text: t("session.picture_saved", { name }) } : { text: t("session.no_picture"), tone: "bad" });
      }, "image/png");
    },

    async recording() {
      const { session } = page.state();
      if (!session) return;
      try {
        save(await fetched(recordingPath(session)), fileName(session, "recording", "json"));
      } catch (error) {
        page.tell({ text: t("session.no_recording", { reason: errorText(error) }), tone: "bad" });
      }
    },

    async open(file) {
      if (!file) return;
      const { name } = file;
      const { session } = page.state();
      page.tell({ text: t("session.opening", { name }) });
      try {
        const { id } = await openRecording(recordingIn(await file.text(), name));
        const go = () => void (location.hash = hashOf(id));
        const here = page.state().session === session; // else somebody has gone elsewhere meanwhile, and stays there
        if (here) go();
        page.tell({ text: t("session.opened", { name }), ...(here ? {} : { offer: { label: t("session.go_there"), run: go } }) });
      } catch (error) {
        page.tell({ text: t("session.not_opened", { reason: errorText(error) }), tone: "bad" });
      }
    },
  };
}
