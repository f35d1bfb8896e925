"""An empty road with the clock stopped, and a hand over it: for pointing, touching and driving."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

from playwright.sync_api import Locator, expect

from tests.browser.visitor import Visitor
from tests.support.service_process import ServiceProcess

Cell = list[int]

# Once the road has come to rest: while the vehicle glides, so does the view.
PLACE_OF = """
async (cell) => {
  const { viewUnder } = await import("/src/road/hitTest.js");
  const { places } = viewUnder(document.querySelector(".road-hands"));
  let [at, still] = ["", 0];
  while (still < 4) {
    await new Promise(requestAnimationFrame);
    const { left, top, width, height } = places.placeOf(cell);
    const now = JSON.stringify([left + width / 2, top + height / 2]);
    still = now === at ? still + 1 : 0;
    at = now;
  }
  return JSON.parse(at);
}
"""


CALLED = {"vehicle": "car", "pedestrian": "pedestrian"}
"""What the page calls kinds of things."""


class Road:
    """An empty road with the clock stopped, and a hand over it."""

    def __init__(self, visitor: Visitor) -> None:
        self.visitor = visitor
        self.page = visitor.page
        self.script = visitor.script
        self.surface = self.page.locator(".road-hands")
        self.bubble = self.page.locator("#bubble")
        self.beside = self.page.locator("#beside")

    @property
    def ego(self) -> Cell:
        """Where the vehicle is."""
        cell: Cell = self.script.state()["vehicles"][0]["cell"]
        return cell

    def ahead(self, rows: int, lanes: int = 0) -> Cell:
        """A cell as seen from the vehicle."""
        column, row = self.ego
        return [column + lanes, row - rows]

    def put(self, kind: str, cell: Cell) -> str:
        """Something on the road, not by hand; its id."""
        self.script.act({"do": "add", "kind": kind, "count": 1, "where": {"cell": cell}})
        (name,) = self.in_cell(cell)
        self.shown(kind)
        return name

    def shown(self, kind: str) -> None:
        """Wait until the page shows as many of a kind as there are."""
        count = self.script.count(kind)
        words = f"{count} {CALLED.get(kind, kind)}s?" if count else "."
        expect(self.page.locator("#road .road-canvas").first).to_have_attribute(
            "aria-label", re.compile(words)
        )

    def in_cell(self, cell: Cell) -> list[str]:
        """What is in a cell, by id."""
        state = self.script.state()
        return [thing["id"] for thing in [*state["movers"], *state["hazards"]] if thing["cell"] == cell]

    def at(self, cell: Cell) -> tuple[float, float]:
        """A cell's centre in the window."""
        x, y = self.page.evaluate(PLACE_OF, cell)
        return x, y

    def step(self, ticks: int = 1) -> None:
        """Drive on, and wait until that is seen."""
        self.visitor.step(ticks)

    def point(self, cell: Cell) -> None:
        """Let the pointer rest on a cell."""
        x, y = self.at(cell)
        self.page.mouse.move(x - 3, y - 3)
        self.page.mouse.move(x, y)

    def drag(self, start: tuple[float, float], end: tuple[float, float], *, drop: bool = True) -> None:
        """Press, move in steps, let go."""
        mouse = self.page.mouse
        mouse.move(*start)
        mouse.down()
        mouse.move((start[0] + end[0]) / 2, (start[1] + end[1]) / 2, steps=4)
        mouse.move(*end, steps=4)
        if drop:
            mouse.up()

    def done(self, said: str) -> Locator:
        """The exchange in which something was done by hand."""
        last = self.page.locator(".exchange").last
        expect(last.locator(".said")).to_contain_text(said)
        expect(last).to_have_attribute("data-standing", "done")
        return last


def empty_road(visit: Callable[..., Visitor], service: ServiceProcess, **context: Any) -> Road:
    """A road with nothing on it but the vehicle, opened in a page."""
    found = Road(visit(f"/#/s/{service.session(seed=7, paused=True)}", **context))
    found.script.act({"do": "remove", "kind": "everything", "count": "all"})
    expect(found.page.locator("#road .road-canvas").first).to_have_attribute(
        "aria-label", re.compile("nothing on it")
    )
    return found
