"""The settings' drawer: each change is said as a sentence, and the service understands it."""

from __future__ import annotations

from typing import Any

import pytest
from playwright.sync_api import expect

from tests.browser.conftest import Visit
from tests.browser.visitor import Visitor
from tests.support.axe import FAINT_TEXT

MOVE = """
([name, value]) => {
  const slider = document.querySelector(`[data-setting=${name}]`);
  slider.value = value;
  for (const kind of ["input", "change"]) slider.dispatchEvent(new Event(kind, { bubbles: true }));
}
"""
WISHES: dict[str, tuple[str, Any]] = {
    "pothole": ("7", 7),
    "vehicle": ("12", 12),
    "pedestrian": ("3", 3),
    "courtesy": ("0.4", 0.4),
    "attentive": ("0.5", 0.5),
    "pace": ("4", 4),
}


def now(visitor: Visitor, name: str) -> Any:
    """What the service has for a slider."""
    if name in ("pothole", "vehicle", "pedestrian"):
        return visitor.script.count(name)
    if name == "pace":
        return visitor.script.state()["playback_speed"]
    answer = visitor.page.request.get(f"{visitor.url}/api/v1/sessions/{visitor.session}")
    return answer.json()["config"][name]


@pytest.mark.parametrize("locale", ["en-GB", "de-DE"])
def test_every_slider_says_a_sentence_that_does_it(visit: Visit, locale: str) -> None:
    visitor = visit("/", locale=locale)
    visitor.script.act({"do": "pause"})
    visitor.page.locator("#settings-button").click()
    drawer = visitor.page.locator("#settings")
    expect(drawer.locator("input[type=range]")).to_have_count(len(WISHES))
    for name, (value, wanted) in WISHES.items():
        before = visitor.page.locator(".exchange").count()
        visitor.page.evaluate(MOVE, [name, value])
        said = drawer.locator(f".setting:has([data-setting={name}]) .setting-said")
        expect(visitor.page.locator(".exchange")).to_have_count(before + 1)
        exchange = visitor.last_exchange()
        assert exchange.get_attribute("data-standing") == "done", (name, exchange.inner_text())
        assert exchange.locator(".said").inner_text() in said.inner_text()
        assert now(visitor, name) == wanted


def test_the_drawer_has_a_legend_and_leaves_the_talk_in_sight(visit: Visit) -> None:
    visitor = visit()
    visitor.page.locator("body").click(position={"x": 720, "y": 20})
    visitor.page.keyboard.press("o")
    drawer = visitor.page.locator("#settings")
    expect(drawer.locator(".legend li")).to_have_count(9)
    left, right = drawer.bounding_box(), visitor.page.locator(".talk-panel").bounding_box()
    assert left is not None
    assert right is not None
    assert left["x"] + left["width"] <= right["x"]
    visitor.coloured()
    assert visitor.page.evaluate(FAINT_TEXT) == []
    visitor.page.keyboard.press("o")
    expect(drawer).to_be_hidden()
