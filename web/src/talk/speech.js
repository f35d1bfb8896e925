// @ts-check
/**
 * Speaking and being spoken to, where the browser can: a microphone that fills the box, and reading aloud on request.
 *
 * Neither is on by itself. A browser may send what it hears to its maker; that is said before it listens.
 */

import { icon } from "../ui/icons.js";
import { make } from "../ui/dom.js";
import { spoken } from "./language.js";
import { prefer, preference } from "../core/preferences.js";

/** @import { Act } from "../core/commands.js" */
/** @import { Panel } from "../panels/index.js" */

const WARNING = "Speak. Your browser may send what it hears to its maker; the words are put in the box, not sent off.";
/** Decisions of this weight and more are told aloud. */
const TELLING = 2;

/**
 * A button that listens; null where the browser cannot.
 * @param {(text: string) => void} put
 * @returns {HTMLButtonElement | null}
 */
export function createMicrophone(put) {
  const Recognition = Reflect.get(window, "SpeechRecognition") ?? Reflect.get(window, "webkitSpeechRecognition");
  if (!Recognition) return null;
  const button = make(
    "button",
    { class: "button quiet icon microphone", type: "button", "aria-label": "Speak", "aria-pressed": "false", title: WARNING },
    icon("microphone"),
  );
  /** @type {any} */ let listening = null;
  const stop = () => {
    listening = null;
    button.setAttribute("aria-pressed", "false");
  };
  button.addEventListener("click", () => {
    if (listening) return listening.stop();
    listening = new Recognition();
    listening.lang = spoken();
    listening.addEventListener("result", (/** @type {any} */ event) => put(event.results[0][0].transcript));
    listening.addEventListener("error", (/** @type {any} */ event) => {
      button.title = `The browser did not hear anything (${event.error}).`;
      stop();
    });
    listening.addEventListener("end", stop);
    button.setAttribute("aria-pressed", "true");
    listening.start();
  });
  return button;
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
  /** @type {Act[]} */
  const acts = canSpeak()
    ? [
        {
          name: "aloud",
          group: "Talk",
          now: () => ({ label: speaks() ? "Stop reading aloud" : "Read aloud what matters", run: () => speak(!speaks()) }),
        },
      ]
    : [];
  return {
    acts,
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
  const spokenText = new SpeechSynthesisUtterance(text);
  spokenText.lang = "en";
  speechSynthesis.cancel(); // the newest is what matters
  speechSynthesis.speak(spokenText);
}
