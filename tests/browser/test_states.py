"""States of the page on screens of all sizes: nothing is cut, nothing sticks out, and axe finds nothing."""

from __future__ import annotations

import pytest

from tests.browser.conftest import Visit
from tests.browser.states import STATES
from tests.support.axe import violations
from tests.support.cut_off import CUT_OFF
from tests.support.service_process import ServiceProcess

SCREENS = [(1440, 900), (1024, 768), (844, 390), (720, 450), (390, 844)]
SEEN = ["talked", "past", "crash", "by-hand", "plan", "planners", "sessions", "quiz", "help"]
"""Other states have tests of their own; all of them are in the pictures of `tools.page_states`."""


@pytest.mark.parametrize("name", SEEN)
@pytest.mark.parametrize(("locale", "language"), [("en-GB", "en"), ("de-DE", "de")])
def test_nothing_is_cut_at_any_size(
    visit: Visit, service: ServiceProcess, name: str, locale: str, language: str
) -> None:
    wishes, arrange = STATES[name]
    session = service.session(**wishes, language=language)
    visitor = visit(f"/#/s/{session}", locale=locale, reduced_motion="reduce")
    arrange(visitor)
    found: dict[str, list[str]] = {}
    for width, height in SCREENS:
        visitor.page.set_viewport_size({"width": width, "height": height})
        visitor.settled()
        found[f"{width}x{height}"] = [*visitor.page.evaluate(CUT_OFF), *violations(visitor)]
    assert {size: lines for size, lines in found.items() if lines} == {}


def test_the_newest_of_the_log_stays_in_sight_when_the_window_changes(
    visit: Visit, service: ServiceProcess
) -> None:
    visitor = visit(f"/#/s/{service.session(seed=9, paused=True)}")
    for _ in range(4):
        visitor.say("add five potholes")
        visitor.step()
    for size in ((1920, 1080), (1366, 620), (1024, 700)):
        visitor.page.set_viewport_size({"width": size[0], "height": size[1]})
        visitor.settled()
        assert visitor.page.locator(".newest").is_hidden(), size
