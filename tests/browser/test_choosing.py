"""What is chosen rather than said: who drives, and which family of roads comes next."""

from __future__ import annotations

from itertools import pairwise

import pytest
from playwright.sync_api import expect

from tests.browser.conftest import Visit
from tests.browser.visitor import Visitor

DRIVERS = ["Rules", "Priority rules", "A*", "Dijkstra", "Quickest", "You"]
FAMILIES = ["walls with gaps", "narrow streets", "dead ends", "crossing traffic", "a maze"]


def choose(visitor: Visitor, name: str) -> None:
    """Open the planner's picker and press a name in it."""
    visitor.page.locator("#planner-menu .menu-button").click()
    visitor.page.locator("#planner-menu .menu-item").filter(
        has=visitor.page.get_by_text(name, exact=True)
    ).click()
    expect(visitor.page.locator("#planner-menu .menu-list")).to_be_hidden()


def test_the_planner_is_chosen_from_all_by_name_with_a_line_about_each(visit: Visit) -> None:
    visitor = visit()
    picker = visitor.page.locator("#planner-menu .menu-button")
    expect(picker).to_have_text("Rules")
    picker.click()
    items = visitor.page.locator("#planner-menu [role=menuitemradio]")
    assert [text.splitlines()[0].strip() for text in items.all_inner_texts()] == DRIVERS
    assert all(line.strip() for line in items.locator(".menu-note").all_inner_texts())
    visitor.page.keyboard.press("Escape")
    choose(visitor, "A*")
    expect(visitor.last_exchange("Planner: A*").locator(".reply")).to_contain_text("Rules → A*")
    assert visitor.script.state()["planner"] == "astar"
    visitor.say("let me drive")
    expect(picker).to_have_text("You")
    choose(visitor, "Quickest")
    expect(picker).to_have_text("Quickest")
    expect(visitor.last_exchange("Planner: Quickest").locator(".reply")).to_contain_text("A* → Quickest")
    state = visitor.script.state()
    assert (state["mode"], state["planner"]) == ("auto", "bfs")


@pytest.mark.parametrize("width", [960, 1440])
def test_the_longest_name_of_a_planner_leaves_the_other_figures_their_room(visit: Visit, width: int) -> None:
    visitor = visit(viewport={"width": width, "height": 900})
    choose(visitor, "Priority rules")
    expect(visitor.page.locator("#planner-menu .menu-button")).to_have_text("Priority rules")
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
