"""The end of an episode: a card that says what happened and what can be done; nothing goes on meanwhile."""

from __future__ import annotations

import re
from typing import Any

import pytest
from playwright.sync_api import expect

from tests.browser.conftest import Visit
from tests.browser.visitor import Visitor
from tests.support.service_process import ServiceProcess

CROWDED: dict[str, Any] = {
    "seed": 16,
    "paused": True,
    "config": {"vehicles": 24, "potholes": 4, "pedestrians": 4, "attentive": 0.0},
}
SHORT: dict[str, Any] = {"seed": 1, "paused": True, "config": {"rows": 12, "vehicles": 0, "potholes": 0}}
APART = """
() => {
  const road = document.querySelector("#road"), card = road.querySelector(".verdict").getBoundingClientRect();
  return import("/src/road/hitTest.js").then(({ viewUnder }) => {
    const { places } = viewUnder(document.querySelector(".road-hands"));
    return (cell) => places.placeOf(cell);
  }).then((placeOf) => {
    const place = placeOf(CELL);
    return place.top >= card.bottom || place.top + place.height <= card.top;
  });
}
"""


def crashed(visit: Visit, service: ServiceProcess, **context: Any) -> Visitor:
    """By hand, straight on, until something is hit."""
    visitor = visit(f"/#/s/{service.session(**CROWDED)}", **context)
    visitor.script.act({"do": "mode", "mode": "manual"})
    for _ in range(60):
        visitor.script.act({"do": "drive", "move": "forward"}, {"do": "step", "ticks": 1})
        if visitor.script.state()["status"] != "running":
            break
    assert visitor.script.state()["status"] == "crash"
    expect(visitor.page.locator(".verdict")).to_be_visible()
    return visitor


@pytest.mark.parametrize("size", [(1440, 900), (390, 844)], ids=["desk", "phone"])
def test_the_card_leaves_the_crash_in_sight(
    visit: Visit, service: ServiceProcess, size: tuple[int, int]
) -> None:
    visitor = crashed(visit, service, viewport={"width": size[0], "height": size[1]})
    visitor.settled()
    cell = visitor.script.state()["cause"]["cell"]
    assert visitor.page.evaluate(APART.replace("CELL", str(cell)))
    expect(visitor.page.locator(".verdict-text")).to_contain_text("Crash with a car")


def test_keys_that_drive_leave_a_crash_as_it_is(visit: Visit, service: ServiceProcess) -> None:
    visitor = crashed(visit, service)
    before = visitor.script.state()
    visitor.page.locator("body").click(position={"x": 720, "y": 20})
    for key in ("ArrowUp", "ArrowLeft", "s", "ArrowUp"):
        visitor.page.keyboard.press(key)
    visitor.drawn()
    visitor.say("why did you crash?")  # answered after whatever the keys have sent
    assert visitor.script.state()["digest"] == before["digest"]
    expect(visitor.page.locator(".verdict")).to_be_visible()


def test_a_crash_is_asked_about_watched_again_and_driven_otherwise(
    visit: Visit, service: ServiceProcess
) -> None:
    visitor = crashed(visit, service)
    page, tick = visitor.page, visitor.script.state()["tick"]
    page.locator("[data-ending=why]").click()
    expect(visitor.last_exchange().locator(".reply")).to_contain_text("I crashed")
    page.locator("[data-ending=saved]").click()
    expect(visitor.last_exchange().locator(".reply")).to_contain_text("moving left would have kept me clear")
    page.locator("[data-ending=watch]").click()
    expect(page.locator("#past")).to_be_visible()
    expect(page.locator(".verdict")).to_be_hidden()
    expect(page.locator("#past")).to_be_hidden()  # it plays up to the present
    expect(page.locator(".verdict")).to_be_visible()
    page.locator("[data-ending=drive]").click()
    visitor.shows(tick - 5)
    state = visitor.script.state()
    assert (state["tick"], state["mode"], state["status"]) == (tick - 5, "manual", "running")


def test_the_clock_stands_at_an_end_until_the_next_road_is_wanted(
    visit: Visit, service: ServiceProcess
) -> None:
    visitor = visit(f"/#/s/{service.session(**SHORT)}")
    page = visitor.page
    page.get_by_role("button", name="Resume").click()
    expect(page.locator(".verdict-title")).to_have_text(re.compile("success", re.IGNORECASE))
    visitor.until("() => document.querySelector('[data-act=clock]').getAttribute('aria-label') === 'Resume'")
    state = visitor.script.state()
    assert (state["status"], state["paused"], state["episode"]) == ("success", True, 1)
    page.locator("[data-ending=next]").click()
    expect(page.locator("[data-figure=episode] .figure-value")).to_have_text("2")
    expect(page.locator(".verdict")).to_be_hidden()
    assert not visitor.script.state()["paused"]


def test_whoever_wishes_has_the_next_road_begin_by_itself(visit: Visit, service: ServiceProcess) -> None:
    visitor = visit(f"/#/s/{service.session(**SHORT)}")
    visitor.script.act({"do": "step", "ticks": 11})
    visitor.page.get_by_label("From now on, go on by itself").check()
    visitor.page.get_by_role("button", name="Resume").click()
    for episode in ("2", "3"):
        expect(visitor.page.locator("[data-figure=episode] .figure-value")).to_have_text(episode)


def test_where_others_watch_only_ones_own_view_stays_at_the_end(
    visit: Visit, service: ServiceProcess
) -> None:
    session = service.session(**SHORT)
    first, second = visit(f"/#/s/{session}"), visit(f"/#/s/{session}")
    for visitor in (first, second):
        expect(visitor.page.locator("[data-figure=tick] .figure-value")).to_have_text("0")
    first.page.get_by_role("button", name="Resume").click()
    expect(first.page.locator("#connection")).to_contain_text("Past")
    expect(first.page.locator(".verdict-title")).to_have_text(re.compile("success", re.IGNORECASE))
    first.until("async (id) => (await (await fetch(`/api/v1/sessions/${id}`)).json()).episode > 1", session)
    assert not first.script.state()["paused"]
    expect(first.page.locator(".verdict")).to_be_visible()
    expect(first.page.locator("[data-figure=episode] .figure-value")).to_have_text("1")
    first.page.locator("[data-ending=next]").click()
    expect(first.page.locator("#connection")).to_contain_text("Live")
    first.script.act({"do": "pause"})


def test_a_stuck_drive_says_what_holds_it_and_what_would_lead_on(
    visit: Visit, service: ServiceProcess
) -> None:
    visitor = visit(f"/#/s/{service.session(**SHORT)}")
    visitor.say("put a barrier in every lane in row 4")
    while visitor.script.state()["status"] == "running":
        visitor.script.act({"do": "step", "ticks": 1})
    expect(visitor.page.locator(".verdict-text")).to_contain_text("Stuck")
    visitor.page.locator("[data-ending=why]").click()
    expect(visitor.last_exchange().locator(".reply").first).to_contain_text("no way led on")
    visitor.page.locator("[data-ending=leads_on]").click()
    expect(visitor.last_exchange().locator(".reply").first).to_contain_text("Without the barrier")


def test_a_drive_that_went_well_is_driven_anew_by_hand_and_its_card_can_be_made_small(
    visit: Visit, service: ServiceProcess
) -> None:
    visitor = visit(f"/#/s/{service.session(**SHORT)}")
    while visitor.script.state()["status"] == "running":
        visitor.script.act({"do": "step", "ticks": 1})
    card = visitor.page.locator(".verdict")
    expect(card).to_contain_text("Next road")
    visitor.page.get_by_role("button", name="Make this card small").click()
    expect(visitor.page.get_by_role("button", name="Next road")).to_be_hidden()
    expect(card).to_contain_text("Success")
    visitor.page.get_by_role("button", name="Show this card").click()
    visitor.page.locator("[data-ending=drive]").click()
    visitor.shows(0)
    state = visitor.script.state()
    assert (state["tick"], state["mode"], state["status"], state["paused"]) == (0, "manual", "running", True)


@pytest.mark.parametrize("way", ["button", "said", "planner"])
def test_whoever_wants_to_drive_at_an_end_drives_again(
    visit: Visit, service: ServiceProcess, way: str
) -> None:
    visitor = visit(f"/#/s/{service.session(**SHORT)}")
    while visitor.script.state()["status"] == "running":
        visitor.script.act({"do": "step", "ticks": 1})
    expect(visitor.page.locator(".verdict")).to_be_visible()
    if way == "button":
        visitor.page.locator("[data-act=manual]").click()
    elif way == "said":
        visitor.say("let me drive")
    else:
        visitor.page.locator("#planner-menu .menu-button").click()
        visitor.page.locator("#planner-menu .menu-item", has_text="arrow keys").click()
    visitor.shows(0)
    expect(visitor.page.locator(".drive-pad")).to_be_visible()
    visitor.page.locator("[data-move=forward]").click()
    visitor.shows(1)
