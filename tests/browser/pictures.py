"""Makes the README's picture: `python -m tests.browser.pictures`. The first minute, as a visitor sees it."""

from __future__ import annotations

import tempfile
from pathlib import Path

from playwright.sync_api import sync_playwright

from tests.browser.conftest import QUIET, chromium
from tests.browser.service_process import ServiceProcess
from tests.browser.visitor import Visitor

FOLDER = Path(__file__).parent / "pictures"


def main() -> None:
    """Take the pictures and write them beside this file."""
    FOLDER.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        service = ServiceProcess(Path(folder) / "pictures.db")
        service.start()
        browser = playwright.chromium.launch(executable_path=chromium(), args=QUIET)
        visitor = Visitor(browser, service.url, color_scheme="dark").open()
        visitor.pause()
        visitor.say("add five potholes")
        visitor.say("advance six ticks")
        visitor.say("put a cone right in front of the car")
        visitor.say("advance one tick")
        visitor.say("why did you do that?")
        visitor.page.evaluate("() => Promise.all(document.getAnimations().map((one) => one.finished))")
        visitor.page.screenshot(path=FOLDER / "page.png")
        visitor.close()
        browser.close()
        service.kill()


if __name__ == "__main__":
    main()
