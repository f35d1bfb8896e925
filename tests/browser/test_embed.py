"""A run in a frame of another page: it plays, is walked along, and leaves the session as it is."""

from __future__ import annotations

import re

from playwright.sync_api import Browser, expect

from tests.browser.conftest import Visit
from tests.support.service_process import ServiceProcess


def test_a_snippet_plays_the_run_on_another_page(
    visit: Visit, service: ServiceProcess, browser: Browser
) -> None:
    session = service.session(seed=16, paused=True, config={"vehicles": 24})
    visitor = visit(f"/#/s/{session}")
    visitor.script.act({"do": "step", "ticks": 12})
    visitor.say("embed this run")
    snippet = visitor.page.get_by_label("Snippet for another page").input_value()
    source = re.search(r'src="([^"]+)"', snippet)
    assert source
    assert source[1].startswith(f"{service.url}/embed#/r/"), "the link carries the run"
    other = browser.new_context(reduced_motion="reduce").new_page()
    other.set_content(f"<h1>Another page</h1>{snippet}")
    frame = other.frame_locator("iframe")
    slider = frame.get_by_role("slider")
    expect(slider).to_be_enabled()
    expect(frame.locator(".embed-tick")).to_have_text("Tick 0")
    slider.focus()
    other.keyboard.press("End")
    expect(frame.locator(".embed-tick")).to_have_text("Tick 12")
    expect(frame.locator(".embed-told")).not_to_be_empty()
    frame.get_by_role("button", name="Play").click()
    expect(frame.get_by_role("button", name="Pause")).to_be_visible()
    expect(frame.get_by_role("link", name="Open in Roadtalk")).to_have_attribute(
        "href", re.compile(r"^\./#/s/")
    )
    assert visitor.script.state()["tick"] == 12
    other.context.close()


def test_an_address_that_names_no_run_says_so(browser: Browser, service: ServiceProcess) -> None:
    page = browser.new_context().new_page()
    page.goto(f"{service.url}/embed")
    expect(page.locator(".embed-told")).to_have_text("This address names no run.")
    expect(page.get_by_role("button", name="Play")).to_be_disabled()
    page.context.close()
