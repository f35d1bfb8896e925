"""The real service and a real Chromium; every visit must end without an error behind the scenes.

One service and one browser for all of these tests, and no longer: Playwright's event loop must be gone
before asynchronous tests of other folders run in the same process.

Nothing here depends on how fast the machine is. Roads are made from a seed and stand still, unless a test is
about a clock that runs; what is waited for may take long.
"""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, expect, sync_playwright

from tests.browser.hands import Road, empty_road
from tests.browser.visitor import PATIENCE_MS, Visitor
from tests.browser.walking import began
from tests.support.service_process import ServiceProcess

# Nothing of a browser's own is wanted on the network; the rest is for running as root without a screen.
QUIET = [
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]

Visit = Callable[..., Visitor]

expect.set_options(timeout=PATIENCE_MS)


# The first is the same engine without windows, which takes two thirds of the other's work.
PROGRAMS = ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome")


# About half of the work.
BY_HAND = {"test_hands", "test_keeping", "test_time", "test_views", "test_why"}


def chromium() -> str | None:
    """The system's Chromium, else (None) the one that `playwright install chromium` brings."""
    return next(filter(None, map(shutil.which, PROGRAMS)), None)


@pytest.hookimpl(tryfirst=True)  # before every other test gets its file's group
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """In two groups, each with a service and a browser of its own: a small machine has two cores."""
    here = Path(__file__).parent
    for item in items:
        if here in item.path.parents:
            item.add_marker(pytest.mark.browser)
            group = "browser by hand" if item.path.stem in BY_HAND else "browser"
            item.add_marker(pytest.mark.xdist_group(group))


STANDING: dict[str, Any] = {"seed": 9, "paused": True}
# So long that no episode ends on it while somebody looks.
RUNNING: dict[str, Any] = {"seed": 9, "config": {"rows": 400}}


@pytest.fixture(scope="package")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ServiceProcess]:
    process = ServiceProcess(tmp_path_factory.mktemp("service") / "roadtalk.db")
    process.start()
    yield process
    process.kill()


@pytest.fixture(scope="package")
def browser() -> Iterator[Browser]:
    """One for all visits."""
    with sync_playwright() as playwright:
        running = playwright.chromium.launch(executable_path=chromium(), args=QUIET, timeout=120_000)
        yield running
        running.close()


@pytest.fixture
def visit(service: ServiceProcess, browser: Browser) -> Iterator[Visit]:
    """Opens pages; at the end none may have logged an error, broken the policy or asked a stranger."""
    visitors: list[Visitor] = []

    def open_page(
        path: str | None = None, *, live: bool = True, running: bool = False, **context: Any
    ) -> Visitor:
        visitor = Visitor(browser, service.url, **context)
        visitors.append(visitor)
        if path is None:
            path = f"/#/s/{service.session(**(RUNNING if running else STANDING))}"
        if live:
            return visitor.open(path)
        visitor.page.goto(service.url + path)
        return visitor

    yield open_page
    problems = [line for visitor in visitors for line in visitor.troubles()]
    for visitor in visitors:
        visitor.close()
    assert problems == []


@pytest.fixture
def road(visit: Visit, service: ServiceProcess) -> Road:
    """An empty road with the clock stopped."""
    return empty_road(visit, service)


@pytest.fixture
def run(visit: Visit) -> Visitor:
    """A paused run of so many ticks, with something said at tick 40 and heavy traffic from there on."""
    visitor = visit()
    began(visitor)
    return visitor
