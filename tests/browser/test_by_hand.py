"""Driving by hand: a button that is seen, keys that are no chat, a plan without a planner's ranking."""

from __future__ import annotations

from playwright.sync_api import expect

from tests.browser.conftest import Visit
from tests.browser.hands import Road

OVERLAP = """
() => {
  const road = document.querySelector("#road").getBoundingClientRect();
  return [...document.querySelectorAll(".drive-pad, .drive-words, .drive-end")]
    .filter((each) => each.checkVisibility())
    .map((each) => each.getBoundingClientRect())
    .some((box) => box.top < road.bottom && box.bottom > road.top);
}
"""


def test_keys_that_drive_are_no_chat_and_no_change_in_the_log(road: Road) -> None:
    page = road.page
    changes = page.locator(".log-line[data-tone=change]")
    before = changes.count()
    page.get_by_role("button", name="Drive by hand").click()
    expect(page.locator(".drive-pad")).to_be_visible()
    shown = page.locator(".exchange").count()
    tick = page.locator("[data-figure=tick] .figure-value")
    for number in range(1, 4):
        page.keyboard.press("ArrowUp")
        expect(tick).to_have_text(str(number))
    assert page.locator(".exchange").count() == shown
    assert changes.count() == before + 1, "who drives is told once"
    assert road.script.state()["tick"] == 3


def test_the_plan_of_who_drives_shows_free_and_blocked_alone(road: Road) -> None:
    road.put("barrier", road.ahead(1))
    road.page.get_by_role("button", name="Drive by hand").click()
    expect(road.page.locator(".way[data-standing=taken]")).to_have_count(0)
    reasons = road.page.locator(".way-reason")
    expect(reasons.first).to_contain_text("a barrier")
    assert set(reasons.all_inner_texts()[1:]) <= {"free", "off the road"}


def test_pad_and_words_cover_nothing_of_the_road(visit: Visit) -> None:
    for width, height in ((1440, 900), (390, 844)):
        visitor = visit(viewport={"width": width, "height": height})
        visitor.page.get_by_role("button", name="Drive by hand").click()
        expect(visitor.page.locator(".drive-pad")).to_be_visible()
        assert visitor.page.evaluate(OVERLAP) is False


def test_moves_that_wait_are_seen_and_few(visit: Visit) -> None:
    visitor = visit(running=True)
    visitor.script.act(
        {"do": "mode", "mode": "manual"}, {"do": "set", "parameter": "playback_speed", "value": 0.25}
    )
    expect(visitor.page.locator(".drive-pad")).to_be_visible()
    visitor.page.locator("body").click(position={"x": 720, "y": 20})
    for _ in range(9):
        visitor.page.keyboard.press("8")
        visitor.drawn()
    expect(visitor.page.locator(".drive-queue")).to_contain_text("↑")
    assert visitor.page.locator(".drive-queue").inner_text().count("↑") <= 4
