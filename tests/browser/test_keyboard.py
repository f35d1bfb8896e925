"""The whole page by keyboard alone."""

from __future__ import annotations

import re

from playwright.sync_api import expect

from tests.browser.conftest import Visit


def test_the_first_minute_by_keyboard(visit: Visit) -> None:
    visitor = visit()
    keys = visitor.page.keyboard
    keys.press("/")
    expect(visitor.words).to_be_focused()
    expect(visitor.words).to_have_value("")
    keys.type("add five potholes")
    keys.press("Enter")
    expect(visitor.last_exchange("add five potholes").locator(".change").first).to_be_visible()
    keys.type("/why did you do that?")  # the slash once more does no harm
    keys.press("Enter")
    expect(visitor.last_exchange("why did you do that?").locator(".answer")).to_be_visible()
    keys.type("add five potholes and order pizza")
    keys.press("Enter")
    refused = visitor.last_exchange("add five potholes and order pizza")
    suggestion = refused.locator(".offer").last
    wanted = suggestion.inner_text()
    keys.press("Shift+Tab")
    expect(suggestion).to_be_focused()
    keys.press("Enter")
    visitor.last_exchange(wanted)


def test_space_pauses_arrow_steps_u_undoes(visit: Visit) -> None:
    visitor = visit(running=True)
    page, keys = visitor.page, visitor.page.keyboard
    keys.press("Space")
    expect(page.locator(".paused")).to_be_visible()
    expect(page.get_by_role("button", name="Resume")).to_be_visible()
    tick = visitor.tick()
    shown = page.locator("[data-figure=tick] .figure-value")
    keys.press("ArrowRight")
    expect(shown).to_have_text(str(tick + 1))
    keys.press("ArrowRight")
    expect(shown).to_have_text(str(tick + 2))
    potholes = visitor.script.count("pothole")
    road = page.locator("#road .road-canvas")
    before = visitor.description()
    visitor.script.act({"do": "add", "kind": "pothole", "count": 4})
    expect(road).to_have_attribute("aria-label", re.compile(f" {potholes + 4} potholes"))
    keys.press("u")
    expect(road).to_have_attribute("aria-label", before)
    assert visitor.script.count("pothole") == potholes
    keys.press("Space")
    expect(page.locator(".paused")).to_be_hidden()


def test_step_on_a_running_road_pauses_it_first(visit: Visit) -> None:
    visitor = visit(running=True)
    visitor.page.keyboard.press("ArrowRight")
    expect(visitor.page.locator(".paused")).to_be_visible()
    expect(visitor.page.locator(".log-line").filter(has_text="Paused.")).to_have_count(1)
    expect(visitor.page.locator(".caption-arrow")).not_to_be_empty()
    assert visitor.script.state()["paused"] is True


def test_keys_are_letters_while_typing(visit: Visit) -> None:
    visitor = visit(running=True)
    visitor.words.focus()
    visitor.page.keyboard.type("u r ? /")
    expect(visitor.words).to_have_value("u r ? /")
    assert visitor.script.state()["paused"] is False
    visitor.page.keyboard.press("Escape")
    visitor.page.keyboard.press("Escape")
    expect(visitor.words).not_to_be_focused()
    visitor.page.keyboard.press("?")
    expect(visitor.page.get_by_role("dialog", name="What can I say?")).to_be_visible()


def test_space_on_a_button_presses_it_once(visit: Visit) -> None:
    visitor = visit(running=True)
    button = visitor.page.get_by_role("button", name="Pause")
    button.focus()
    visitor.page.keyboard.press("Space")
    expect(visitor.page.locator(".paused")).to_be_visible()
    assert visitor.script.state()["paused"] is True


def test_everything_reached_by_tab_shows_its_focus(visit: Visit) -> None:
    visitor = visit()
    seen = []
    for _ in range(80):
        visitor.page.keyboard.press("Tab")
        focus = visitor.page.evaluate(
            """() => {
              const element = document.activeElement;
              if (!element || element === document.body) return null;
              const style = getComputedStyle(element);
              return { name: element.id || element.className, outlined: style.outlineStyle !== "none" };
            }"""
        )
        if focus is None:
            break
        seen.append(focus)
    assert {"words", "help", "new-session"} <= {focus["name"] for focus in seen}
    assert [focus["name"] for focus in seen if not focus["outlined"]] == []
