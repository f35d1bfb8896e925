"""What is chosen rather than said: who drives, and which family of roads comes next."""

from __future__ import annotations

from itertools import pairwise

import pytest
from playwright.sync_api import expect

from tests.browser.conftest import Visit

DRIVERS = ["Rules", "Priority rules of the source", "A*", "Dijkstra", "Quickest", "You"]
FAMILIES = ["walls with gaps", "narrow streets", "dead ends", "crossing traffic", "a maze"]


def test_the_driver_is_chosen_from_all_planners_by_name(visit: Visit) -> None:
    visitor = visit()
    driver = visitor.page.get_by_role("combobox", name="Driver")
    expect(driver.locator("option")).to_have_text(DRIVERS)
    expect(driver).to_have_value("rules")
    driver.select_option("A*")
    expect(visitor.last_exchange("Driver: A*").locator(".reply")).to_contain_text("Rules → A*")
    assert visitor.script.state()["planner"] == "astar"
    visitor.say("let me drive")
    expect(driver).to_have_value("manual")
    driver.select_option("Quickest")
    expect(driver).to_have_value("bfs")
    expect(visitor.last_exchange("Driver: Quickest").locator(".reply")).to_contain_text("A* → Quickest")
    state = visitor.script.state()
    assert (state["mode"], state["planner"]) == ("auto", "bfs")


@pytest.mark.parametrize("width", [960, 1440])
def test_the_longest_name_of_a_driver_leaves_the_other_figures_their_room(visit: Visit, width: int) -> None:
    visitor = visit(viewport={"width": width, "height": 900})
    visitor.page.get_by_role("combobox", name="Driver").select_option("Priority rules of the source")
    expect(visitor.page.get_by_role("combobox", name="Driver")).to_have_value("priority")
    # All boxes are read at once: between two questions the page may be laid out anew.
    ends = visitor.page.locator(".status .figure").evaluate_all(
        "figures => figures.map(f => f.getBoundingClientRect()).map(box => [box.left, box.right])"
    )
    assert len(ends) == 6
    assert all(end <= begin + 0.5 for (_, end), (begin, _) in pairwise(ends))
    within = visitor.page.locator(".status").bounding_box()
    assert within is not None
    assert ends[-1][1] <= within["x"] + within["width"] + 0.5


def test_every_family_of_roads_is_a_press_away_at_first(visit: Visit) -> None:
    visitor = visit()
    families = visitor.page.locator(".family")
    expect(families).to_have_text(FAMILIES)
    episode = visitor.script.state()["episode"]
    families.last.click()
    reply = visitor.last_exchange("a maze").locator(".reply")
    expect(reply).to_contain_text("A new road: a maze")
    assert visitor.script.state()["episode"] == episode + 1
    assert visitor.script.count("barrier") > 50


@pytest.mark.parametrize("family", FAMILIES)
def test_every_family_of_roads_is_in_the_palette(visit: Visit, family: str) -> None:
    visitor = visit()
    episode = visitor.script.state()["episode"]
    visitor.page.keyboard.press("Control+k")
    visitor.page.keyboard.type(family)
    found = visitor.page.locator("#palette").get_by_role("option", selected=True)
    expect(found).to_have_text(f"New road: {family}")
    visitor.page.keyboard.press("Enter")
    expect(visitor.page.locator("[data-figure=episode] .figure-value")).to_have_text(str(episode + 1))
