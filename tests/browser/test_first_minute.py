"""A newcomer's first minute: watch, change the road, ask why, start a new road, be refused."""

from __future__ import annotations

import re

from playwright.sync_api import expect

from tests.browser.conftest import Visit
from tests.browser.visitor import Visitor


def blocked_ahead(visitor: Visitor) -> str:
    """Stop, put a barrier in front of the vehicle, and let it decide once; the barrier's id."""
    visitor.script.act({"do": "pause"}, {"do": "reset"})
    column, row = visitor.script.state()["vehicles"][0]["cell"]
    visitor.script.act(
        {"do": "remove", "kind": "everything", "count": "all"},
        {"do": "add", "kind": "barrier", "count": 1, "where": {"cell": [column, row - 1]}},
        {"do": "step", "ticks": 1},
    )
    (barrier,) = visitor.script.state()["hazards"]
    return str(barrier["id"])


def test_the_road_is_already_moving(visit: Visit) -> None:
    visitor = visit("/")
    assert visitor.session
    before = visitor.tick()
    visitor.until(
        "(before) => document.querySelector('[data-figure=tick] .figure-value').textContent >= before + 3",
        before,
    )


def test_it_glides_from_tick_to_tick(visit: Visit) -> None:
    """A picture of its own in most frames, however many of them a machine shows in a second."""
    visitor = visit(running=True)
    # A service that is kept waiting leaves the road at rest for a while, but not time and again.
    assert any(len(set(visitor.pictures(60))) >= 30 for _ in range(20))


def test_adding_five_potholes(visit: Visit) -> None:
    visitor = visit()
    exchange = visitor.say("add five potholes")
    change = exchange.locator(".change").filter(has_text="potholes")
    before, after = (int(number) for number in re.findall(r"\d+", change.inner_text()))
    assert after == before + 5
    assert re.search(r"potholes \d+ → \d+", change.inner_text())
    assert exchange.locator(".reply").inner_text() != ""
    assert visitor.script.count("pothole") == after
    expect(visitor.page.locator("#road .road-canvas")).to_have_attribute(
        "aria-label", re.compile(f" {after} potholes")
    )
    expect(visitor.page.locator(".log-line[data-tone=change]")).to_contain_text("add five potholes")


def test_what_is_added_is_seen(visit: Visit) -> None:
    visitor = visit().bare()
    visitor.script.act({"do": "pause"}, {"do": "reset"})
    visitor.script.act({"do": "remove", "kind": "everything", "count": "all"})
    expect(visitor.page.locator("#road .road-canvas")).to_have_attribute(
        "aria-label", re.compile("nothing on it")
    )
    settled = visitor.settled()
    assert set(visitor.pictures(20)) == {settled}, "a paused, settled road stands still"
    column, row = visitor.script.state()["vehicles"][0]["cell"]
    visitor.script.act({"do": "add", "kind": "pothole", "count": 1, "where": {"cell": [column, row - 3]}})
    expect(visitor.page.locator("#road .road-canvas")).to_have_attribute(
        "aria-label", re.compile("1 pothole")
    )
    visitor.settled(unlike=settled)


def test_asking_why(visit: Visit) -> None:
    visitor = visit()
    barrier = blocked_ahead(visitor)
    expect(visitor.page.locator(".paused")).to_be_visible()
    answer = visitor.say("why did you do that?").locator(".answer")
    text = answer.locator(".reply").inner_text()
    assert "I moved diagonally left rather than going forward" in text
    assert "a barrier blocked the cell ahead" in text
    assert "Without it I would go forward." in text
    expect(answer.locator(".proof")).to_contain_text("Proved by re-simulation")
    expect(answer.locator(".proof")).to_contain_text("necessary")
    expect(answer.locator(".proof")).to_contain_text("sufficient")
    expect(answer.locator(".cause")).to_contain_text("Barrier")
    expect(answer.locator(".cause")).to_have_attribute("title", re.compile(re.escape(barrier)))
    assert answer.locator(".alternatives li").count() == 5


def test_a_cause_is_shown_on_the_road_with_the_answer_and_when_pointed_at(visit: Visit) -> None:
    visitor = visit().bare()
    blocked_ahead(visitor)
    plain = visitor.settled()
    cause = visitor.say("why did you do that?").locator(".cause").first
    visitor.settled(unlike=plain)
    cause.hover()
    visitor.settled(unlike=plain)
    visitor.page.mouse.move(2, 2)
    visitor.settled(like=plain)
    cause.focus()
    visitor.settled(unlike=plain)


def test_simulating_a_highway(visit: Visit) -> None:
    visitor = visit()
    episode = visitor.script.state()["episode"]
    exchange = visitor.say("simulate a highway with 10 potholes and 2 obstacles")
    assert exchange.get_attribute("data-standing") == "done"
    assert "highway" in exchange.locator(".reply").inner_text()
    state = visitor.script.state()
    assert state["episode"] == episode + 1
    assert visitor.script.count("pothole") == 10
    assert visitor.script.count("vehicle") == 2
    road = visitor.page.locator("#road .road-canvas")
    expect(road).to_have_attribute("aria-label", re.compile(" 10 potholes"))
    expect(road).to_have_attribute("aria-label", re.compile(" 2 cars"))


def test_what_is_not_understood_changes_nothing(visit: Visit) -> None:
    visitor = visit()
    visitor.pause()
    before = visitor.script.state()
    exchange = visitor.say("add five potholes and order pizza")
    assert exchange.get_attribute("data-standing") == "refused"
    assert visitor.script.state() == before
    marked = " ".join(exchange.locator("mark").all_inner_texts())
    assert "pizza" in marked
    assert "potholes" not in marked
    assert "pizza" in exchange.locator(".reply").inner_text()
    offers = exchange.locator(".offer")
    assert offers.count() >= 1
    suggestion = offers.first.inner_text()
    offers.first.click()
    taken = visitor.last_exchange(suggestion)
    assert taken.get_attribute("data-standing") == "done"


def test_the_examples_of_a_first_visit_work(visit: Visit) -> None:
    visitor = visit()
    examples = visitor.page.locator(".example")
    assert examples.count() == 3
    text = examples.first.locator(".example-text").inner_text()
    examples.first.click()
    assert visitor.last_exchange(text).get_attribute("data-standing") == "done"
    expect(visitor.page.locator(".welcome")).to_have_count(0)
