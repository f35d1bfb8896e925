"""The tour: five stops, each lets the person do the thing; it can be skipped. And the worst moments of a run."""

from __future__ import annotations

import re

from playwright.sync_api import expect

from tests.browser.conftest import Visit
from tests.support.axe import violations


def test_every_stop_lets_the_person_do_the_thing(visit: Visit) -> None:
    visitor = visit(reduced_motion="reduce")
    visitor.step(4)
    page = visitor.page
    page.get_by_role("button", name="Take the tour").click()
    card = page.locator("#tour")
    assert violations(visitor) == []
    potholes = visitor.script.count("pothole")
    for number in range(1, 6):
        expect(card.locator(".tour-count")).to_have_text(f"Stop {number} of 5")
        card.locator("[data-tour=do]").click()
        expect(card.locator("[data-tour=do]")).to_have_count(0)
        if number == 1:
            expect(page.locator(".paused")).to_be_hidden()
            visitor.script.act({"do": "pause"})
        elif number == 2:
            visitor.last_exchange()
            assert visitor.script.count("pothole") == potholes + 5
        elif number == 3:
            expect(visitor.last_exchange().locator(".answer")).to_be_visible()
        elif number == 4:
            expect(page.locator("#connection")).to_contain_text("Past · tick 0")
        card.locator("[data-tour=next]").click()
    expect(card).to_be_hidden()
    visitor.until("() => document.querySelector('.drive-pad')?.checkVisibility()")
    assert visitor.script.state()["mode"] == "manual"


def test_the_tour_can_be_skipped_at_once(visit: Visit) -> None:
    visitor = visit()
    visitor.say("take the tour")
    expect(visitor.page.locator("#tour")).to_be_visible()
    visitor.page.locator("[data-tour=skip]").click()
    expect(visitor.page.locator("#tour")).to_be_hidden()
    expect(visitor.page.locator(".tour-spot")).to_have_count(0)


def test_the_worst_moments_are_listed_and_lead_there(visit: Visit) -> None:
    visitor = visit()
    visitor.step(20)
    visitor.page.locator("[data-enlarge=metrics]").click()
    worst = visitor.page.locator(".worst-moment")
    expect(worst.first).to_contain_text(re.compile(r"Tick \d+: \d of 6 moves blocked, \d+ ticks? lost"))
    tick = worst.first.get_attribute("data-worst")
    worst.first.click()
    expect(visitor.page.locator("#connection")).to_contain_text(f"Past · tick {tick}")
