"""Touching, the keyboard on the road, and driving, as a person at the page does it."""

from __future__ import annotations

import re

from playwright.sync_api import expect

from tests.browser.conftest import Visit
from tests.browser.hands import Road, empty_road
from tests.browser.visitor import until
from tests.support.service_process import ServiceProcess

# At one moment: keys are taken together when they are pressed within some milliseconds.
TWO_KEYS = """
(keys) => {
  for (const kind of ["keydown", "keyup"])
    for (const key of keys)
      document.body.dispatchEvent(new KeyboardEvent(kind, { key, bubbles: true, cancelable: true }));
}
"""

# Touching


def test_a_thing_is_dragged_to_another_cell_and_one_undo_takes_it_back(road: Road) -> None:
    start, end = road.ahead(3), road.ahead(2, 2)
    road.put("pothole", start)
    road.drag(road.at(start), road.at(end))
    road.done("Move the pothole")
    assert len(road.in_cell(end)) == 1
    assert road.in_cell(start) == []
    lines = road.page.locator(".log-line").count()
    assert road.bubble.is_hidden()
    road.page.keyboard.press("u")
    expect(road.page.locator(".log-line")).to_have_count(lines + 1)
    assert len(road.in_cell(start)) == 1
    assert road.in_cell(end) == []


def test_a_cell_that_is_taken_is_refused_while_dragging(road: Road) -> None:
    start = road.ahead(3)
    name = road.put("barrier", start)
    road.drag(road.at(start), road.at(road.ego), drop=False)
    expect(road.page.locator(".cell-target[data-no]")).to_be_visible()
    expect(road.page.locator(".ghost")).to_be_visible()
    expect(road.page.locator(".road-toast")).to_have_text("There is the vehicle already.")
    road.page.mouse.up()
    expect(road.page.locator(".ghost")).to_be_hidden()
    assert road.in_cell(start) == [name]


def test_escape_ends_a_drag(road: Road) -> None:
    start = road.ahead(3)
    name = road.put("barrier", start)
    road.drag(road.at(start), road.at(road.ahead(5)), drop=False)
    road.page.keyboard.press("Escape")
    road.page.mouse.up()
    expect(road.page.locator(".ghost")).to_be_hidden()
    assert road.in_cell(start) == [name]


def test_dragged_off_the_road_it_is_gone(road: Road) -> None:
    start = road.ahead(3)
    road.put("barrier", start)
    box = road.surface.bounding_box()
    assert box is not None
    road.drag(road.at(start), (box["x"] + box["width"] / 2, box["y"] + box["height"] + 60))
    road.done("off the road")
    assert road.script.count("barrier") == 0


def test_the_tray_gives_what_is_dragged_or_clicked(road: Road) -> None:
    page = road.page
    tool = page.locator(".tray-tool[data-kind=pothole]")
    expect(tool).to_be_hidden()
    page.get_by_role("button", name="Put things on the road").click()
    tool.hover()  # which waits until it has come to rest
    box = tool.bounding_box()
    assert box is not None
    first = road.ahead(3, -1)
    road.drag((box["x"] + 20, box["y"] + 20), road.at(first))
    road.done("Put a pothole")
    assert len(road.in_cell(first)) == 1
    page.locator(".tray-tool[data-kind=barrier]").click()
    expect(page.locator(".tray-tool[data-kind=barrier]")).to_have_attribute("aria-pressed", "true")
    for lanes in (1, 2):
        page.mouse.click(*road.at(road.ahead(4, lanes)))
        expect(page.locator("#road .road-canvas").first).to_have_attribute(
            "aria-label", re.compile(f"{lanes} barriers?")
        )
    assert road.script.count("barrier") == 2
    page.keyboard.press("Escape")
    expect(page.locator(".tray-tool[data-kind=barrier]")).to_have_attribute("aria-pressed", "false")


def test_what_the_service_refuses_is_said_over_the_road(road: Road) -> None:
    cell = road.ahead(3)
    name = road.put("barrier", cell)
    # Gone behind the page's back, at the very moment that it is dragged.
    road.drag(road.at(cell), road.at(road.ahead(5)), drop=False)
    road.script.act({"do": "remove", "kind": "barrier", "count": 1, "where": {"id": name}})
    road.page.mouse.up()
    expect(road.page.locator(".road-toast")).to_contain_text("Not done")


# By keyboard


def test_the_cursor_goes_from_cell_to_cell_and_says_what_is_there(road: Road) -> None:
    road.put("pothole", road.ahead(3))
    keys = road.page.keyboard
    road.page.locator("#status").click()
    road.surface.focus()
    keys.press("Home")
    expect(road.page.locator(".cell-cursor")).to_be_visible()
    said = road.page.locator(".road [aria-live=polite].unseen")
    expect(said).to_have_text(re.compile("its own, 2 rows ahead: free"))
    keys.press("ArrowUp")
    expect(said).to_have_text(re.compile("its own, 3 rows ahead: a pothole"))
    expect(road.bubble).to_contain_text("Pothole")
    assert road.visitor.tick() == 0
    keys.press("ArrowRight")
    expect(said).to_have_text(re.compile("3 rows ahead: free"))
    assert road.visitor.tick() == 0


def test_letters_put_delete_removes_m_moves(road: Road) -> None:
    keys = road.page.keyboard
    road.page.keyboard.press("Tab")
    road.surface.focus()
    keys.press("Home")
    cell = road.ahead(2)
    keys.press("p")
    road.done("Put a pothole")
    assert road.in_cell(cell)[0].startswith("pothole")
    assert road.script.state()["paused"] is True
    keys.press("m")
    expect(road.page.locator(".cell-cursor[data-holding]")).to_be_visible()
    keys.press("ArrowUp")
    keys.press("ArrowLeft")
    keys.press("m")
    road.done("Move the pothole")
    moved = [cell[0] - 1, cell[1] - 1]
    assert road.in_cell(moved)[0].startswith("pothole")
    assert road.script.state()["mode"] == "auto"
    keys.press("Delete")
    road.done("off the road")
    assert road.script.count("pothole") == 0
    keys.press("b")
    road.done("Put a barrier")
    keys.press("b")
    expect(road.page.locator(".road-toast")).to_have_text("There is a barrier already.")


def test_enter_goes_into_the_bubble_and_escape_back_to_the_road(road: Road) -> None:
    keys = road.page.keyboard
    keys.press("g")
    expect(road.surface).to_be_focused()
    keys.press("Enter")
    expect(road.bubble.get_by_role("button").first).to_be_focused()
    keys.press("Escape")
    expect(road.bubble).to_be_hidden()
    expect(road.surface).to_be_focused()


# Driving


def test_arrows_drive_where_a_person_drives(road: Road) -> None:
    keys = road.page.keyboard
    column, row = road.ego
    keys.press("m")
    expect(road.page.locator(".drive-pad")).to_be_visible()
    shown = road.page.locator("[data-figure=tick] .figure-value")
    keys.press("ArrowUp")
    expect(shown).to_have_text("1")
    assert road.ego == [column, row - 1]
    road.page.evaluate(TWO_KEYS, ["ArrowUp", "ArrowRight"])
    expect(shown).to_have_text("2")
    assert road.ego == [column + 1, row - 2]
    keys.press("7")
    expect(shown).to_have_text("3")
    assert road.ego == [column, row - 3]
    road.page.get_by_role("group", name="Drive").get_by_role("button", name="right", exact=True).click()
    expect(shown).to_have_text("4")
    assert road.ego == [column + 1, row - 3]
    road.page.locator(".drive-end").click()
    expect(road.page.locator(".drive-pad")).to_be_hidden()
    assert road.script.state()["mode"] == "auto"


def test_a_move_held_back_is_told_in_the_services_words(road: Road) -> None:
    road.put("barrier", road.ahead(1))
    before = road.ego
    road.page.keyboard.press("m")
    expect(road.page.locator(".drive-pad")).to_be_visible()
    road.page.keyboard.press("ArrowUp")
    expect(road.page.locator(".driving[data-held] .drive-words")).to_contain_text("barrier")
    assert road.ego == before


def test_p_pauses_and_goes_on(road: Road) -> None:
    road.page.keyboard.press("p")
    expect(road.page.locator(".paused")).to_be_hidden()
    road.page.keyboard.press("p")
    expect(road.page.locator(".paused")).to_be_visible()


# On a phone


def test_a_tap_tells_and_a_finger_on_free_road_still_scrolls(visit: Visit, service: ServiceProcess) -> None:
    road = empty_road(visit, service, viewport={"width": 390, "height": 844}, has_touch=True, is_mobile=True)
    cell = road.ahead(2)
    road.put("pothole", cell)
    road.page.touchscreen.tap(*road.at(cell))
    expect(road.bubble).to_contain_text("Pothole")
    box = road.bubble.bounding_box()
    assert box is not None
    assert box["x"] >= 0
    assert box["x"] + box["width"] <= 390
    road.bubble.get_by_role("button", name="Remove").tap()
    road.done("Remove the pothole")
    assert road.script.count("pothole") == 0
    x, y = road.at(road.ahead(3, 1))
    client = road.page.context.new_cdp_session(road.page)
    gesture = {"x": x, "y": y, "yDistance": -200, "gestureSourceType": "touch"}
    client.send("Input.synthesizeScrollGesture", gesture)
    until(road.page, "scrollY > 100")


def test_a_finger_drags_a_thing(visit: Visit, service: ServiceProcess) -> None:
    road = empty_road(visit, service, viewport={"width": 390, "height": 844}, has_touch=True, is_mobile=True)
    start, end = road.ahead(3), road.ahead(1, 2)
    road.put("barrier", start)
    client = road.page.context.new_cdp_session(road.page)

    def finger(kind: str, *points: tuple[float, float]) -> None:
        client.send(
            "Input.dispatchTouchEvent", {"type": kind, "touchPoints": [{"x": x, "y": y} for x, y in points]}
        )

    (x, y), (to_x, to_y) = road.at(start), road.at(end)
    finger("touchStart", (x, y))
    for share in (0.2, 0.5, 0.8, 1.0):
        finger("touchMove", (x + (to_x - x) * share, y + (to_y - y) * share))
    expect(road.page.locator(".ghost")).to_be_visible()
    assert road.page.evaluate("scrollY") == 0
    finger("touchEnd")
    road.done("Move the barrier")
    assert len(road.in_cell(end)) == 1
