// @ts-check
/**
 * Speaking and being spoken to, where the browser can: a microphone that fills the box, and reading aloud on request.
 *
 * Neither is on by itself. A browser may send what it hears to its maker; that is said before it listens.
 */

import { html } from "../../vendor/lit-html.js";
import { prefer, preference } from "../core/preferences.js";
import { LANGUAGE, t } from "../core/texts.js";
import { icon } from "../ui/icons.js";

/** @import { Command } from "../core/commands.js" */
/** @import { Panel } from "../panels/index.js" */

/** Decisions of this weight and more are told aloud. */
const TELLING = 2;

/**
 * A button that listens; null where the browser cannot.
 * @param {(text: string) => void} put
 * @param {() => void} changed
 * @returns {(() => unknown) | null}
 */
export function createMicrophone(put, changed) {
  const Recognition = Reflect.get(window, "SpeechRecognition") ?? Reflect.get(window, "webkitSpeechRecognition");
  if (!Recognition) return null;
  let title = t("talk.speak_warning");
  /** @type {any} */ let listening = null;

  function stop() {
    listening = null;
    changed();
  }

  function press() {
    if (listening) return listening.stop();
    listening = new Recognition();
    listening.lang = LANGUAGE;
    listening.addEventListener("result", (/** @type {any} */ event) => put(event.results[0][0].transcript));
    listening.addEventListener("error", (/** @type {any} */ event) => {
      title = t("talk.heard_nothing", { error: event.error });
      stop();
    });
    listening.addEventListener("end", stop);
    listening.start();
    changed();
  }

  return () =>
    html`<button class="button quiet icon microphone" type="button" aria-label=${t("talk.speak")} aria-pressed=${String(listening !== null)} title=${title} @click=${press}>
      ${icon("microphone")}
    </button>`;
}

/** Whether this browser can read aloud at all. */
export const canSpeak = () => "speechSynthesis" in window;

export const speaks = () => canSpeak() && preference("aloud") === "on";

/** @param {boolean} on */
export function speak(on) {
  prefer("aloud", on ? "on" : "off");
  if (!on) speechSynthesis.cancel();
}

/** Reads aloud what matters: replies, ends, and decisions of weight. @returns {Panel} */
export function createReader() {
  /** @type {Command} */
  const toggle = {
    name: "aloud",
    group: t("groups.talk"),
    now: () => ({ label: t(speaks() ? "talk.aloud_stop" : "talk.aloud"), run: () => speak(!speaks()) }),
  };
  return {
    commands: canSpeak() ? [toggle] : [],
    update(state, before) {
      if (!speaks()) return;
      if (state.announcement !== before.announcement) say(state.announcement);
      else if (state.narration !== before.narration && (state.decision?.weight ?? 0) >= TELLING) say(state.narration);
    },
  };
}

/** @param {string | null} text */
function say(text) {
  if (!text) return;
  const utterance = new SpeechSynthesisUtterance(text);
  utterance.lang = LANGUAGE;
  speechSynthesis.cancel(); // the newest is what matters
  speechSynthesis.speak(utterance);
}
