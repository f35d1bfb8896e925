// @ts-check
/** Opens the quiz when the answer to "quiz me" comes; its dialog is fetched then. */

import { onDemand, styled } from "../core/lazy.js";
import { t } from "../core/texts.js";

/** @import { Page } from "../core/page.js" */
/** @import { Panel } from "../panels/index.js" */
/** @import { Quiz } from "./quizResult.js" */

/** @param {Page} page @returns {Panel} */
export function createQuizLoader(page) {
  const wanted = onDemand(page, async () => {
    const [{ createQuizDialog }] = await Promise.all([import("./quizDialog.js"), styled("dialog"), styled("quiz")]);
    return createQuizDialog();
  });
  return {
    commands: [
      { name: "quiz", group: t("groups.help"), now: () => ({ label: t("quiz.title"), run: () => void page.act([{ do: "ask", about: "quiz" }], t("quiz.title")) }) },
    ],

    update({ talk }, before) {
      if (talk === before.talk) return;
      const waiting = new Set(before.talk.filter(({ standing }) => standing === "pending").map(({ id }) => id));
      const quiz = talk.findLast(({ id, result }) => waiting.has(id) && result?.answer?.quiz)?.result?.answer?.quiz;
      if (quiz) wanted((open) => open(/** @type {Quiz} */ (quiz)));
    },
  };
}
