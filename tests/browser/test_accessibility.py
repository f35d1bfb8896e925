"""axe finds nothing, in both themes, wide and narrow, in every state; a first minute without a mouse."""

from __future__ import annotations

from typing import Any

import pytest
from playwright.sync_api import expect

from tests.browser.conftest import Visit
from tests.support.axe import violations
from tests.support.service_process import ServiceProcess

DESKTOP: dict[str, Any] = {"viewport": {"width": 1440, "height": 900}}
PHONE: dict[str, Any] = {"viewport": {"width": 360, "height": 740}, "has_touch": True, "is_mobile": True}


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("size", [DESKTOP, PHONE], ids=["desktop", "phone"])
def test_axe_finds_nothing(visit: Visit, scheme: str, size: dict[str, Any]) -> None:
    visitor = visit(color_scheme=scheme, reduced_motion="reduce", **size)
    visitor.pause()
    states = {"first visit": violations(visitor)}
    visitor.say("add five potholes")
    visitor.say("add five flibbers")
    visitor.say("slow down")
    visitor.say("why did you do that?")
    states["talk"] = violations(visitor)
    expect(visitor.typed("add fi").first).to_be_visible()
    states["completion"] = violations(visitor)
    visitor.page.keyboard.press("Escape")
    visitor.page.keyboard.press("Control+k")
    expect(visitor.page.get_by_role("dialog").get_by_role("option").nth(12)).to_be_visible()
    states["palette"] = violations(visitor)
    visitor.page.keyboard.press("Escape")
    visitor.page.locator("#help").click()
    expect(visitor.page.get_by_role("region", name="Sentences")).to_be_visible()
    states["help"] = violations(visitor)
    assert {name: found for name, found in states.items() if found} == {}


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_nothing_at_the_end_of_an_episode(
    service: ServiceProcess, visit: Visit, scheme: str
) -> None:
    # A road on which it arrives after 29 ticks; on others it may be stuck for long.
    visitor = visit(
        f"/#/s/{service.session(seed=1, paused=True)}", color_scheme=scheme, reduced_motion="reduce"
    )
    while visitor.script.state()["status"] == "running":
        visitor.script.act({"do": "step", "ticks": 1})
        assert visitor.script.state()["tick"] < 60
    expect(visitor.page.locator(".verdict")).to_be_visible()
    assert violations(visitor) == []


@pytest.mark.parametrize(
    "size", [(1366, 768), (844, 390), (720, 450)], ids=lambda size: f"{size[0]}x{size[1]}"
)
@pytest.mark.parametrize("locale", ["en-GB", "de-DE"])
def test_axe_finds_nothing_in_any_panel_on_a_low_screen(
    visit: Visit, size: tuple[int, int], locale: str
) -> None:
    visitor = visit(viewport={"width": size[0], "height": size[1]}, locale=locale, reduced_motion="reduce")
    states = {"first": violations(visitor)}
    for name in ("plan", "occupancy", "metrics", "log"):
        tab = f".tab[data-tab={name}]" if size[0] < 960 else f"[data-enlarge={name}]"
        visitor.page.locator(tab).click()
        visitor.drawn()
        states[name] = violations(visitor)
        if size[0] >= 960:
            visitor.page.keyboard.press("Escape")
            visitor.drawn()
    visitor.page.locator("#planner-menu .menu-button").click()
    states["planner"] = violations(visitor)
    visitor.page.keyboard.press("Escape")
    visitor.page.locator("#session-menu .menu-button").click()
    visitor.page.locator("#session-menu [data-item=settings]").click()
    expect(visitor.page.locator("#settings input").first).to_be_visible()
    states["settings"] = violations(visitor)
    assert {name: found for name, found in states.items() if found} == {}


def test_the_whole_first_minute_without_a_mouse(visit: Visit) -> None:
    visitor = visit(running=True)
    session = visitor.session
    page, press = visitor.page, visitor.page.keyboard.press
    focused = "document.activeElement"
    press("Tab")
    assert page.evaluate(f"{focused}.className") == "skip"
    press("Enter")
    expect(visitor.words).to_be_focused()
    page.keyboard.type("add five pot")
    expect(visitor.offered().first).to_be_visible()
    press("Tab")
    press("Enter")
    before = visitor.last_exchange("add five potholes")
    expect(before.locator(".change")).to_have_count(1)
    page.keyboard.type("why did you do that?")
    press("Enter")
    expect(visitor.last_exchange("why did you do that?").locator(".reply")).to_be_visible()
    press("Escape")
    expect(visitor.words).not_to_be_focused()
    press("Space")
    expect(page.locator(".paused")).to_be_visible()
    tick = visitor.tick()
    press("ArrowRight")
    expect(page.locator("[data-figure=tick] .figure-value")).to_have_text(str(tick + 1))
    press("u")
    expect(page.locator(".log-line").last).to_contain_text("Taken back")
    press("?")
    expect(page.get_by_role("dialog", name="What can I say?")).to_be_visible()
    press("Escape")
    expect(page.get_by_role("dialog")).to_have_count(0)
    press("Control+k")
    page.keyboard.type("resume")
    press("Enter")
    expect(page.locator(".paused")).to_be_hidden()
    press("Slash")
    expect(visitor.words).to_be_focused()
    assert visitor.session == session, "the way to the box leads to no other session"


def test_every_control_can_be_reached_and_is_seen_to_be(visit: Visit) -> None:
    """Tab goes round the whole page, each stop has a name and an outline, and none holds the focus."""
    visitor = visit()
    visitor.pause()
    page = visitor.page
    told = """() => {
      const at = document.activeElement, style = getComputedStyle(at);
      const name = at.getAttribute("aria-label") || at.innerText || at.labels?.[0]?.innerText || at.id;
      return [name, at === document.body || parseFloat(style.outlineWidth) > 0, at === document.body];
    }"""
    stops = []
    for _ in range(150):
        page.keyboard.press("Tab")
        name, outlined, around = page.evaluate(told)
        if around:
            break
        stops.append(name)
        assert name, stops
        assert outlined, name
    else:
        raise AssertionError(f"no way round: {stops[-3:]}")
    assert len(stops) >= 12


@pytest.mark.parametrize("locale", ["en-GB", "de-DE"])
def test_what_can_be_said_stands_under_headings_that_people_read(visit: Visit, locale: str) -> None:
    visitor = visit("/", locale=locale)
    visitor.page.locator("#help").click()
    expect(visitor.page.locator(".help-intent").nth(9)).to_be_visible()
    texts = visitor.page.evaluate("async () => await globalThis.pageTexts")
    known = {text for key, text in texts.items() if key.startswith("help.headings.")}
    found = visitor.page.locator(".help-intent h3").all_inner_texts()
    assert len(found) == len(set(found))
    assert set(found) <= known | {texts["help.taught"]}
    assert texts["help.headings.more"] not in found, "a kind of sentence has no heading"
