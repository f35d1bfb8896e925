"""Pictures of every state of the page on every kind of screen, to be looked at, and what axe finds in each.

    python -m tools.page_states FOLDER                        all of them, and a sheet for each state
    python -m tools.page_states FOLDER --states crash quiz --devices phone

A state is arranged once for each device and then seen at all its sizes and in both themes. Beside what axe
finds, the tool tells where a page is wider than its window and where text runs out of its place.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from PIL import Image
from playwright.sync_api import Browser, expect, sync_playwright

from tests.browser.conftest import QUIET, chromium
from tests.browser.states import EMPTY, STATES, nothing
from tests.browser.visitor import Visitor
from tests.support.axe import violations
from tests.support.cut_off import CUT_OFF
from tests.support.service_process import ServiceProcess

SHEET_PX = 2400
"""How wide the sheet of a state's pictures is."""


@dataclass(frozen=True)
class Screen:
    """A window's size in CSS pixels, and a theme."""

    name: str
    width: int
    height: int
    scheme: str = "light"


@dataclass(frozen=True)
class Device:
    """What cannot change while a page is open: pixel ratio, touch, language."""

    screens: tuple[Screen, ...]
    context: dict[str, Any] = field(default_factory=dict)
    language: str = "en"
    """Of the session, whose log and replies are in it."""


DEVICES = {
    "desk": Device(
        (
            Screen("1440", 1440, 900),
            Screen("1440-dark", 1440, 900, "dark"),
            Screen("1920", 1920, 1080, "dark"),
            Screen("1366", 1366, 768),
            Screen("1024", 1024, 768),
            Screen("200-percent", 720, 450),
            Screen("844x390", 844, 390),
            Screen("390", 390, 844),
        )
    ),
    "phone": Device(
        (Screen("upright", 390, 844), Screen("upright-dark", 390, 844, "dark"), Screen("sideways", 844, 390)),
        {"device_scale_factor": 2, "is_mobile": True, "has_touch": True},
    ),
    "german": Device(
        (Screen("1366", 1366, 768), Screen("1024", 1024, 768, "dark"), Screen("390", 390, 844)),
        {"locale": "de-DE"},
        "de",
    ),
}

LOST = "not-connected"
"""The state for which the service is killed, hence the last."""


class Album:
    """Takes and keeps pictures."""

    def __init__(self, folder: Path, browser: Browser, service: ServiceProcess) -> None:
        self._folder, self._browser, self._service = folder, browser, service
        self.troubles: list[str] = []

    def take(self, state: str, device: str) -> None:
        """A state at all sizes of a device."""
        wishes, arrange = STATES.get(state, (EMPTY, nothing))
        screens, context = DEVICES[device].screens, DEVICES[device].context
        first = {"width": screens[0].width, "height": screens[0].height}
        visitor = Visitor(
            self._browser, self._service.url, viewport=first, reduced_motion="reduce", **context
        )
        session = self._service.session(**wishes, language=DEVICES[device].language)
        visitor.open(f"/#/s/{session}")
        try:
            arrange(visitor)
            if state == LOST:
                self._service.kill()
                expect(visitor.page.locator("#connection")).to_have_attribute("data-phase", "lost")
            for screen in screens:
                self._picture(visitor, state, device, screen)
        except Exception as problem:  # one state that cannot be arranged is told, the others are taken
            self.troubles.append(f"{state}, {device}: {type(problem).__name__} {str(problem)[:300]}")
        finally:
            visitor.close()
            if state == LOST:
                self._service.start()

    def _picture(self, visitor: Visitor, state: str, device: str, screen: Screen) -> None:
        page = visitor.page
        page.set_viewport_size({"width": screen.width, "height": screen.height})
        page.emulate_media(color_scheme=screen.scheme)  # type: ignore[arg-type]
        page.wait_for_timeout(400)  # sizes are drawn anew with the next frames
        name = f"{state}-{device}-{screen.name}"
        page.screenshot(path=self._folder / f"{name}.png", animations="disabled")
        for found in [*violations(visitor), *page.evaluate(CUT_OFF)]:
            self.troubles.append(f"{name}: {found}")

    def sheet(self, state: str) -> None:
        """All pictures of a state on one."""
        paths = sorted(self._folder.glob(f"{state}-*.png"))
        if not paths:
            return
        height = 560
        row, rows, wide = [], [], 0
        for path in paths:
            image = Image.open(path).convert("RGB")
            image = image.resize((image.width * height // image.height, height), Image.Resampling.LANCZOS)
            if row and wide + image.width > SHEET_PX:
                rows.append(row)
                row, wide = [], 0
            row.append(image)
            wide += image.width + 12
        rows.append(row)
        whole = Image.new("RGB", (SHEET_PX, (height + 12) * len(rows)), "#ff00ff")
        for down, images in enumerate(rows):
            left = 0
            for image in images:
                whole.paste(image, (left, down * (height + 12)))
                left += image.width + 12
        (self._folder / "sheets").mkdir(exist_ok=True)
        whole.save(self._folder / "sheets" / f"{state}.png")


def main(arguments: list[str]) -> None:
    """Take the pictures, print what is wrong in them."""
    parser = argparse.ArgumentParser(prog="tools.page_states", description="Every state of the page.")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--states", nargs="+", choices=[*STATES, LOST], default=[*STATES, LOST])
    parser.add_argument("--devices", nargs="+", choices=list(DEVICES), default=list(DEVICES))
    options = parser.parse_args(arguments)
    options.folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch, sync_playwright() as playwright:
        service = ServiceProcess(Path(scratch) / "states.db")
        service.start()
        browser = playwright.chromium.launch(executable_path=chromium(), args=QUIET)
        album = Album(options.folder, browser, service)
        try:
            for state in options.states:
                for device in options.devices:
                    album.take(state, device)
                album.sheet(state)
                print(f"{state}: taken", flush=True)
        finally:
            browser.close()
            service.kill()
    print(*album.troubles or ["Nothing is wrong in any."], sep="\n")


if __name__ == "__main__":
    main(sys.argv[1:])
