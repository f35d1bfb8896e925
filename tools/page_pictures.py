"""Makes the README's pictures: `python -m tools.page_pictures [name…]`. The page, as its visitors see it.

Roads come from seeds and clocks stand still, so that the same page gives the same pictures. They are
written to `docs/pictures`; one that would be too heavy is written in 256 colours,
dithered where that is light enough.
"""

from __future__ import annotations

import io
import re
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import httpx
from PIL import Image
from playwright.sync_api import Browser, expect, sync_playwright

from tests.browser.conftest import QUIET, chromium
from tests.browser.hands import PLACE_OF
from tests.browser.visitor import Visitor
from tests.support.service_process import ServiceProcess

FOLDER = Path(__file__).parents[1] / "docs" / "pictures"
MOST_BYTES = 250_000
OWN_COLOURS = 128
"""Of the 256 in a picture that would be too heavy otherwise."""
DESK: dict[str, Any] = {"viewport": {"width": 1440, "height": 900}, "color_scheme": "dark"}
PHONE: dict[str, Any] = {
    "viewport": {"width": 390, "height": 844},
    "device_scale_factor": 2,
    "has_touch": True,
    "is_mobile": True,
}


class Studio:
    """A browser, a service, and roads to look at."""

    def __init__(self, browser: Browser, service: ServiceProcess) -> None:
        self._browser = browser
        self._service = service

    def visit(self, seed: int, *, config: dict[str, Any] | None = None, **context: Any) -> Visitor:
        """A road from a seed, with the clock stopped, and someone at the page."""
        asked = {"seed": seed, "paused": True, "config": config or {}}
        made = httpx.post(f"{self._service.url}/api/v1/sessions", json=asked, timeout=10).raise_for_status()
        return Visitor(self._browser, self._service.url, **{**DESK, **context}).open(
            f"/#/s/{made.json()['id']}"
        )

    def drive(self, visitor: Visitor, ticks: int) -> None:
        """So many ticks on, one at a time, and seen."""
        shown = visitor.page.locator("[data-figure=tick] .figure-value")
        for _ in range(ticks):
            visitor.script.act({"do": "step", "ticks": 1})
            expect(shown).to_have_text(str(visitor.script.state()["tick"]))

    def take(self, visitor: Visitor, name: str) -> None:
        """Once all is still."""
        page = visitor.page
        tick = visitor.script.state()["tick"]
        lost = page.locator("#metrics").get_by_text(re.compile(rf"lost in {tick}$|^–$|unavoidable"))
        expect(lost.last).to_be_attached()
        visitor.coloured()
        before, now = b"", page.screenshot(animations="disabled")
        while now != before:
            visitor.settled()
            before, now = now, page.screenshot(animations="disabled")
        image = Image.open(io.BytesIO(now)).convert("RGB")
        path = FOLDER / f"{name}.png"
        image.save(path, optimize=True)
        if path.stat().st_size > MOST_BYTES:
            box = page.locator("#road").bounding_box()
            size = page.viewport_size
            assert box is not None
            assert size is not None
            dense = image.width / size["width"]
            road = [round(dense * each) for each in (box["x"], box["y"], box["width"], box["height"])]
            for dither in (Image.Dither.FLOYDSTEINBERG, Image.Dither.NONE):
                _in_few_colours(image, road, dither).save(path, optimize=True)
                if path.stat().st_size <= MOST_BYTES:
                    break
        weight = path.stat().st_size
        print(f"{path.name}: {weight:,} bytes")
        assert weight <= MOST_BYTES, f"{path.name} is too heavy"
        visitor.close()


def _in_few_colours(image: Image.Image, road: list[int], dither: Image.Dither) -> Image.Image:
    """In 256: the commonest of the page keep their exact value, and the road has the rest."""
    left, top, width, height = road
    seen = (left, max(0, top), left + width, top + height)
    around = image.copy()
    around.paste((0, 0, 0), seen)
    counted = sorted(around.getcolors(1 << 24) or [], reverse=True)[:OWN_COLOURS]
    few = image.crop(seen).quantize(256 - OWN_COLOURS, Image.Quantize.MEDIANCUT, kmeans=4)
    palette = [part for _, colour in counted if isinstance(colour, tuple) for part in colour]
    table = Image.new("P", (1, 1))
    table.putpalette(palette + (few.getpalette() or [])[: 3 * (256 - OWN_COLOURS)])
    return image.quantize(palette=table, dither=dither)


def _talked(studio: Studio, **context: Any) -> Visitor:
    visitor = studio.visit(9, **context)
    studio.drive(visitor, 9)
    visitor.say("add five potholes")
    studio.drive(visitor, 7)
    visitor.say("put a cone right in front of the car")
    studio.drive(visitor, 1)
    visitor.say("why did you do that?")
    return visitor


def page(studio: Studio) -> None:
    """The whole of it, on a desk in the dark."""
    studio.take(_talked(studio), "page")


def light(studio: Studio) -> None:
    """The same by day."""
    studio.take(_talked(studio, color_scheme="light"), "light")


def perspective(studio: Studio) -> None:
    """From behind the vehicle, by day: where it is about to go, and where the others are."""
    visitor = studio.visit(9, config={"pedestrians": 3, "barriers": 3}, color_scheme="light")
    studio.drive(visitor, 9)
    visitor.say("perspective")
    studio.drive(visitor, 3)
    studio.take(visitor, "perspective")


def phone(studio: Studio) -> None:
    """In a hand."""
    visitor = studio.visit(9, **PHONE)
    studio.drive(visitor, 9)
    visitor.say("add five potholes")
    visitor.page.evaluate("() => document.activeElement.blur()")
    studio.take(visitor, "phone")


def crash(studio: Studio) -> None:
    """Straight on, by hand, on a busy road where nobody brakes."""
    visitor = studio.visit(16, config={"vehicles": 24, "potholes": 4, "pedestrians": 4, "attentive": 0.0})
    visitor.say("let me drive")
    for _ in range(60):
        visitor.script.act({"do": "drive", "move": "forward"})
        studio.drive(visitor, 1)
        if visitor.script.state()["status"] != "running":
            break
    assert visitor.script.state()["status"] == "crash"
    expect(visitor.page.locator(".verdict")).to_be_visible()
    visitor.say("why did you do that?")
    studio.take(visitor, "crash")


def bubble(studio: Studio) -> None:
    """What is known about what the pointer rests on."""
    visitor = studio.visit(9)
    studio.drive(visitor, 16)
    state = visitor.script.state()
    column, row = state["vehicles"][0]["cell"]
    visitor.script.act({"do": "add", "kind": "barrier", "count": 1, "where": {"cell": [column, row - 1]}})
    studio.drive(visitor, 1)
    x, y = visitor.page.evaluate(PLACE_OF, [column, row - 1])
    visitor.page.mouse.move(x - 3, y - 3)
    visitor.page.mouse.move(x, y)
    expect(visitor.page.locator("#bubble")).to_be_visible()
    studio.take(visitor, "bubble")


def counterfactual(studio: Studio) -> None:
    """What would have been, beside what was."""
    visitor = studio.visit(9)
    studio.drive(visitor, 16)
    column, row = visitor.script.state()["vehicles"][0]["cell"]
    visitor.script.act({"do": "add", "kind": "barrier", "count": 1, "where": {"cell": [column, row - 1]}})
    studio.drive(visitor, 1)
    visitor.say("why did you do that?")
    visitor.settled()  # the vehicle is where it is going
    visitor.page.mouse.click(*visitor.page.evaluate(PLACE_OF, visitor.script.state()["vehicles"][0]["cell"]))
    visitor.page.locator("#bubble .bubble-move", has_text="a barrier").click()
    end = visitor.page.locator("#beside [data-side=changed] .beside-verdict")
    expect(end).to_be_visible(timeout=15_000)
    visitor.page.keyboard.press("End")
    for _ in range(40):
        if visitor.page.locator("#beside .beside-tick").inner_text() == "tick 18":
            break
        visitor.page.keyboard.press("ArrowLeft")
    studio.take(visitor, "counterfactual")


PICTURES: dict[str, Callable[[Studio], None]] = {
    each.__name__: each for each in (page, light, perspective, phone, crash, bubble, counterfactual)
}


def main(names: list[str]) -> None:
    """Take the pictures that are named, or all."""
    FOLDER.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        service = ServiceProcess(Path(folder) / "pictures.db")
        service.start()
        browser = playwright.chromium.launch(executable_path=chromium(), args=QUIET)
        try:
            for name in names or PICTURES:
                PICTURES[name](Studio(browser, service))
        finally:
            browser.close()
            service.kill()


if __name__ == "__main__":
    main(sys.argv[1:])
