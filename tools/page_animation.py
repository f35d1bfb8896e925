"""Makes the README's animated picture: `python -m tools.page_animation`.

A real browser shows the page while a road runs and somebody types. Chromium's screencast gives the
frames; they are written as an animated WebP to `docs/pictures`.
"""

from __future__ import annotations

import base64
import io
import tempfile
from pathlib import Path
from typing import Any

import httpx
from PIL import Image
from playwright.sync_api import Page, sync_playwright

from tests.browser.conftest import QUIET, chromium
from tests.browser.visitor import Visitor
from tests.support.service_process import ServiceProcess

FILE = Path(__file__).parents[1] / "docs" / "pictures" / "first-minute.webp"
MOST_BYTES = 1_500_000
VIEW = {"width": 1280, "height": 800}
WIDTH = 880
FRAMES_PER_S = 10
SAID = ("add five potholes", "why did you go left?")
KEY_MS = 45
READ_MS = 3_200


class Screencast:
    """The frames that a page shows, with the second at which each appeared."""

    def __init__(self, page: Page) -> None:
        self.frames: list[tuple[float, bytes]] = []
        self._session = page.context.new_cdp_session(page)
        self._session.on("Page.screencastFrame", self._take)
        self._running = True
        self._session.send("Page.startScreencast", {"format": "jpeg", "quality": 92, "everyNthFrame": 2})

    def _take(self, event: dict[str, Any]) -> None:
        self.frames.append((event["metadata"]["timestamp"], base64.b64decode(event["data"])))
        if self._running:
            self._session.send("Page.screencastFrameAck", {"sessionId": event["sessionId"]})

    def at_rate(self) -> list[Image.Image]:
        """The frames at a steady rate: each instant shows what was there last."""
        self._running = False
        self._session.send("Page.stopScreencast")
        begun, ended = self.frames[0][0], self.frames[-1][0]
        images, number = [], 0
        for instant in range(int((ended - begun) * FRAMES_PER_S) + 1):
            while (
                number + 1 < len(self.frames) and self.frames[number + 1][0] - begun <= instant / FRAMES_PER_S
            ):
                number += 1
            image = Image.open(io.BytesIO(self.frames[number][1])).convert("RGB")
            images.append(
                image.resize((WIDTH, round(WIDTH * image.height / image.width)), Image.Resampling.LANCZOS)
            )
        return images


def play(visitor: Visitor) -> list[Image.Image]:
    """Lets the road run, says something, asks why."""
    page = visitor.page
    cast = Screencast(page)
    visitor.script.act({"do": "resume"})
    page.wait_for_timeout(2_000)
    for text in SAID:
        page.locator("#words").click()
        page.keyboard.type(text, delay=KEY_MS)
        page.wait_for_timeout(700)
        page.keyboard.press("Enter")
        page.wait_for_timeout(READ_MS)
    return cast.at_rate()


def save(images: list[Image.Image]) -> None:
    """Writes the animation, as good as its limit of size allows."""
    for quality in (70, 55, 40, 30, 20):
        first, *others = images
        first.save(
            FILE,
            save_all=True,
            append_images=others,
            duration=round(1000 / FRAMES_PER_S),
            loop=0,
            quality=quality,
            method=4,
        )
        if FILE.stat().st_size <= MOST_BYTES:
            break
    weight = FILE.stat().st_size
    print(f"{FILE.name}: {len(images)} frames, {weight:,} bytes, quality {quality}")
    assert weight <= MOST_BYTES, "the animation is too heavy"


def main() -> None:
    """Makes the animation with a service and a browser of its own."""
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        service = ServiceProcess(Path(folder) / "animation.db")
        service.start()
        browser = playwright.chromium.launch(executable_path=chromium(), args=QUIET)
        try:
            asked = {"seed": 9, "paused": True, "config": {"vehicles": 8, "potholes": 6}}
            made = httpx.post(f"{service.url}/api/v1/sessions", json=asked, timeout=60).raise_for_status()
            visitor = Visitor(browser, service.url, viewport=VIEW, color_scheme="dark")
            visitor.open(f"/#/s/{made.json()['id']}")
            save(play(visitor))
        finally:
            browser.close()
            service.kill()


if __name__ == "__main__":
    main()
