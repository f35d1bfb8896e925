"""The gallery of roads: each has a picture and words, and opens as a session of its own by a press or by its address."""

from __future__ import annotations

import re

from playwright.sync_api import expect

from tests.browser.conftest import Visit
from tests.support.axe import violations

LIVE_ELSEWHERE = "(id) => { const at = location.hash; return at.startsWith('#/s/') && !at.includes(id); }"


def test_every_scenario_has_a_picture_and_words(visit: Visit) -> None:
    visitor = visit(reduced_motion="reduce")
    visitor.page.locator("#session-menu .menu-button").click()
    visitor.page.locator("#session-menu [data-item=gallery]").click()
    cards = visitor.page.locator("#gallery .gallery-card")
    expect(cards).to_have_count(9)
    for text in cards.all_inner_texts():
        name, about, why = [line for line in text.splitlines() if line.strip()]
        assert len({name, about, why}) == 3
        assert not re.search(r"gallery\.\w", text)
    assert violations(visitor) == []


def test_a_scenario_opens_with_one_press(visit: Visit) -> None:
    visitor = visit()
    before = visitor.session
    visitor.page.get_by_role("button", name="Scenarios…").click()
    visitor.page.locator("[data-scenario=maze]").click()
    visitor.until(LIVE_ELSEWHERE, before)
    visitor.wait_live()
    assert visitor.script.count("barrier") > 50
    assert visitor.script.state()["planner"] == "astar"


def test_a_scenario_has_an_address(visit: Visit) -> None:
    visitor = visit("/#/g/dead_ends")
    assert visitor.script.state()["planner"] == "priority"
    assert visitor.page.evaluate("location.hash").startswith("#/s/")
