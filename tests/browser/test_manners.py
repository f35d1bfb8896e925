"""Themes, forced colours, fingers, zoom, a keyboard on the screen, and a page that does not grow."""

from __future__ import annotations

from typing import Any

import pytest
from playwright.sync_api import expect

from tests.browser.conftest import Visit
from tests.browser.visitor import Visitor, until
from tests.support.axe import FAINT_TEXT, violations

PHONES: list[dict[str, Any]] = [
    {"viewport": {"width": 360, "height": 740}, "has_touch": True, "is_mobile": True},
    {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True},
]

SMALL_TARGETS = """
(least) => [...document.querySelectorAll("button, a[href], input, select, summary, [role=button]")]
  .filter((one) => one.checkVisibility({ checkVisibilityCSS: true }) && !one.closest(".unseen, [inert]")
    && !one.matches(".skip, :disabled"))
  .map((one) => [one, (one.closest("label") ?? one).getBoundingClientRect()])
  .filter(([, box]) => box.width > 0 && (box.width < least - 0.5 || box.height < least - 0.5))
  .map(([one, box]) => `${one.className || one.id}: ${one.getAttribute("aria-label") ?? one.textContent}`
    + ` ${box.width.toFixed()} × ${box.height.toFixed()}`)
"""

STICKS_OUT = """
() => {
  const wide = document.documentElement.clientWidth;
  const whole = document.documentElement.scrollWidth;
  const found = whole > wide ? [`page ${whole}`] : [];
  for (const one of document.querySelectorAll("body *")) {
    if (!one.checkVisibility({ checkVisibilityCSS: true }) || one.closest(".unseen, .skip")) continue;
    const box = one.getBoundingClientRect();
    let inside = false;
    for (let up = one.parentElement; up; up = up.parentElement)
      inside ||= getComputedStyle(up).overflowX !== "visible";
    const out = box.right > wide + 1 || box.left < -1;
    if (!inside && box.width > 0 && out) found.push(one.className || one.tagName);
  }
  return found;
}
"""

GROUND = "() => getComputedStyle(document.body).backgroundColor"


def choose_theme(visitor: Visitor, name: str) -> None:
    visitor.page.locator("#help").click()
    visitor.page.get_by_label("Colours").select_option(label=name)
    visitor.page.keyboard.press("Escape")
    expect(visitor.page.get_by_role("dialog")).to_have_count(0)


def test_a_chosen_theme_holds_against_the_systems_and_next_time(visit: Visit) -> None:
    visitor = visit(color_scheme="light", reduced_motion="reduce").bare()
    page = visitor.page
    light, road = page.evaluate(GROUND), visitor.settled()
    choose_theme(visitor, "Dark")
    until(page, f"(light) => ({GROUND})() !== light", light)
    dark = page.evaluate(GROUND)
    until(page, "() => getComputedStyle(document.documentElement).colorScheme === 'dark'")
    visitor.settled(unlike=road)  # the canvas follows
    assert page.evaluate(FAINT_TEXT) == []
    page.reload()
    visitor.wait_live()
    assert page.evaluate(GROUND) == dark
    choose_theme(visitor, "Light")
    page.emulate_media(color_scheme="dark")
    until(page, f"(light) => ({GROUND})() === light", light)
    choose_theme(visitor, "Match system")
    until(page, f"(dark) => ({GROUND})() === dark", dark)


def test_a_dark_choice_is_dark_before_anything_runs(visit: Visit) -> None:
    visitor = visit(color_scheme="light")
    choose_theme(visitor, "Dark")
    page = visitor.page
    page.route("**/src/main.js", lambda route: route.abort())
    page.reload()
    until(page, "() => getComputedStyle(document.documentElement).colorScheme === 'dark'")
    assert page.evaluate(GROUND) == "rgb(14, 16, 20)"
    visitor.forgive("Failed to load resource")


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_forced_colours_and_more_contrast_are_usable(visit: Visit, scheme: str) -> None:
    visitor = visit(color_scheme=scheme, reduced_motion="reduce", forced_colors="active", contrast="more")
    visitor.pause()
    visitor.say("add five potholes")
    visitor.say("why did you do that?")
    assert violations(visitor) == []
    told = visitor.page.evaluate(
        """() => {
          const seen = (one) => getComputedStyle(one);
          const button = seen(document.querySelector(".controls button"));
          const lamp = seen(document.querySelector(".lamp")), panel = seen(document.querySelector(".panel"));
          const told = lamp.backgroundColor !== panel.backgroundColor;
          return [button.borderTopStyle, panel.borderTopStyle, told];
        }"""
    )
    assert told == ["solid", "solid", True]


@pytest.mark.parametrize("phone", PHONES, ids=["360", "390"])
def test_on_a_phone_nothing_sticks_out_and_every_target_can_be_hit(
    visit: Visit, phone: dict[str, Any]
) -> None:
    visitor = visit(**phone)
    visitor.step(9)
    page = visitor.page
    states: dict[str, list[str]] = {}

    def look(name: str) -> None:
        visitor.coloured()
        states[name] = [*page.evaluate(STICKS_OUT), *page.evaluate(SMALL_TARGETS, 44)]

    look("first visit")
    visitor.say("add five potholes")
    visitor.say("slow down")
    visitor.say("why did you do that?")
    expect(visitor.page.locator(".alternatives summary")).to_be_visible()
    look("talk")
    page.get_by_role("button", name="Views", exact=True).click()
    look("views menu")
    page.keyboard.press("Escape")
    page.locator("#session-menu button").first.click()
    look("session menu")
    page.keyboard.press("Escape")
    page.locator("#help").click()
    expect(page.get_by_role("region", name="Sentences")).to_be_visible()
    look("help")
    page.keyboard.press("Escape")
    visitor.script.act({"do": "mode", "mode": "manual"})
    expect(page.locator(".drive-pad")).to_be_visible()
    look("driving by hand")
    wrong = {name: found for name, found in states.items() if found}
    assert not wrong, wrong


def test_fine_pointers_get_targets_of_28(visit: Visit) -> None:
    visitor = visit()
    visitor.pause()
    visitor.say("add five potholes")
    visitor.say("why did you do that?")
    assert visitor.page.evaluate(SMALL_TARGETS, 28) == []


def test_the_keyboard_on_a_phones_screen_hides_neither_box_nor_reply(visit: Visit) -> None:
    """What is left of 844 px over a keyboard is about 480."""
    visitor = visit(**PHONES[1])
    visitor.pause()
    visitor.say("add two potholes")
    visitor.page.set_viewport_size({"width": 390, "height": 480})
    visitor.words.tap()
    expect(visitor.words).to_be_in_viewport(ratio=1)
    exchange = visitor.say("add five potholes")
    expect(exchange.locator(".change").first).to_be_in_viewport(ratio=0.9)
    expect(visitor.words).to_be_in_viewport(ratio=0.9)


def test_enlarged_to_twice_its_size_everything_can_be_reached(visit: Visit) -> None:
    """At 200 % a window of 1440 × 900 is one of 720 × 450."""
    visitor = visit(viewport={"width": 720, "height": 450}, device_scale_factor=2)
    visitor.pause()
    assert visitor.page.evaluate(STICKS_OUT) == []
    exchange = visitor.say("why did you do that?")
    expect(exchange.locator(".reply")).to_be_in_viewport()
    for name in ("Resume", "Send"):
        button = visitor.page.get_by_role("button", name=name, exact=True)
        button.scroll_into_view_if_needed()
        expect(button).to_be_in_viewport(ratio=0.9)
        button.click(trial=True)
    for part in ("plan", "occupancy", "metrics", "log"):
        visitor.page.locator(f".tab[data-tab={part}]").click()
        expect(visitor.page.locator(f"[data-view={part}]")).to_be_in_viewport()


def test_a_long_run_does_not_grow_the_page(visit: Visit) -> None:
    visitor = visit()
    visitor.pause()
    nodes = "document.getElementsByTagName('*').length"
    for _ in range(3):
        visitor.step(100)
    first = visitor.page.evaluate(nodes)
    for _ in range(4):
        visitor.step(100)
        visitor.say("add two potholes")
        visitor.say("undo")
    assert visitor.page.evaluate(nodes) - first < 400
    assert visitor.page.evaluate(nodes) < 4_000
