// @ts-check
/**
 * Settings as sliders beside the road, and a legend. Every change is a sentence, which stands under its slider: it is
 * said as if it had been typed, so that it is answered, logged and undone like one.
 */

import { html, live, render } from "../../vendor/lit-html.js";
import { askJson } from "../core/http.js";
import { sessionPath } from "../core/protocol.js";
import { decimalText, t } from "../core/texts.js";
import { paceText, percent } from "../core/words.js";
import { readPalette } from "../core/theme.js";
import { drawGlyph } from "../road/paint/glyphs.js";
import { icon } from "../ui/icons.js";
import { fitCanvas } from "../ui/slot.js";

/** @import { Page } from "../core/page.js" */
/** @import { State } from "../core/state.js" */
/** @import { Panel } from "./index.js" */

/** @typedef {Record<string, unknown>} Config */

/**
 * @typedef {object} Slider
 * @property {string} name
 * @property {number} most
 * @property {number} step
 * @property {(state: State, config: Config) => number} value
 * @property {(value: number) => string} shown
 * @property {(value: number) => string} [said]  the value as it stands in the sentence
 */

const PACES = [0.25, 0.5, 1, 2, 4, 8, 16, 32, 64];
const LEGEND = ["av", "vehicle", "pedestrian", "pothole", "barrier"];
const GLYPH_PX = 22;

/** @param {string} kind @param {number} most @returns {Slider} */
const counted = (kind, most) => ({
  name: kind,
  most,
  step: 1,
  value: ({ world }) => [...(world?.things.values() ?? [])].filter((thing) => thing.kind === kind).length,
  shown: String,
});

/** @param {string} name @returns {Slider} */
const share = (name) => ({
  name,
  most: 1,
  step: 0.05,
  value: (_state, config) => Number(config[name] ?? 0),
  shown: percent,
  said: (value) => decimalText(value, 2),
});

/** @type {Slider[]} */
const SLIDERS = [
  counted("pothole", 40),
  counted("vehicle", 60),
  counted("pedestrian", 20),
  share("courtesy"),
  share("attentive"),
  {
    name: "pace",
    most: PACES.length - 1,
    step: 1,
    value: ({ world }) => (world?.pace === "max" ? PACES.length - 1 : Math.max(0, PACES.findIndex((each) => each >= Number(world?.pace ?? 1)))),
    shown: (value) => paceText(PACES[value]),
    said: (value) => String(PACES[value]).replace(".", decimalText(0.5, 1)[1]),
  },
];

/** @param {Page} page @returns {Panel & {toggle: () => void}} */
export function createSettingsDrawer(page) {
  const dialog = document.createElement("dialog");
  dialog.id = "settings";
  dialog.className = "drawer";
  dialog.setAttribute("aria-labelledby", "settings-title");
  document.body.append(dialog);
  /** @type {Config} */ let config = {};
  /** What is being moved and not said yet, by slider. @type {Map<string, number>} */ const moved = new Map();

  function show() {
    if (dialog.open) render(template(page.state(), config, moved, { move, say, close }), dialog);
    for (const canvas of dialog.querySelectorAll("canvas")) paint(canvas);
  }

  async function load() {
    const { session } = page.state();
    if (!session) return;
    const known = await askJson(sessionPath(session)).catch(() => null);
    if (known && page.state().session === session) config = known.config;
    moved.clear();
    show();
  }

  /** @param {Slider} slider @param {number} value */
  function move({ name }, value) {
    moved.set(name, value);
    show();
  }

  /** @param {Slider} slider @param {number} value */
  function say(slider, value) {
    page.say(sentenceOf(slider, value));
  }

  const close = () => dialog.close();
  dialog.addEventListener("keydown", (event) => {
    if (event.key === "Escape") close();
    if (event.key === "Escape" || event.key.startsWith("Arrow")) event.stopPropagation();
  });
  // Wherever the focus is: what else is open, or being written, takes the key first.
  addEventListener("keydown", (event) => {
    if (event.key === "Escape" && dialog.open && !event.defaultPrevented) close();
  });

  return {
    update(state, before) {
      if (!dialog.open) return;
      const answered = state.talk !== before.talk && state.talk.at(-1)?.standing !== "pending";
      if (state.session !== before.session || state.steps !== before.steps || answered) void load();
      if (state.world !== before.world) show();
    },

    repaint: show,

    toggle() {
      if (dialog.open) return close();
      dialog.show();
      show();
      void load();
    },
  };
}

/** @param {Slider} slider @param {number} value */
function sentenceOf({ name, said = String }, value) {
  return t(`settings.say.${name}`, { value: said(value) });
}

/**
 * @param {State} state
 * @param {Config} config
 * @param {Map<string, number>} moved
 * @param {{move: (slider: Slider, value: number) => void, say: (slider: Slider, value: number) => void, close: () => void}} hands
 */
function template(state, config, moved, hands) {
  return html`<div class="drawer-head">
      <h2 class="panel-title" id="settings-title">${t("settings.title")}</h2>
      <button class="head-button" type="button" aria-label=${t("page.close")} title=${t("page.close")} @click=${hands.close}>${icon("close")}</button>
    </div>
    <div class="drawer-body">
      ${SLIDERS.map((slider) => row(slider, moved.get(slider.name) ?? slider.value(state, config), moved.has(slider.name), hands))}
      <h3 class="panel-title">${t("settings.legend")}</h3>
      <ul class="legend">
        ${LEGEND.map((kind) => html`<li><canvas data-kind=${kind} aria-hidden="true"></canvas> ${t(`nouns.${kind}`)}</li>`)}
        ${["next", "expected", "cause", "blocked"].map((name) => html`<li><span class="legend-mark" data-mark=${name} aria-hidden="true"></span> ${t(`settings.marks.${name}`)}</li>`)}
      </ul>
    </div>`;
}

/**
 * @param {Slider} slider
 * @param {number} value
 * @param {boolean} moving
 * @param {{move: (slider: Slider, value: number) => void, say: (slider: Slider, value: number) => void}} hands
 */
function row(slider, value, moving, { move, say }) {
  const { name, most, step, shown } = slider;
  const read = (/** @type {Event} */ { target }) => Number(/** @type {HTMLInputElement} */ (target).value);
  return html`<label class="setting" ?data-moving=${moving}>
    <span class="setting-name">${t(`settings.names.${name}`)}</span>
    <output class="setting-value">${shown(value)}</output>
    <input type="range" min="0" max=${most} step=${step} data-setting=${name} aria-valuetext=${shown(value)} .value=${live(String(value))}
      @input=${(/** @type {Event} */ event) => move(slider, read(event))} @change=${(/** @type {Event} */ event) => say(slider, read(event))}>
    <span class="setting-said">${t("log.said", { text: sentenceOf(slider, value) })}</span>
  </label>`;
}

/** @param {HTMLCanvasElement} canvas */
function paint(canvas) {
  canvas.style.inlineSize = canvas.style.blockSize = `${GLYPH_PX}px`;
  const pen = fitCanvas(canvas, GLYPH_PX, GLYPH_PX);
  pen.clearRect(0, 0, GLYPH_PX, GLYPH_PX);
  drawGlyph(pen, { kind: String(canvas.dataset.kind), heading: "right" }, GLYPH_PX / 2, GLYPH_PX / 2, GLYPH_PX, readPalette(document.documentElement));
}
