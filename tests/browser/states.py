"""Every state of the page and how a visitor comes to it: for pictures, and for what holds in all of them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from playwright.sync_api import expect

from tests.browser.visitor import Visitor

EMPTY: dict[str, Any] = {"seed": 9, "paused": True}
LONG: dict[str, Any] = {"seed": 9, "paused": True, "config": {"rows": 400}}
SHORT: dict[str, Any] = {"seed": 1, "paused": True, "config": {"rows": 12, "vehicles": 0, "potholes": 0}}
CROWDED: dict[str, Any] = {
    "seed": 16,
    "paused": True,
    "config": {"vehicles": 24, "potholes": 4, "pedestrians": 4, "attentive": 0.0},
}
JUDGED: dict[str, Any] = {"seed": 9, "paused": True, "config": {"rows": 60}}
WIDE: dict[str, Any] = {"seed": 9, "paused": True, "config": {"columns": 12, "rows": 80, "vehicles": 30}}

Arrange = Callable[[Visitor], Any]


def nothing(visitor: Visitor) -> None:
    """As it is opened."""


def running(visitor: Visitor) -> None:
    """On its way."""
    visitor.step(12)
    visitor.script.act({"do": "resume"})
    expect(visitor.page.locator(".paused")).to_be_hidden()


def talked(visitor: Visitor) -> None:
    """A change, a refusal and a question answered."""
    visitor.step(9)
    for said in ("add five potholes", "paint the road purple", "why did you do that?"):
        visitor.say(said)


def choices(visitor: Visitor) -> None:
    """A question in free words that is near to several."""
    visitor.step(9)
    visitor.say("so is it gonna move again or is that it")


def completing(visitor: Visitor) -> None:
    """Sentences are offered for what stands in the box."""
    visitor.typed("add fi")


def past(visitor: Visitor) -> None:
    """Looking at an earlier tick."""
    visitor.step(40)
    visitor.page.evaluate("async () => (await import('/src/main.js')).page.timeTravel.at(12)")
    expect(visitor.page.locator("#past")).to_be_visible()


def crash(visitor: Visitor) -> None:
    """By hand, straight on, into somebody."""
    visitor.script.act({"do": "mode", "mode": "manual"})
    for _ in range(60):
        visitor.script.act({"do": "drive", "move": "forward"}, {"do": "step", "ticks": 1})
        if visitor.script.state()["status"] != "running":
            break
    expect(visitor.page.locator(".verdict")).to_be_visible()


def arrived(visitor: Visitor) -> None:
    """At the goal."""
    visitor.script.act({"do": "step", "ticks": 11})
    expect(visitor.page.locator(".verdict")).to_be_visible()


def by_hand(visitor: Visitor) -> None:
    """The person drives, with moves that wait."""
    visitor.step(5)
    visitor.script.act({"do": "mode", "mode": "manual"})
    visitor.script.act({"do": "drive", "move": "forward"})
    visitor.until("() => document.querySelector('.drive-pad')?.checkVisibility()")


def act(name: str, seen: str, ticks: int = 9) -> Arrange:
    """Something the page does by itself, by its name among the commands; `seen` is what comes of it."""

    def arrange(visitor: Visitor) -> None:
        visitor.step(ticks)
        visitor.page.evaluate(ACT, name)
        expect(visitor.page.locator(seen).first).to_be_visible()

    return arrange


ACT = """
async (name) => {
  const { page } = await import("/src/main.js");
  const { runCommand } = await import("/src/core/commands.js");
  for (let tries = 0; tries < 200; tries += 1) {
    const found = page.commands().find((command) => command.name === name);
    if (found) return void runCommand(found, page);
    await new Promise((done) => setTimeout(done, 25));
  }
  throw new Error(`no act ${name}`);
}
"""


def evaluation(visitor: Visitor) -> None:
    """The report of an evaluation, in place of the page."""
    request, url = visitor.page.request, visitor.url
    wish = {"runs": 20, "planners": ["rules", "astar"]}
    own = url + request.post(f"{url}/api/v1/evaluations", data=wish).json()["links"]["self"]
    while (told := request.get(own).json())["state"] not in ("done", "failed"):
        visitor.page.wait_for_timeout(500)
    visitor.page.goto(url + told["links"]["report"])


STATES: dict[str, tuple[dict[str, Any], Arrange]] = {
    "start": (EMPTY, nothing),
    "running": (LONG, running),
    "wide-road": (WIDE, running),
    "talked": (EMPTY, talked),
    "choices": (EMPTY, choices),
    "completing": (EMPTY, completing),
    "past": (LONG, past),
    "crash": (CROWDED, crash),
    "arrived": (SHORT, arrived),
    "by-hand": (LONG, by_hand),
    "perspective": (LONG, act("view-perspective", "#road .road-canvas")),
    "settings": (EMPTY, act("settings", "#settings input")),
    "plan": (EMPTY, act("enlarge-plan", ".plan-panel.large")),
    "occupancy": (EMPTY, act("enlarge-occupancy", ".occupancy-panel.large")),
    "metrics": (JUDGED, act("enlarge-metrics", ".metrics-panel.large", 40)),
    "log": (LONG, act("enlarge-log", ".log-panel.large", 40)),
    "strip": (JUDGED, act("view-strip", "#strip canvas", 40)),
    "gallery": (EMPTY, act("gallery", "#gallery .gallery-card")),
    "sessions": (EMPTY, act("sessions", "dialog[open]")),
    "planners": (CROWDED, act("compare-planners", "#beside [data-part]", 20)),
    "quiz": (EMPTY, act("quiz", "dialog[open] input")),
    "tour": (EMPTY, act("tour", "#tour")),
    "palette": (EMPTY, act("palette", "#palette [role=option]")),
    "help": (EMPTY, act("help", "#help-dialog[open]")),
    "video": (LONG, act("video", "dialog[open]", 20)),
    "evaluation": (EMPTY, evaluation),
}
"""A session's wishes, and how a visitor comes to the state on it."""
