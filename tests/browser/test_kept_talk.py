"""Talk and log are kept: after a reload, in a second tab, in a fork; and answered questions are closed."""

from __future__ import annotations

import re

from playwright.sync_api import expect

from tests.browser.conftest import Visit


def test_talk_and_log_are_there_again_after_a_reload(visit: Visit) -> None:
    visitor = visit()
    page = visitor.page
    visitor.step(4)
    visitor.say("add five potholes")
    visitor.say("why did you do that?")
    visitor.step(3)
    said = page.locator(".exchange .said").all_inner_texts()
    replies = page.locator(".exchange .reply").all_inner_texts()
    assert len(said) == 2
    page.reload()
    visitor.wait_live()
    expect(page.locator(".exchange .said")).to_have_text(said)
    assert page.locator(".exchange .reply").all_inner_texts() == replies
    expect(page.locator(".log-said")).to_contain_text("add five potholes")
    expect(page.locator(".log-line[data-type=tick]").first).to_contain_text("orward")


def test_a_second_tab_and_a_fork_have_the_conversation(visit: Visit) -> None:
    visitor = visit()
    visitor.step(2)
    visitor.say("add a cone in lane 2")
    other = visitor.page.context.new_page()
    other.goto(visitor.page.url)
    expect(other.locator(".exchange .said")).to_have_text(["add a cone in lane 2"])
    visitor.say("add two potholes")
    expect(other.locator(".exchange .said").last).to_have_text("add two potholes")
    other.close()
    visitor.page.locator("#session-menu .menu-button").click()
    visitor.page.locator("#session-menu [data-item=fork]").click()
    expect(visitor.page.locator("#notice")).to_contain_text("independent from here")
    expect(visitor.page.locator(".exchange .said")).to_have_text(["add a cone in lane 2", "add two potholes"])


def test_a_question_that_was_answered_offers_nothing_any_more(visit: Visit) -> None:
    visitor = visit()
    asked = visitor.say("add three")
    expect(asked.locator(".offer").first).to_be_visible()
    first = visitor.page.locator(".exchange").nth(0)
    first.locator(".offer").first.click()
    expect(visitor.page.locator(".exchange").last).to_have_attribute("data-standing", re.compile("done"))
    expect(first.locator(".offer")).to_have_count(0)
