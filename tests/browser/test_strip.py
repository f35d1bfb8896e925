"""The strip under the timeline: risk, regret and clearance of the whole run, and its worst moments."""

from __future__ import annotations

from playwright.sync_api import expect

from tests.browser.conftest import Visit
from tests.browser.visitor import Visitor
from tests.support.axe import violations
from tests.support.service_process import ServiceProcess

LEFT_EDGES = """
() => ["#timeline .line-canvas", ".strip-canvas"].map((name) => {
  const { left, width } = document.querySelector(name).getBoundingClientRect();
  return [Math.round(left), Math.round(width)];
})
"""
INKED = """
() => [...document.querySelectorAll(".strip-canvas")].map((canvas) =>
  canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.filter((part) => part).length)
"""


def crowded(visit: Visit, service: ServiceProcess, **context: object) -> Visitor:
    session = service.session(seed=16, paused=True, config={"vehicles": 24, "potholes": 4})
    visitor = visit(f"/#/s/{session}", **context)
    visitor.script.act({"do": "step", "ticks": 60})
    return visitor


def test_the_whole_run_is_judged_and_a_press_goes_there(visit: Visit, service: ServiceProcess) -> None:
    visitor = crowded(visit, service, reduced_motion="reduce")
    page = visitor.page
    page.get_by_role("button", name="Show the whole run").click()
    worst = page.locator(".strip [data-worst]")
    expect(worst.first).to_be_visible()
    line, strip = page.evaluate(LEFT_EDGES)
    assert line == strip, "both are drawn on one axis"
    assert all(part > 500 for part in page.evaluate(INKED))
    assert violations(visitor) == []
    tick = worst.first.get_attribute("data-worst")
    worst.first.click()
    expect(page.locator("[data-figure=tick] .figure-value")).to_have_text(str(tick))
    page.locator("[data-measure=clearance]").click(position={"x": line[1] / 2, "y": 20})
    expect(page.locator("[data-figure=tick] .figure-value")).to_have_text("32")
    page.get_by_role("button", name="Hide the whole run").click()
    expect(page.locator("#strip")).to_be_hidden()


def test_it_is_shown_by_a_sentence(visit: Visit, service: ServiceProcess) -> None:
    visitor = crowded(visit, service)
    visitor.say("risk of the whole run")
    expect(visitor.page.locator(".strip-told").first).to_contain_text("of 6 blocked")
