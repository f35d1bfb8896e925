"""Every act of the page, by key, menu or button, can be said by its name and by its phrases."""

from __future__ import annotations

from typing import Any

import pytest
from playwright.sync_api import expect

from tests.browser.conftest import Visit
from tests.browser.visitor import Visitor

ACTS = """
async () => {
  const { spokenAct, phrasesOf } = await import("/src/core/spoken.js");
  const { page } = await import("/src/main.js");
  const state = page.state();
  const commands = page.commands();
  const acts = commands.map((act) => ({ name: act.name, doing: act.now(state), phrases: phrasesOf(act) }))
    .map(({ name, doing, phrases }) => ({
      name, label: doing?.label ?? null, service: (doing?.turns ?? []).length > 0 && !doing.run,
      unheard: doing === null ? [] : [doing.label, ...phrases].filter((said) => {
        const found = spokenAct(said, commands, state);
        return found === null || found.doing.label !== doing.label;
      }),
    }));
  const named = new Set(commands.map(({ name }) => name));
  const table = Object.keys(await globalThis.pageTexts).filter((key) => key.startsWith("acts."));
  return { acts, strange: table.map((key) => key.slice(5)).filter((name) => !named.has(name)) };
}
"""
OF_THE_SERVICE = {"clock", "pause", "step", "undo"}
"""Acts that the service understands by itself."""


def acts_of(visitor: Visitor) -> dict[str, Any]:
    found: dict[str, Any] = visitor.page.evaluate(ACTS)
    return found


@pytest.mark.parametrize("locale", ["en-GB", "de-DE"])
def test_every_act_is_heard_by_its_name_and_by_each_of_its_phrases(visit: Visit, locale: str) -> None:
    visitor = visit(locale=locale)
    visitor.step(3)
    found = acts_of(visitor)
    acts = {act["name"]: act for act in found["acts"]}
    print(f"{len(acts)} acts, {sum(act['label'] is not None for act in acts.values())} of them now")
    assert len(acts) > 60
    assert found["strange"] == [], "phrases of acts that there are not"
    unheard = {
        name: act["unheard"] for name, act in acts.items() if act["unheard"] and name not in OF_THE_SERVICE
    }
    assert unheard == {}


@pytest.mark.parametrize("said", ["Pause", "Resume", "Step", "Undo", "Restart road"])
def test_the_names_of_the_clock_are_understood_by_the_service(visit: Visit, said: str) -> None:
    visitor = visit()
    visitor.say("add five potholes")
    if said == "Pause":
        visitor.script.act({"do": "resume"})
    assert visitor.say(said).get_attribute("data-standing") == "done"


def test_what_the_page_does_by_itself_is_done_and_answered(visit: Visit) -> None:
    visitor = visit(color_scheme="light")
    page = visitor.page
    visitor.say("dark mode")
    expect(page.locator("html")).to_have_attribute("data-theme", "dark")
    visitor.say("enlarge the plan")
    expect(page.locator(".plan-panel.large")).to_be_visible()
    visitor.say("put the plan back")
    expect(page.locator(".plan-panel.large")).to_have_count(0)
    visitor.say("bounding boxes")
    expect(page.locator(".exchange").last.locator(".reply")).to_have_text("Show the bounding boxes")
    visitor.say("Max speed!")
    assert visitor.script.state()["playback_speed"] == "max"
    visitor.say("planner: quickest")
    assert visitor.script.state()["planner"] == "bfs"
    visitor.say("rewind to tick 0")
    session = visitor.session
    visitor.words.fill("new session")
    visitor.words.press("Enter")
    visitor.until(f"() => !location.hash.includes({session!r})")
    visitor.wait_live()


def test_what_is_quiet_takes_no_cars_away(visit: Visit) -> None:
    visitor = visit()
    before = visitor.script.count("vehicle")
    visitor.say("quiet")
    assert visitor.script.count("vehicle") == before
