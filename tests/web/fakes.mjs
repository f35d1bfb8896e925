// Stand-ins with the real interfaces: messages as the service sends them, a socket, a clock.

export function wireState(changes = {}) {
  return {
    session: "s1",
    tick: 10,
    time_s: 5,
    episode: 1,
    episode_tick: 10,
    status: "running",
    cause: null,
    columns: 8,
    rows: 30,
    visible_rows: 8,
    step_seconds: 0.5,
    paused: false,
    mode: "auto",
    planner: "priority",
    vehicles: [{ id: "av-1", kind: "av", cell: [4, 20] }],
    movers: [
      { id: "vehicle-1", kind: "vehicle", cell: [2, 19], heading: "right", disabled: false },
      { id: "pedestrian-1", kind: "pedestrian", cell: [6, 10], heading: "left", disabled: false },
    ],
    hazards: [{ id: "pothole-1", kind: "pothole", cell: [3, 15] }],
    metrics: metrics(),
    digest: "d10",
    sequence: 100,
    undo: 0,
    redo: 0,
    ...changes,
  };
}

export function metrics(changes = {}) {
  return {
    episodes: 0,
    successes: 0,
    crashes: 0,
    stuck: 0,
    success_rate: null,
    steps: 10,
    moves: { forward: 9, lateral: 1, diagonal: 0, stay: 0 },
    distance_m: 50,
    last_episode_ticks: null,
    ...changes,
  };
}

export function hello(changes = {}) {
  return {
    type: "hello",
    protocol: 1,
    session: { id: "s1", name: null, paused: false },
    state: wireState(),
    log: [],
    decision: null,
    sequence: 100,
    ...changes,
  };
}

export function tick(changes = {}) {
  return {
    type: "tick",
    tick: 11,
    sequence: 101,
    episode: 1,
    status: "running",
    vehicles: { "av-1": [4, 19] },
    moved: { "vehicle-1": [3, 19] },
    turned: {},
    decision: { tick: 10, move: "forward", reason: "free", causes: [] },
    narration: "Forward: the way is free.",
    events: [],
    metrics: metrics({ steps: 11 }),
    digest: "d11",
    ...changes,
  };
}

export function logEvent(number, changes = {}) {
  return { number, tick: 10, type: "crashed", text: `event ${number}`, ids: [], cell: null, ...changes };
}

/** A WebSocket that a test opens, feeds and breaks. */
export class FakeSocket {
  readyState = 0;
  sent = [];
  onmessage = null;
  onclose = null;

  constructor(url) {
    this.url = url;
  }

  send(text) {
    this.sent.push(JSON.parse(text));
  }

  close() {
    this.readyState = 3;
  }

  receive(message) {
    this.readyState = 1;
    this.onmessage?.({ data: typeof message === "string" ? message : JSON.stringify(message) });
  }

  break() {
    this.readyState = 3;
    this.onclose?.({});
  }
}

/** Timers that go off when the test says so. */
export class FakeClock {
  now = 0;
  #timers = new Map();
  #next = 1;

  later = (work, delayMs) => {
    const id = this.#next++;
    this.#timers.set(id, { at: this.now + delayMs, work });
    return id;
  };

  cancel = (id) => {
    this.#timers.delete(id);
  };

  get waiting() {
    return this.#timers.size;
  }

  pass(ms) {
    const until = this.now + ms;
    for (;;) {
      const due = [...this.#timers].filter(([, { at }]) => at <= until).sort(([, a], [, b]) => a.at - b.at)[0];
      if (!due) break;
      this.#timers.delete(due[0]);
      this.now = due[1].at;
      due[1].work();
    }
    this.now = until;
  }
}

/** Let promises that are already settled run on. */
export const settle = () => new Promise((resolve) => setImmediate(resolve));
