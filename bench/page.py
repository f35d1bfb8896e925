"""The page in a real Chromium on the real service: smoothness, memory, bytes, quickness, weight.

Frames are those whose callback the page itself asked for, so one is counted only where something was
drawn; how many of them differ is looked at apart, since reading the picture back costs time. Chromium
draws without a graphics card here. Figures are of one run on one machine, and of nothing else running.

    python -m bench.page                  # everything, the heap over ten minutes; writes bench/PAGE.md
    python -m bench.page --minutes 1 --only smooth heap
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from statistics import median
from typing import Any

import httpx
from playwright.sync_api import Browser, CDPSession, Page, sync_playwright

from bench.serving import machine
from tests.browser.conftest import QUIET, chromium
from tests.browser.visitor import PICTURE
from tests.support.service_process import ServiceProcess

RESULTS = Path(__file__).parent / "PAGE.md"
DESK = {"width": 1440, "height": 900}
SETTLE_MS = 2_000

COUNT_FRAMES = """
(() => {
  const ask = window.requestAnimationFrame.bind(window);
  const counts = window.counted = { frames: [], tasks: [] };
  window.requestAnimationFrame = (draw) => ask((now) => {
    if (counts.frames.at(-1) !== now) counts.frames.push(now);
    draw(now);
  });
  new PerformanceObserver((list) => {
    for (const task of list.getEntries()) counts.tasks.push([task.startTime, task.duration]);
  }).observe({ type: "longtask" });
})()
"""

READ_PICTURES = f"""
async (durationMs) => {{
  const began = performance.now();
  const pictures = [];
  while (performance.now() - began < durationMs) {{
    await new Promise(requestAnimationFrame);
    pictures.push(({PICTURE})());
  }}
  return {{ pictures, seconds: (performance.now() - began) / 1000 }};
}}
"""
"""Reads the road's picture back in every frame of a while, as a number."""

FIRST_FRAME = """
(() => {
  const look = () => {
    const canvas = document.querySelector("#road .road-canvas");
    const figure = document.querySelector("[data-figure=tick] .figure-value")?.textContent ?? "";
    if (canvas?.width && /\\d/.test(figure) && canvas.getAttribute("aria-label"))
      requestAnimationFrame(() => (window.firstFrame = performance.now()));
    else requestAnimationFrame(look);
  };
  requestAnimationFrame(look);
})()
"""

TIME_COMMANDS = """
() => {
  window.took = [];
  let began = 0;
  addEventListener("keydown", (event) => { if (event.key === "Enter") began = performance.now(); }, true);
  new MutationObserver(() => {
    const last = document.querySelector(".exchange:last-of-type");
    if (!began || last?.dataset.standing === "pending" || !last?.querySelector(".change")) return;
    window.took.push(performance.now() - began);
    began = 0;
  }).observe(document.querySelector("#talk"), { childList: true, subtree: true, attributes: true });
}
"""

WEIGH = """
() => performance.getEntriesByType("resource").concat(performance.getEntriesByType("navigation"))
  .filter((entry) => !entry.name.includes("/api/"))
  .map((entry) => [entry.encodedBodySize, entry.decodedBodySize, entry.startTime < window.firstFrame])
"""
"""Bodies, and whether each was asked for before the first live frame."""


@dataclass(frozen=True)
class Figure:
    """One thing that was measured."""

    what: str
    value: float
    unit: str
    aim: float | None = None
    least: bool = False
    """The aim is the least, not the most."""

    @property
    def holds(self) -> bool | None:
        """Whether the aim is reached; None without one."""
        if self.aim is None:
            return None
        return self.value >= self.aim if self.least else self.value <= self.aim

    def line(self) -> str:
        """As a row of the table."""
        aim = "" if self.aim is None else f"{'≥' if self.least else '≤'} {self.aim:g} {self.unit}"
        told = {None: "", True: "yes", False: "**no**"}[self.holds]
        return f"| {self.what} | {_plain(self.value)} {self.unit} | {aim} | {told} |"


@dataclass(frozen=True)
class Place:
    """Where all of it is measured."""

    browser: Browser
    url: str
    seconds: float
    minutes: float

    @contextmanager
    def page(self, path: str, *scripts: str) -> Iterator[tuple[Page, CDPSession]]:
        """A visit with an empty cache, and a line to the browser's own instruments."""
        context = self.browser.new_context(viewport=DESK)  # type: ignore[arg-type]
        for script in scripts:
            context.add_init_script(script)
        # An episode that ends is followed by the next, as where nobody looks.
        context.add_init_script("localStorage.setItem('roadtalk.ends_go_on', 'yes')")
        page = context.new_page()
        line = context.new_cdp_session(page)
        line.send("Network.enable")
        line.send("Performance.enable")
        page.goto(self.url + path)
        page.wait_for_selector("#connection[data-phase=live]")
        yield page, line
        context.close()

    def road(self, **config: object) -> str:
        """The address of a new session."""
        asked = {"seed": 4, "config": config} if config else {"seed": 4}
        made = httpx.post(f"{self.url}/api/v1/sessions", json=asked, timeout=10).raise_for_status().json()
        return f"/#/s/{made['id']}"


def smooth(at: Place) -> list[Figure]:
    """A running road with twenty vehicles."""
    with at.page(at.road(vehicles=20), COUNT_FRAMES) as (page, _):
        page.wait_for_timeout(SETTLE_MS)
        page.evaluate("() => { counted.frames.length = counted.tasks.length = 0; }")
        page.wait_for_timeout(1_000 * at.seconds)
        frames, tasks = page.evaluate("() => [counted.frames, counted.tasks]")
        seen = page.evaluate(READ_PICTURES, 5_000)
    gaps = [after - before for before, after in pairwise(frames)]
    differ = sum(one != other for one, other in pairwise(seen["pictures"]))
    return [
        Figure(
            "frames drawn, 20 vehicles, 1440 × 900", len(gaps) / (sum(gaps) / 1_000), "a second", 59, True
        ),
        Figure("longest from one frame to the next", max(gaps), "ms"),
        Figure("long tasks (over 50 ms)", len(tasks), f"in {at.seconds:g} s", 0),
        Figure("pictures that differ, while each is read back", differ / seen["seconds"], "a second"),
    ]


def heap(at: Place) -> list[Figure]:
    """What a running road leaves behind."""

    def used(line: CDPSession) -> dict[str, float]:
        for _ in range(3):
            line.send("HeapProfiler.collectGarbage")
        found = {each["name"]: each["value"] for each in line.send("Performance.getMetrics")["metrics"]}
        return {**found, "heap": line.send("Runtime.getHeapUsage")["usedSize"]}

    with at.page(at.road(vehicles=20)) as (page, line):
        page.wait_for_timeout(30_000 if at.minutes >= 2 else 5_000)
        before = used(line)
        page.wait_for_timeout(60_000 * at.minutes)
        after = used(line)
    grown = {name: after[name] - before[name] for name in ("heap", "Nodes", "JSEventListeners")}
    return [
        Figure(f"heap grown in {at.minutes:g} min", grown["heap"] / 1e6, "MB", 5),
        Figure("heap after that", after["heap"] / 1e6, "MB"),
        Figure("nodes more", grown["Nodes"], f"({after['Nodes']:.0f} in all)"),
        Figure("listeners more", grown["JSEventListeners"], f"({after['JSEventListeners']:.0f} in all)"),
    ]


def wire(at: Place) -> list[Figure]:
    """What one page is sent while a road runs at two ticks a second."""
    sizes: list[int] = []

    def note(event: dict[str, Any]) -> None:
        sizes.append(len(event["response"]["payloadData"].encode()))

    figures = []
    for name, path, aim in (
        ("a road as it is given", at.road(), 2_000),
        ("20 vehicles", at.road(vehicles=20), None),
    ):
        with at.page(path) as (page, line):
            page.wait_for_timeout(SETTLE_MS)
            sizes.clear()
            line.on("Network.webSocketFrameReceived", note)
            page.wait_for_timeout(1_000 * at.seconds)
            rate = sum(sizes) / at.seconds
        figures.append(Figure(f"sent over the stream at 2 Hz before packing, {name}", rate, "B/s", aim))
    return figures


def command(at: Place) -> list[Figure]:
    """From Enter to the change on the page."""
    with at.page(at.road()) as (page, _):
        page.wait_for_timeout(SETTLE_MS)
        page.evaluate(TIME_COMMANDS)
        words = page.locator("#words")
        for turn in range(50):
            words.fill("undo" if turn % 2 else "add a pothole ahead")
            page.wait_for_timeout(250)  # as a person: what it will do is shown before Enter
            words.press("Enter")
            page.wait_for_function("(many) => took.length > many", arg=turn)
        took = sorted(page.evaluate("() => took"))
    return [
        Figure("from Enter to the change shown, p50 of 50", median(took), "ms", 50),
        Figure("from Enter to the change shown, p95 of 50", took[47], "ms"),
    ]


def load(at: Place) -> list[Figure]:
    """From going there to the first frame of a live road, with nothing kept from before."""
    took = []
    for _ in range(5):
        with at.page("/", FIRST_FRAME) as (page, _):
            page.wait_for_function("() => window.firstFrame > 0")
            took.append(page.evaluate("() => window.firstFrame"))
    return [
        Figure("first load to first live frame, p50 of 5", median(took), "ms", 1_000),
        Figure("first load to first live frame, most of 5", max(took), "ms"),
    ]


def weight(at: Place) -> list[Figure]:
    """What the first live frame takes and what follows by itself, with nothing kept from before."""
    with at.page("/", FIRST_FRAME) as (page, _):
        page.wait_for_function("() => window.firstFrame > 0")
        page.wait_for_timeout(SETTLE_MS)
        sizes = page.evaluate(WEIGH)
    first = [(sent, whole) for sent, whole, early in sizes if early]
    return [
        Figure("first load as sent", sum(sent for sent, _ in first) / 1e3, "kB", 135),
        Figure("first load unpacked", sum(whole for _, whole in first) / 1e3, "kB"),
        Figure("files of the first load", len(first), "requests"),
        Figure(
            "fetched by itself after the first frame, as sent",
            sum(sent for sent, _, early in sizes if not early) / 1e3,
            "kB",
        ),
    ]


PARTS: dict[str, Callable[[Place], list[Figure]]] = {
    each.__name__: each for each in (smooth, wire, command, load, weight, heap)
}


def main(arguments: list[str] | None = None) -> None:
    """Measure, print, and write the table when all of it was measured."""
    options = _options([] if arguments is None else arguments)
    figures: list[Figure] = []
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        service = ServiceProcess(Path(folder) / "page.db")
        service.start()
        browser = playwright.chromium.launch(executable_path=chromium(), args=QUIET)
        version = browser.version
        try:
            at = Place(browser, service.url, options.seconds, options.minutes)
            for name in options.only or PARTS:
                for figure in PARTS[name](at):
                    figures.append(figure)
                    print(figure.line())
                    sys.stdout.flush()
        finally:
            browser.close()
            service.kill()
    if not options.only:
        RESULTS.write_text(_document(figures, version), encoding="utf-8")


def _document(figures: list[Figure], version: str) -> str:
    rows = "\n".join(figure.line() for figure in figures)
    return f"""# The page

Written by `python -m bench.page`. {machine()}; Chromium {version}, headless, without a graphics card;
service, browser and measurement on the same machine.

| what | measured | aim | holds |
| --- | ---: | ---: | --- |
{rows}

Frames are counted where the page drew one. The heap is what is left after collecting garbage. Weight is
of bodies only. The first load is what is asked for before the first live frame; the palette, help, metrics
and what works on the road by hand follow by themselves, other parts when they are wanted.
"""


def _plain(value: float) -> str:
    if value == int(value):
        return f"{int(value):,}"
    return f"{value:,.1f}" if abs(value) < 1_000 else f"{value:,.0f}"


def _options(arguments: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="bench.page", description="The page, measured.")
    parser.add_argument("--seconds", type=float, default=20.0)
    parser.add_argument("--minutes", type=float, default=10.0, help="how long the heap is watched")
    parser.add_argument("--only", nargs="+", choices=sorted(PARTS), help="these parts; nothing is written")
    return parser.parse_args(arguments)


if __name__ == "__main__":
    main(sys.argv[1:])
