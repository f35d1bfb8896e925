"""The command box and the conversation: history, corrections, undo, help, the log."""

from __future__ import annotations

import re

from playwright.sync_api import expect

from tests.browser.conftest import Visit


def test_what_was_said_comes_back_with_the_arrow_keys(visit: Visit) -> None:
    visitor = visit()
    visitor.say("add two potholes")
    visitor.say("add a barrier")
    box = visitor.words
    box.fill("half a")
    box.press("ArrowUp")
    expect(box).to_have_value("add a barrier")
    box.press("ArrowUp")
    expect(box).to_have_value("add two potholes")
    box.press("ArrowUp")
    expect(box).to_have_value("add two potholes")
    box.press("ArrowDown")
    box.press("ArrowDown")
    expect(box).to_have_value("half a")
    box.press("Escape")
    expect(box).to_have_value("")
    expect(box).to_be_focused()
    visitor.page.reload()
    visitor.wait_live()
    box.press("ArrowUp")
    expect(box).to_have_value("add a barrier")


def test_a_typing_error_is_read_and_said_so(visit: Visit) -> None:
    visitor = visit()
    exchange = visitor.say("add five potholse")
    assert exchange.get_attribute("data-standing") == "done"
    expect(exchange.locator(".correction")).to_have_text(re.compile("Read “potholse” as “potholes?”"))


def test_a_question_back_offers_choices(visit: Visit) -> None:
    visitor = visit()
    exchange = visitor.say("more cars")
    assert exchange.get_attribute("data-standing") == "asked"
    choices = exchange.get_by_role("group", name="Choices").get_by_role("button")
    assert choices.count() >= 2
    wanted = choices.first.inner_text()
    choices.first.click()
    visitor.last_exchange(wanted)


def test_undo_stands_next_to_every_change(visit: Visit) -> None:
    visitor = visit()
    before = visitor.script.count("pothole")
    visitor.say("add two potholes")
    visitor.say("add three potholes")
    latest = visitor.say("add one pothole")
    latest.get_by_role("button", name="Undo").click()
    expect(visitor.page.locator("#road .road-canvas")).to_have_attribute(
        "aria-label", re.compile(f"{before + 5} potholes")
    )
    first = visitor.page.locator(".exchange").filter(has_text="add two potholes").first
    expect(first.get_by_role("button")).to_have_text("Undo this and the one after")
    first.get_by_role("button").click()
    expect(first.locator(".change-taken")).to_have_text("taken back")
    assert visitor.script.count("pothole") == before


def test_an_older_change_counts_what_others_did_since(visit: Visit) -> None:
    visitor = visit()
    before = visitor.script.count("pothole")
    visitor.say("add two potholes")
    exchange = visitor.page.locator(".exchange").filter(has_text="add two potholes")
    visitor.script.act({"do": "add", "kind": "pothole", "count": 1})
    visitor.script.act({"do": "pause"})
    button = exchange.get_by_role("button", name="Undo")
    expect(button).to_have_text("Undo this and the one after")
    button.click()
    expect(exchange.locator(".change-taken")).to_be_visible()
    assert visitor.script.count("pothole") == before


def test_text_is_shown_as_text(visit: Visit) -> None:
    visitor = visit()
    said = "<img src=x onerror=alert(1)> **bold**"
    exchange = visitor.say(said)
    expect(exchange.locator(".said")).to_have_text(said)
    assert exchange.locator("img").count() == 0


def test_over_long_text_is_refused_in_words(visit: Visit) -> None:
    visitor = visit()
    exchange = visitor.say("potholes " * 150)
    assert exchange.get_attribute("data-standing") == "refused"
    assert exchange.locator(".reply").inner_text() != ""
    # Where typing and sending are apart, completions were asked for and refused: the browser's own line.
    visitor.forgive("422")


def test_an_unavailable_wish_is_refused_saying_so(visit: Visit) -> None:
    visitor = visit()
    exchange = visitor.say("find the hardest scenario for DWA")
    assert exchange.get_attribute("data-standing") == "refused"
    expect(exchange.locator(".reply")).to_contain_text("not available yet")


def test_the_log_tells_ticks_quietly_and_follows_until_scrolled(visit: Visit) -> None:
    visitor = visit(viewport={"width": 1100, "height": 600})
    visitor.script.act({"do": "pause"})
    for _ in range(50):
        visitor.script.act({"do": "step", "ticks": 3})
    lines = visitor.page.locator(".log-lines")
    visitor.shows(150)
    expect(visitor.page.locator(".log-line").nth(30)).to_be_attached()
    at_end = "(list) => list.scrollHeight - list.scrollTop - list.clientHeight < 2"
    visitor.until(f"() => ({at_end})(document.querySelector('.log-lines'))")
    lines.evaluate("(list) => { list.scrollTop = 0; }")
    newest = visitor.page.get_by_role("button", name="Newest")
    expect(newest).to_be_visible()
    visitor.step(3)
    assert lines.evaluate("(list) => list.scrollTop") == 0
    newest.click()
    visitor.until(f"() => ({at_end})(document.querySelector('.log-lines'))")


def test_replies_are_announced_politely_and_ticks_are_not(visit: Visit) -> None:
    visitor = visit(running=True)
    announcer = visitor.page.locator("#announcer")
    assert announcer.get_attribute("aria-live") == "polite"
    reply = visitor.say("add two barriers").locator(".reply").inner_text()
    expect(announcer).to_have_text(reply)
    tick = visitor.tick()
    expect(visitor.page.locator("[data-figure=tick] .figure-value")).not_to_have_text(str(tick))
    expect(announcer).to_have_text(reply)


def test_everyone_watching_sees_a_change(visit: Visit) -> None:
    first = visit()
    second = visit(f"/#/s/{first.session}")
    first.say("add seven potholes")
    expect(second.page.locator(".log-line[data-tone=change]")).to_contain_text("add seven potholes")
    assert second.page.locator(".exchange").count() == 0


def test_talk_shows_how_far_an_evaluation_is_and_then_what_came_of_it(visit: Visit) -> None:
    visitor = visit()
    exchange = visitor.say("run this road 40 times")
    told = exchange.locator(".reply").nth(1)
    expect(told).to_contain_text("arrived in every one of 40 runs")
    expect(exchange.locator("progress")).to_have_count(0)
    report = exchange.get_by_role("link").get_attribute("href") or ""
    found = visitor.page.request.get(visitor.url + report.removesuffix("/report")).json()
    assert found["text"][0].startswith(told.inner_text())
    line = visitor.page.locator(".log-line", has_text="The evaluation is done")
    expect(line).not_to_contain_text("/api/")
    assert line.get_by_role("link").get_attribute("href") == report
    assert visitor.page.request.get(visitor.url + report).ok
    visitor.page.reload()
    visitor.wait_live()
    expect(visitor.page.locator(".exchange").first).to_contain_text("arrived in every one of 40 runs")
