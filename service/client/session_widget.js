// @ts-check
/**
 * The front end of a session's widget in a notebook (`session_widget.py`): its picture, a clock, a line to say and ask.
 *
 * An anywidget module: it knows the model's values, sends what is pressed, and asks nothing of the network.
 */

/**
 * @typedef {object} Model  as anywidget hands it over
 * @property {(name: string) => any} get
 * @property {(name: string, call: () => void) => void} on
 * @property {(name: string, call: () => void) => void} off
 * @property {(message: object) => void} send
 */

/** What is shown beside the picture. */
const TEXTS = ["tick", "paused", "status", "planner", "narration", "reply", "trouble"];

/** @param {{model: Model, el: HTMLElement}} given @returns {() => void} what ends it */
function render({ model, el }) {
  const parts = build(el);
  const { play, step, form, words } = parts;
  const show = () => showTexts(model, parts);
  const draw = () => void drawPicture(model, parts.canvas);

  play.addEventListener("click", () => model.send({ do: model.get("paused") ? "play" : "pause" }));
  step.addEventListener("click", () => model.send({ do: "step" }));
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    if (words.value.trim() !== "") model.send({ do: "say", text: words.value });
    words.value = "";
  });
  // A notebook has keys of its own, which must not hear what is typed here.
  el.addEventListener("keydown", (event) => event.stopPropagation());
  for (const name of TEXTS) model.on(`change:${name}`, show);
  model.on("change:picture", draw);
  show();
  draw();
  return () => {
    for (const name of TEXTS) model.off(`change:${name}`, show);
    model.off("change:picture", draw);
  };
}

/** @param {HTMLElement} el */
function build(el) {
  const canvas = make("canvas", { className: "road", width: 1, height: 1, role: "img" });
  const play = make("button", { type: "button", className: "play" });
  const step = make("button", { type: "button", textContent: "Step" });
  const figures = make("span", { className: "figures" });
  const told = make("p", { className: "told" });
  const words = make("input", { type: "text", placeholder: "Say it, or ask why", ariaLabel: "Say or ask" });
  const form = make("form", { className: "say" });
  const answer = make("div", { className: "answer", ariaLive: "polite" });
  const bar = make("div", { className: "bar" });
  bar.append(play, step, figures);
  form.append(words, make("button", { type: "submit", textContent: "Send" }));
  el.classList.add("roadtalk-session");
  el.replaceChildren(canvas, bar, told, form, answer);
  return { canvas, play, step, figures, told, words, form, answer };
}

/**
 * @param {Model} model
 * @param {ReturnType<typeof build>} parts
 */
function showTexts(model, { canvas, play, step, figures, told, words, answer }) {
  const [tick, paused, status, planner] = ["tick", "paused", "status", "planner"].map((name) => model.get(name));
  const trouble = model.get("trouble");
  play.textContent = paused ? "Play" : "Pause";
  figures.textContent = [`tick ${tick}`, status, planner].filter(Boolean).join(" · ");
  canvas.ariaLabel = `The road at tick ${tick}`;
  told.textContent = trouble || model.get("narration");
  told.dataset.tone = trouble ? "bad" : "plain";
  for (const control of [play, step, words]) control.disabled = trouble !== "";
  const { said, text, refused, choices } = model.get("reply");
  if (said === undefined) return answer.replaceChildren();
  const offers = choices.map((/** @type {string} */ choice) => {
    const offer = make("button", { type: "button", className: "offer", textContent: choice });
    offer.addEventListener("click", () => model.send({ do: "say", text: choice }));
    return offer;
  });
  const reply = make("p", { className: "reply", textContent: text });
  reply.dataset.tone = refused ? "bad" : "plain";
  answer.replaceChildren(...(said ? [make("p", { className: "said", textContent: said })] : []), reply, ...offers);
}

/**
 * The newest picture; where several come at once, an older one never covers a newer one.
 * @param {Model} model
 * @param {HTMLCanvasElement} canvas
 */
async function drawPicture(model, canvas) {
  const data = model.get("picture");
  if (!data || data.byteLength === 0) return;
  let bitmap;
  try {
    bitmap = await createImageBitmap(new Blob([data], { type: "image/webp" }));
  } catch {
    return; // cut off on its way; the next one is whole
  }
  if (model.get("picture") === data) {
    if (canvas.width !== bitmap.width) canvas.width = bitmap.width;
    if (canvas.height !== bitmap.height) canvas.height = bitmap.height;
    canvas.getContext("2d")?.drawImage(bitmap, 0, 0);
  }
  bitmap.close();
}

/**
 * @template {keyof HTMLElementTagNameMap} Name
 * @param {Name} name
 * @param {Partial<HTMLElementTagNameMap[Name]>} properties
 * @returns {HTMLElementTagNameMap[Name]}
 */
function make(name, properties) {
  return Object.assign(document.createElement(name), properties);
}

export default { render };
