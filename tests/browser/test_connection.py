"""Losing the service, finding no session, losing the session."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import expect

from tests.browser.conftest import Visit
from tests.support.service_process import ServiceProcess


@pytest.fixture(scope="module")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ServiceProcess]:
    """One of this module's own, since it is killed."""
    process = ServiceProcess(tmp_path_factory.mktemp("service") / "roadtalk.db")
    process.start()
    yield process
    process.kill()


def test_a_killed_service_leaves_a_stale_page_that_comes_back(service: ServiceProcess, visit: Visit) -> None:
    visitor = visit(running=True)
    session = visitor.session
    visitor.say("add five potholes")
    potholes = visitor.script.count("pothole")
    badge = visitor.page.locator("#connection")
    service.kill()
    expect(badge).to_have_attribute("data-phase", "lost")
    expect(badge).to_contain_text(re.compile(r"Stale since tick \d+"))
    expect(visitor.page.locator("body")).to_have_class(re.compile("stale"))
    exchange = visitor.say("add three potholes")
    expect(exchange).to_contain_text("not sent")
    service.start()
    visitor.wait_live()
    assert visitor.session == session
    expect(visitor.page.locator("body")).not_to_have_class(re.compile("stale"))
    assert visitor.script.count("pothole") == potholes
    # A session comes back paused where it was, so that nothing happens unseen.
    expect(visitor.page.locator(".paused")).to_be_visible()
    tick = visitor.tick()
    visitor.page.get_by_role("button", name="Resume").click()
    expect(visitor.page.locator("[data-figure=tick] .figure-value")).not_to_have_text(str(tick))
    visitor.words.press("ArrowUp")
    expect(visitor.words).to_have_value("add three potholes")
    visitor.words.press("Enter")
    # The same words once more: the exchange before them, which was not sent, is settled already.
    expect(visitor.page.locator(".exchange")).to_have_count(3)
    visitor.last_exchange("add three potholes")
    assert visitor.script.count("pothole") == potholes + 3
    # What a browser itself says about a refused connection is no fault of the page's.
    visitor.forgive("net::ERR_")


def test_an_unknown_session_is_said_and_a_new_one_offered(visit: Visit) -> None:
    visitor = visit("/#/s/no-such-session", live=False)
    over = visitor.page.locator(".verdict")
    expect(over).to_contain_text("no session at this address")
    visitor.page.get_by_role("button", name="Start a new session").click()
    visitor.wait_live()
    assert visitor.session != "no-such-session"
    expect(over).to_be_hidden()
    visitor.forgive("404")


def test_a_deleted_session_is_said(visit: Visit) -> None:
    visitor = visit()
    visitor.script.delete()
    expect(visitor.page.locator(".verdict")).to_contain_text("deleted")
    expect(visitor.page.locator("#connection")).to_contain_text("Ended")


def test_a_link_leads_to_the_same_road_and_new_session_to_another(visit: Visit) -> None:
    first = visit()
    first.pause()
    second = visit(f"/#/s/{first.session}")
    assert second.session == first.session
    expect(second.page.locator(".paused")).to_be_visible()
    old = second.session
    second.page.get_by_role("button", name="New session").click()
    expect(second.page).not_to_have_url(re.compile(old))
    second.wait_live()
    expect(second.page.locator(".paused")).to_be_hidden()


def test_without_the_service_every_part_says_so_and_goes_on_after(
    service: ServiceProcess, visit: Visit
) -> None:
    visitor = visit()
    page = visitor.page
    visitor.pause()
    for _ in range(6):
        visitor.step()
    figure = page.locator("[data-figure=tick] .figure-value")
    tick = visitor.tick()
    rejected = page.locator("#plan .way[data-standing=blocked], #plan .way[data-standing=free]").first
    expect(rejected).to_be_visible()  # the next decision is known
    session = visitor.session
    service.kill()
    expect(page.locator("#connection")).to_have_attribute("data-phase", "lost")
    told = page.locator("#notice, .road-toast, [role=alert], .past-trouble")
    # What would have been: asked of the service, which is not there.
    rejected.click()
    expect(page.locator("#beside, #notice").get_by_text(re.compile("reach|fetch")).first).to_be_visible()
    page.keyboard.press("Escape")
    # A new session.
    page.get_by_role("button", name="New session").click()
    expect(page.get_by_text(re.compile("cannot be reached")).first).to_be_visible()
    # A menu opens all the same, and what it cannot do is said.
    page.get_by_role("button", name="Session", exact=True).click()
    page.get_by_role("menuitem", name=re.compile("link", re.IGNORECASE)).first.click()
    expect(told.get_by_text(re.compile("reach|fetch|Failed")).first).to_be_visible()
    page.keyboard.press("Escape")
    # Help tells keys and choices, and that the rest is not known.
    page.locator("#help").click()
    expect(page.get_by_role("dialog").get_by_text("Keys", exact=True)).to_be_visible()
    expect(page.get_by_role("dialog").get_by_role("alert")).to_contain_text("not known just now")
    page.keyboard.press("Escape")
    service.start()
    visitor.wait_live()
    assert visitor.session == session
    expect(figure).to_have_text(str(tick))
    expect(page.locator(".verdict")).to_be_hidden()
    page.keyboard.press("ArrowRight")
    expect(figure).to_have_text(str(tick + 1))
    visitor.forgive("net::ERR_")
