"""A run that has a past, and the ways of the page through it."""

from __future__ import annotations

import re
from typing import Any

from playwright.sync_api import Locator, expect

from tests.browser.visitor import Visitor

TICKS = 120


def began(visitor: Visitor) -> None:
    visitor.pause()
    now = visitor.script.state()["tick"]
    visitor.script.act({"do": "step", "ticks": 40 - now})
    visitor.say("set the number of cars to 14")
    visitor.script.act({"do": "step", "ticks": TICKS - 40})
    expect(figure(visitor)).to_have_text(str(TICKS))
    expect(slider(visitor)).to_have_attribute("aria-valuenow", str(TICKS))


def slider(visitor: Visitor) -> Locator:
    return visitor.page.get_by_role("slider", name="The run so far")


def figure(visitor: Visitor) -> Locator:
    return visitor.page.locator("[data-figure=tick] .figure-value")


def bar(visitor: Visitor) -> Locator:
    return visitor.page.get_by_role("group", name="The past")


def look(visitor: Visitor, tick: int) -> None:
    """By keys from the start, as one who counts."""
    slider(visitor).focus()
    visitor.page.keyboard.press("Home")
    for _ in range(tick // 10):
        visitor.page.keyboard.press("PageUp")
    for _ in range(tick % 10):
        visitor.page.keyboard.press("ArrowRight")
    expect(figure(visitor)).to_have_text(str(tick))


def world(visitor: Visitor, tick: int) -> dict[str, Any]:
    path = f"{visitor.url}/api/v1/sessions/{visitor.session}/state?tick={tick}"
    told: dict[str, Any] = visitor.page.request.get(path).json()
    return told


def choose(visitor: Visitor, name: str | re.Pattern[str]) -> None:
    """From the session's menu."""
    visitor.page.get_by_role("button", name="Session", exact=True).click()
    visitor.page.get_by_role("menuitem", name=name).click()
