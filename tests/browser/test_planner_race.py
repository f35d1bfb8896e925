"""Planner beside planner on one road: in step, the first difference told, under a link of its own."""

from __future__ import annotations

import re

from playwright.sync_api import expect

from tests.browser.conftest import Visit
from tests.support.axe import violations
from tests.support.service_process import ServiceProcess


def test_two_planners_drive_one_road_and_where_they_part_is_told(
    visit: Visit, service: ServiceProcess
) -> None:
    session = service.session(seed=16, paused=True, config={"vehicles": 24, "potholes": 4})
    visitor = visit(f"/#/s/{session}", reduced_motion="reduce")
    visitor.script.act({"do": "step", "ticks": 20})
    before = visitor.script.state()["digest"]
    page = visitor.page
    page.locator("#planner-menu .menu-button").click()
    page.get_by_role("menuitem", name=re.compile("Compare planners")).click()
    beside = page.locator("#beside")
    expect(beside.locator("[data-part]")).to_be_visible()
    told = beside.locator(".beside-part")
    expect(told).to_contain_text("Rules:")
    expect(told).to_contain_text("A*:")
    assert violations(visitor) == []
    beside.locator("[data-part]").click()
    tick = re.search(r"\d+", beside.locator("[data-part]").inner_text())
    assert tick
    expect(beside.locator(".beside-tick")).to_have_text(f"tick {tick[0]}")
    beside.get_by_label("Planner on the right").select_option("dijkstra")
    expect(told).to_contain_text("Dijkstra:")
    assert f"#/c/{session}/rules/dijkstra" in page.url
    beside.get_by_label("Planner on the left").select_option("dijkstra")
    expect(told).to_have_text("Both drive the same way to the end.")
    page.keyboard.press("Escape")
    expect(beside).to_be_hidden()
    assert f"#/s/{session}" in page.url
    assert visitor.script.state()["digest"] == before


def test_a_link_opens_it_and_a_sentence_does(visit: Visit, service: ServiceProcess) -> None:
    session = service.session(seed=16, paused=True, config={"vehicles": 24})
    visitor = visit(f"/#/s/{session}")
    visitor.say("compare with Dijkstra")
    expect(visitor.page.locator("#beside .beside-part")).to_contain_text("Dijkstra:")
    visitor.page.goto("about:blank")
    visitor.page.goto(f"{service.url}/#/c/{session}/priority/bfs")
    expect(visitor.page.locator("#beside .beside-part")).to_contain_text("Quickest:")
    expect(visitor.page.get_by_label("Planner on the left")).to_have_value("priority")
