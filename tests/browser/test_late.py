"""Answers that come late: whoever has gone on meanwhile is left where they are."""

from __future__ import annotations

import re

from playwright.sync_api import expect

from tests.browser.conftest import STANDING, Visit
from tests.browser.held import Held
from tests.browser.visitor import Visitor
from tests.browser.walking import TICKS, figure
from tests.support.service_process import ServiceProcess


def gone_elsewhere(visitor: Visitor, session: str) -> None:
    visitor.page.evaluate("(id) => { location.hash = `#/s/${id}`; }", session)
    visitor.until("(id) => location.hash.includes(id)", session)
    visitor.wait_live()


def test_a_new_session_takes_nobody_away_from_where_they_have_gone(
    visit: Visit, service: ServiceProcess
) -> None:
    visitor, other = visit(), service.session(**STANDING)
    held = Held(visitor, r"/api/v1/sessions$")
    visitor.page.get_by_role("button", name="New session").click()
    held.asked()
    gone_elsewhere(visitor, other)
    held.let_go()
    assert visitor.session == other


def test_a_fork_takes_nobody_away_either_and_is_offered(visit: Visit, service: ServiceProcess) -> None:
    visitor, other = visit(), service.session(**STANDING)
    visitor.step(3)
    held = Held(visitor, r"/forks$")
    visitor.page.locator("body").click(position={"x": 2, "y": 2})
    visitor.page.keyboard.press("f")
    held.asked()
    gone_elsewhere(visitor, other)
    held.let_go()
    expect(visitor.page.locator(".notice-box")).to_contain_text("was forked at tick 3")
    assert visitor.session == other
    visitor.page.locator(".notice-box").get_by_role("button", name="Open").click()
    expect(visitor.page).not_to_have_url(re.compile(other))
    visitor.wait_live()
    visitor.shows(3)


def test_a_comparison_that_comes_late_takes_the_focus_from_nobody(visit: Visit) -> None:
    visitor = visit()
    visitor.step(3)
    expect(visitor.page.locator(".panel-note").first).to_have_text("next, at tick 3")
    held = Held(visitor, r"/counterfactual$")
    visitor.page.locator(".way[data-standing=free]").first.click()
    expect(visitor.page.locator("#beside")).to_be_visible()
    held.asked()
    visitor.words.focus()
    visitor.page.keyboard.type("add f")
    held.let_go()
    expect(visitor.page.locator("#beside [data-side=changed] .beside-end")).not_to_be_empty()
    expect(visitor.words).to_be_focused()
    visitor.page.keyboard.type("our")
    expect(visitor.words).to_have_value("add four")


def test_a_jump_waits_for_the_part_of_the_run_that_is_not_known_yet(visit: Visit) -> None:
    visitor = visit()
    visitor.say("set the number of cars to 14")
    visitor.script.act({"do": "step", "ticks": TICKS})
    visitor.shows(TICKS)
    held = Held(visitor, r"/changes\?", method="GET")
    visitor.page.reload()
    held.asked()
    visitor.wait_live()
    jumps = visitor.page.get_by_role("combobox", name="Jump between")
    jumps.select_option("command")
    visitor.page.get_by_role("button", name="Previous event").click()
    visitor.drawn()
    expect(figure(visitor)).to_have_text(str(TICKS))
    expect(visitor.page.locator(".notice-box")).to_be_hidden()
    held.let_go()
    expect(figure(visitor)).to_have_text("0")


def test_the_moves_are_told_once_they_are_known(visit: Visit) -> None:
    """Before that there are none, rather than buttons without a name."""
    visitor = visit()
    held = Held(visitor, r"/forecast\?", method="GET")
    visitor.page.reload()
    held.asked()
    visitor.wait_live()
    ways = visitor.page.get_by_role("list", name="The six moves")
    expect(ways).to_be_hidden()
    held.let_go()
    expect(ways.get_by_role("button", name="Forward", exact=False).first).to_be_visible()
