"""What panels draw is as large as their frames and as sharp as the screen, at every ratio and size."""

from __future__ import annotations

from typing import Any

import pytest

from tests.browser.conftest import Visit

SHARPEST = 2
"""More pixels than this a CSS pixel are not drawn (`fitCanvas`)."""
CANVASES = """
() => [...document.querySelectorAll("canvas")]
  .filter((canvas) => canvas.checkVisibility() && !canvas.matches(".service-canvas"))
  .map((canvas) => {
    const box = (element) => {
      const { left, top, right, bottom } = element.getBoundingClientRect();
      return [left, top, right, bottom];
    };
    return { name: canvas.className || canvas.parentElement.className, pixels: [canvas.width, canvas.height],
             shown: [canvas.clientWidth, canvas.clientHeight],
             box: box(canvas), frame: box(canvas.parentElement) };
  })
"""
SCREENS = [(1440, 900), (1366, 768), (1024, 768), (844, 390), (390, 844)]


def misfits(canvases: list[dict[str, Any]], ratio: int) -> list[str]:
    """Canvases whose pixels are not those of their place, or that stick out of their frame."""
    found = []
    for canvas in canvases:
        dense = min(SHARPEST, ratio)
        blurred = any(
            abs(have - size * dense) > dense
            for have, size in zip(canvas["pixels"], canvas["shown"], strict=True)
        )
        left, top, right, bottom = canvas["box"]
        within = canvas["frame"]
        out = left < within[0] - 1 or top < within[1] - 1 or right > within[2] + 1 or bottom > within[3] + 1
        if blurred or out:
            found.append(str(canvas))
    return found


@pytest.mark.parametrize("screen", SCREENS, ids=lambda screen: f"{screen[0]}x{screen[1]}")
@pytest.mark.parametrize("ratio", [1, 2, 3])
def test_what_is_drawn_fits_its_frame(visit: Visit, ratio: int, screen: tuple[int, int]) -> None:
    width, height = screen
    visitor = visit(viewport={"width": width, "height": height}, device_scale_factor=ratio)
    visitor.step(3)
    visitor.settled()
    canvases = visitor.page.evaluate(CANVASES)
    assert len(canvases) >= (4 if width >= 960 else 2)
    assert misfits(canvases, ratio) == []
    plan = next((canvas for canvas in canvases if "plan" in canvas["name"]), None)
    if plan is not None:
        side = min(plan["frame"][2] - plan["frame"][0], plan["frame"][3] - plan["frame"][1])
        assert side >= 170
        assert side - 1 <= plan["shown"][0] <= side
        assert plan["shown"][0] == plan["shown"][1]


@pytest.mark.parametrize("ratio", [1, 2, 3])
@pytest.mark.parametrize("name", ["plan", "occupancy", "metrics"])
def test_what_is_enlarged_is_drawn_anew_in_its_new_size(visit: Visit, ratio: int, name: str) -> None:
    visitor = visit(device_scale_factor=ratio)
    visitor.step(3)
    visitor.page.locator(f"[data-enlarge={name}]").click()
    visitor.settled()
    canvases = visitor.page.evaluate(CANVASES)
    assert misfits(canvases, ratio) == []
    panel = visitor.page.locator(f"[data-view={name}]").bounding_box()
    road = visitor.page.locator(".drive").bounding_box()
    assert panel is not None
    assert road is not None
    assert abs(panel["x"] - road["x"]) < 1, "an enlarged panel begins where the road begins"
