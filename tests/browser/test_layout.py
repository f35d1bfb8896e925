"""On a wide screen and a narrow one, in light and dark: readable, reachable, light, still when asked."""

from __future__ import annotations

from typing import Any

import pytest
from playwright.sync_api import expect

from tests.browser.conftest import Visit
from tests.browser.visitor import Visitor
from tests.support.axe import FAINT_TEXT

WIDE = {"width": 1440, "height": 900}
NARROW = {"width": 360, "height": 740}


FRAME_MS = 20
# A clock of its own begins long before, so that it can be stopped here.
BEGINS, STOPS = "2030-01-01T00:00:00", "2030-01-01T01:00:00"

SMALL_TARGETS = """
() => [...document.querySelectorAll(
    ".top button, .controls button, .command button, .command input, .example, .offer")]
  .filter((element) => element.checkVisibility())
  .map((element) => [element.textContent || element.id, element.getBoundingClientRect()])
  .filter(([, box]) => box.width < 44 || box.height < 44)
  .map(([name, box]) => `${name}: ${box.width} × ${box.height}`)
"""


def pictures_of_a_step(visitor: Visitor) -> int:
    """How many the road goes through in one tick, by a clock that goes on when it is told to."""
    page, clock = visitor.page, visitor.page.clock
    shown = page.locator("[data-figure=tick] .figure-value")
    before = shown.inner_text()
    visitor.script.act({"do": "step", "ticks": 1})
    seen, frames = {visitor.picture()}, 0
    while frames < 50:
        clock.run_for(FRAME_MS)
        seen.add(visitor.picture())
        frames += shown.inner_text() != before
    return len(seen)


def talkative(visitor: Visitor) -> None:
    """Have one of each kind of exchange on the page."""
    visitor.say("add five potholse")
    visitor.say("why did you do that?")
    visitor.say("add five potholes and order pizza")


@pytest.mark.parametrize("viewport", [WIDE, NARROW], ids=["wide", "narrow"])
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_text_can_be_read_and_targets_hit(visit: Visit, viewport: dict[str, int], scheme: str) -> None:
    visitor = visit(viewport=viewport, color_scheme=scheme)
    visitor.coloured()
    assert visitor.page.evaluate(SMALL_TARGETS) == []
    assert visitor.page.evaluate(FAINT_TEXT) == []
    talkative(visitor)
    visitor.coloured()
    assert visitor.page.evaluate(FAINT_TEXT) == []
    assert visitor.page.evaluate(SMALL_TARGETS) == []


@pytest.mark.parametrize("width", [320, 360, 768, 1024, 1440])
def test_nothing_sticks_out_sideways(visit: Visit, width: int) -> None:
    visitor = visit(viewport={"width": width, "height": 800})
    talkative(visitor)
    assert visitor.page.evaluate("document.documentElement.scrollWidth") <= width
    box = visitor.page.locator("#road .road-canvas").bounding_box()
    assert box is not None
    assert box["width"] >= min(width, 768) * 0.5


def test_on_a_phone_road_reply_and_box_are_seen_together(visit: Visit) -> None:
    visitor = visit(viewport=NARROW)
    exchange = visitor.say("add five potholes")
    for part in (
        visitor.page.locator("#road .road-canvas"),
        exchange.locator(".change").first,
        visitor.words,
    ):
        expect(part).to_be_in_viewport(ratio=0.9)


def test_the_page_is_light_and_comes_from_one_place(visit: Visit) -> None:
    visitor = visit()
    weights: list[dict[str, Any]] = visitor.page.evaluate(
        """() => performance.getEntriesByType("resource").concat(performance.getEntriesByType("navigation"))
             .filter((entry) => !entry.name.includes("/api/"))
             .map((entry) => ({ name: entry.name, size: entry.encodedBodySize }))"""
    )
    total = sum(weight["size"] for weight in weights)
    print(f"{len(weights)} files, {total} bytes")
    assert len(weights) > 20
    assert 0 < total <= 150_000
    assert all(weight["name"].startswith(visitor.url) for weight in weights)


def test_the_policy_allows_nothing_inline_and_nothing_foreign(visit: Visit) -> None:
    visitor = visit()
    policy = visitor.page.request.get(visitor.url).headers["content-security-policy"]
    assert "default-src 'self'" in policy
    assert "unsafe" not in policy
    refused: list[str] = visitor.page.evaluate(
        """async () => {
          const told = new Promise((done) => document.addEventListener("securitypolicyviolation", done));
          const script = document.createElement("script");
          script.textContent = "window.ran = true";
          document.head.append(script);
          await told;
          const found = [...window.policyViolations, String(window.ran)];
          window.policyViolations = [];
          return found;
        }"""
    )
    assert len(refused) == 2
    assert refused[0].startswith("script-src")
    assert refused[1] == "undefined"
    visitor.forgive("Content Security Policy")


def test_little_motion_means_cuts_from_tick_to_tick(visit: Visit) -> None:
    gliding, still = visit().bare(), visit(reduced_motion="reduce").bare()
    for visitor in (gliding, still):
        visitor.settled()
        visitor.page.clock.install(time=BEGINS)
        visitor.page.clock.pause_at(STOPS)
    # What belongs to a tick may come a frame after it, as a ring around what is spoken of.
    assert pictures_of_a_step(still) <= 4
    assert pictures_of_a_step(gliding) > 15


def test_the_road_changes_with_the_colours_of_the_system(visit: Visit) -> None:
    visitor = visit(color_scheme="light").bare()
    light = visitor.settled()
    visitor.page.emulate_media(color_scheme="dark")
    visitor.settled(unlike=light)
    visitor.page.emulate_media(color_scheme="light")
    visitor.settled(like=light)


def test_on_a_phone_what_can_be_tried_is_seen_at_once_and_covers_nothing(visit: Visit) -> None:
    visitor = visit(viewport=NARROW)
    example = visitor.page.locator(".example").first
    expect(example).to_be_in_viewport(ratio=0.9)
    for button in visitor.page.locator("#controls button:visible").all():
        box, strip = button.bounding_box(), visitor.page.locator(".examples").bounding_box()
        assert box is not None
        assert strip is not None
        assert box["y"] + box["height"] <= strip["y"]
    example.click()
    visitor.last_exchange()
    expect(visitor.page.locator(".examples")).to_have_count(0)
