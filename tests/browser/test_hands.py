"""Pointing, touching, driving, and watching what would have been, as a person at the page does it."""

from __future__ import annotations

import re
from typing import Any

import httpx
import pytest
from playwright.sync_api import Locator, expect

from tests.browser.conftest import Visit
from tests.browser.service_process import ServiceProcess
from tests.browser.visitor import Visitor

Cell = list[int]

PLACE_OF = """
async (cell) => {
  const { viewUnder } = await import("/src/hits.js");
  const { places } = viewUnder(document.querySelector(".road-hands"));
  const { left, top, width, height } = places.placeOf(cell);
  return [left + width / 2, top + height / 2];
}
"""


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
        words = f"{count} {kind}s?" if count else "."
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


@pytest.fixture
def road(visit: Visit, service: ServiceProcess) -> Road:
    return empty_road(visit, service)


def empty_road(visit: Visit, service: ServiceProcess, **context: Any) -> Road:
    made = httpx.post(f"{service.url}/api/v1/sessions", json={"seed": 7, "paused": True})
    found = Road(visit(f"/#/s/{made.json()['id']}", **context))
    found.script.act({"do": "remove", "kind": "everything", "count": "all"})
    expect(found.page.locator("#road .road-canvas").first).to_have_attribute(
        "aria-label", re.compile("nothing on it")
    )
    return found


# Why: the bubble


def test_resting_on_a_thing_tells_what_it_is_and_escape_sends_it_away(road: Road) -> None:
    name = road.put("barrier", road.ahead(3))
    road.point(road.ahead(3))
    expect(road.bubble).to_be_visible()
    expect(road.bubble).to_contain_text("Barrier")
    expect(road.bubble).to_contain_text(name)
    expect(road.bubble).to_contain_text("its own, 3 rows ahead · 15 m")
    expect(road.page.locator(".cell-mark")).to_be_visible()
    road.page.keyboard.press("Escape")
    expect(road.bubble).to_be_hidden()


def test_the_bubble_stays_while_the_pointer_is_on_it_and_goes_when_it_leaves(road: Road) -> None:
    road.put("pothole", road.ahead(2))
    road.point(road.ahead(2))
    expect(road.bubble).to_be_visible()
    road.bubble.hover()
    expect(road.bubble.get_by_role("button", name="Remove")).to_be_visible()
    road.page.mouse.move(2, 2)
    expect(road.bubble).to_be_hidden()


def test_the_bubble_is_never_clipped_nor_on_the_vehicle(road: Road) -> None:
    view = road.page.viewport_size
    assert view is not None
    for cell in (road.ahead(1), [0, road.ego[1]], [7, road.ego[1] - 5]):
        road.page.mouse.click(*road.at(cell))
        expect(road.bubble).to_be_visible()
        box = road.bubble.bounding_box()
        assert box is not None
        assert box["x"] >= 0
        assert box["y"] >= 0
        assert box["x"] + box["width"] <= view["width"]
        assert box["y"] + box["height"] <= view["height"]
        x, y = road.at(road.ego)
        over = box["x"] < x < box["x"] + box["width"] and box["y"] < y < box["y"] + box["height"]
        assert not over, cell
        road.page.keyboard.press("Escape")


def test_a_cause_is_told_and_asked_about(road: Road) -> None:
    name = road.put("barrier", road.ahead(1))
    cell = road.ahead(1)
    road.script.act({"do": "step", "ticks": 1})
    road.page.mouse.click(*road.at(cell))
    expect(road.bubble).to_contain_text("It ruled out forward: a barrier.")
    road.bubble.get_by_role("button", name="Ask why").click()
    expect(road.bubble).to_be_hidden()
    answer = road.page.locator(".exchange").last
    expect(answer.locator(".said")).to_contain_text(re.compile(r"Why .+ at tick 0\?"))
    expect(answer.locator(".cause-name")).to_have_text(name)


def test_free_road_takes_what_is_put_there_from_the_bubble(road: Road) -> None:
    cell = road.ahead(4, 1)
    road.page.mouse.click(*road.at(cell))
    expect(road.bubble).to_contain_text("Free road")
    road.bubble.get_by_role("button", name="Walker").click()
    road.done("Put a walker here")
    assert road.in_cell(cell) == ["pedestrian-1"] or road.in_cell(cell)[0].startswith("pedestrian")


def test_the_bubble_goes_with_what_moves(road: Road) -> None:
    road.put("vehicle", road.ahead(6))
    road.page.mouse.click(*road.at(road.ahead(6)))
    expect(road.bubble).to_contain_text("Car")
    lanes = road.bubble.locator(".bubble-lines > :first-child")
    before, place = lanes.inner_text(), road.bubble.bounding_box()
    road.script.act({"do": "step", "ticks": 1})
    expect(lanes).not_to_have_text(before)
    road.page.wait_for_function(
        "([x, y]) => { const at = document.querySelector('#bubble').getBoundingClientRect();"
        " return Math.abs(at.x - x) + Math.abs(at.y - y) > 20; }",
        arg=[place["x"], place["y"]] if place else [0, 0],
    )
    expect(road.bubble).to_contain_text("Car")


def test_the_schematic_tells_too(road: Road) -> None:
    name = road.put("barrier", road.ahead(12))
    canvas = road.page.locator("#schematic canvas")
    x, y = road.page.evaluate(
        """async (cell) => {
          const { viewUnder } = await import("/src/hits.js");
          const at = viewUnder(document.querySelector("#schematic canvas")).places.placeOf(cell);
          return [at.left + at.width / 2, at.top + at.height / 2];
        }""",
        road.ahead(12),
    )
    expect(canvas).to_be_visible()
    road.page.mouse.move(x, y - 40)
    road.page.mouse.move(x, y)
    expect(road.bubble).to_contain_text(name)


def test_a_past_decision_in_the_log_tells_its_moves_by_keyboard(road: Road) -> None:
    for _ in range(3):
        road.script.act({"do": "step", "ticks": 1})
    row = road.page.locator('.log-line[data-type="tick"]').last
    expect(row).to_be_visible()
    road.page.locator(".log-lines").focus()
    road.page.keyboard.press("ArrowUp")
    expect(row).to_be_focused()
    expect(road.bubble).to_contain_text("tick")
    expect(road.bubble.locator(".bubble-move").first).to_be_visible()
    road.page.keyboard.press("Enter")
    expect(road.bubble.locator(".bubble-move").first).to_be_focused()
    road.page.keyboard.press("Escape")
    expect(row).to_be_focused()


# What would have been


def test_a_move_that_was_not_made_plays_beside_the_real_run(road: Road) -> None:
    road.put("barrier", road.ahead(1))
    road.script.act({"do": "step", "ticks": 1})
    before = road.script.state()
    expect(road.page.locator("[data-figure=tick] .figure-value")).to_have_text("1")
    road.page.mouse.click(*road.at(road.ego))
    road.bubble.locator(".bubble-move", has_text="a barrier").click()
    expect(road.beside).to_be_visible()
    expect(road.page.locator("#beside-title")).to_have_text("If it had gone forward at tick 0")
    expect(road.beside.locator("[data-side=real] .beside-end")).to_contain_text("arrives after")
    expect(road.beside.locator("[data-side=changed] .beside-end")).to_have_text(
        "crashes into a barrier at tick 1"
    )
    expect(road.beside.locator("[data-side=changed] .beside-verdict")).to_have_text("Crash")
    expect(road.beside.locator("[data-side=real] .beside-verdict")).to_be_hidden()
    slider = road.beside.locator(".beside-slider")
    road.page.keyboard.press("End")
    expect(road.beside.locator("[data-side=real] .beside-verdict")).to_have_text("Arrived")
    expect(slider).to_have_value(slider.get_attribute("max") or "")
    road.page.keyboard.press("Home")
    expect(road.beside.locator(".beside-tick")).to_have_text("tick 0")
    expect(road.beside.locator("[data-side=changed] .beside-verdict")).to_be_hidden()
    road.page.keyboard.press("Escape")
    expect(road.beside).to_be_hidden()
    assert road.script.state() == before


def test_the_two_play_in_step_and_stop_when_told(road: Road) -> None:
    road.script.act({"do": "step", "ticks": 1})
    road.page.mouse.click(*road.at(road.ego))
    road.bubble.locator(".bubble-move", has_text="stay").click()
    tick = road.beside.locator(".beside-tick")
    expect(tick).to_have_text("tick 2", timeout=5_000)
    labels = [
        road.beside.locator(f"[data-side={side}] canvas").get_attribute("aria-label")
        for side in ("real", "changed")
    ]
    assert labels[0] != labels[1]
    road.page.keyboard.press("Space")
    expect(road.beside.get_by_role("button", name="Play both")).to_be_visible()
    stood = tick.inner_text()
    road.page.keyboard.press("ArrowRight")
    expect(tick).to_have_text(f"tick {int(stood.split()[1]) + 1}")
    expect(road.beside.locator(".beside-summary")).to_contain_text("It arrives 1 tick later.")
    assert road.script.state()["tick"] == 1


def test_a_move_in_the_plan_can_be_watched(road: Road) -> None:
    road.put("barrier", road.ahead(1))
    way = road.page.locator("#plan button", has_text="Forward").filter(has_text="barrier")
    way.click()
    expect(road.page.locator("#beside-title")).to_have_text("If it had gone forward at tick 0")
    expect(road.beside.locator("[data-side=changed] .beside-end")).to_contain_text("crashes into a barrier")
    expect(road.beside.locator("[data-side=real] .beside-end")).to_contain_text("arrives")


def test_the_past_is_told_and_not_changed(road: Road) -> None:
    start = road.ahead(4)
    name = road.put("barrier", start)
    for _ in range(2):
        road.script.act({"do": "step", "ticks": 1})
    expect(road.page.locator("[data-figure=tick] .figure-value")).to_have_text("2")
    road.page.keyboard.press("ArrowLeft")
    expect(road.page.locator("[data-figure=tick] .figure-value")).to_have_text("1")
    road.page.mouse.click(*road.at(start))
    expect(road.bubble).to_contain_text("3 rows ahead")
    expect(road.bubble.get_by_role("button", name="Remove")).to_have_count(0)
    road.bubble.get_by_role("button", name="What if it weren't there?").click()
    expect(road.beside.locator(".beside-tick")).to_contain_text(re.compile("tick [123]"))
    expect(road.page.locator("#beside-title")).to_have_text(f"If {name} wasn’t there")
    road.page.keyboard.press("Escape")
    road.drag(road.at(start), road.at(road.ahead(1, 1)))
    expect(road.page.locator(".road-toast")).to_contain_text("This is the past")
    assert road.in_cell(start) == [name]


def test_the_services_drawing_is_pointed_at_like_the_pages_own(road: Road) -> None:
    name = road.put("barrier", road.ahead(3, 2))
    road.page.locator("#views-menu button").first.click()
    road.page.get_by_text("Drawn by the service").click()
    road.page.keyboard.press("Escape")
    expect(road.page.locator(".service-canvas")).to_be_visible()
    x, y = road.at(road.ahead(3, 2))
    road.page.mouse.click(x, y)
    expect(road.bubble).to_contain_text(name)


def test_who_wants_little_motion_gets_the_tick_where_they_part(visit: Visit, service: ServiceProcess) -> None:
    road = empty_road(visit, service, reduced_motion="reduce")
    road.script.act({"do": "step", "ticks": 2})
    expect(road.page.locator("[data-figure=tick] .figure-value")).to_have_text("2")
    road.page.mouse.click(*road.at(road.ego))
    road.bubble.locator(".bubble-move", has_text="stay").click()
    expect(road.beside.locator(".beside-tick")).to_have_text("tick 2")
    expect(road.beside.get_by_role("button", name="Play both")).to_be_visible()


def test_imagining_a_thing_away_answers_and_plays(road: Road) -> None:
    name = road.put("barrier", road.ahead(2))
    road.page.mouse.click(*road.at(road.ahead(2)))
    road.bubble.get_by_role("button", name="What if it weren't there?").click()
    expect(road.page.locator("#beside-title")).to_have_text(f"If {name} wasn’t there")
    expect(road.beside.locator("[data-side=changed] canvas")).to_have_attribute(
        "aria-label", re.compile("nothing on it")
    )
    expect(road.beside.locator("[data-side=real] canvas")).to_have_attribute(
        "aria-label", re.compile("1 barrier")
    )
    expect(road.page.locator(".exchange").last.locator(".answer")).to_contain_text("If ")
    assert road.script.count("barrier") == 1


def test_other_moves_of_an_answer_can_be_watched(road: Road) -> None:
    road.put("barrier", road.ahead(1))
    road.script.act({"do": "step", "ticks": 1})
    answer = road.visitor.say("why did you do that?")
    answer.locator(".alternatives summary").click()
    answer.get_by_role("button", name="Watch forward beside the real run").click()
    expect(road.beside.locator("[data-side=changed] .beside-end")).to_contain_text("crashes into a barrier")
    road.beside.get_by_role("button", name="Close the comparison").click()
    expect(road.beside).to_be_hidden()
    answer.get_by_role("button", name="Watch it beside the real run", exact=True).click()
    expect(road.page.locator("#beside-title")).to_contain_text("wasn’t there")


# Touching


def test_a_thing_is_dragged_to_another_cell_and_one_undo_takes_it_back(road: Road) -> None:
    start, end = road.ahead(3), road.ahead(2, 2)
    road.put("pothole", start)
    road.drag(road.at(start), road.at(end))
    road.done("Move pothole")
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
    expect(said).to_have_text(re.compile("its own, 3 rows ahead: pothole"))
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
    road.done("Move pothole")
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
    keys.down("ArrowUp")
    keys.down("ArrowRight")
    keys.up("ArrowRight")
    keys.up("ArrowUp")
    expect(shown).to_have_text("2")
    assert road.ego == [column + 1, row - 2]
    keys.press("7")
    expect(shown).to_have_text("3")
    assert road.ego == [column, row - 3]
    road.page.get_by_role("group", name="Drive").get_by_role("button", name="right", exact=True).click()
    expect(shown).to_have_text("4")
    assert road.ego == [column + 1, row - 3]
    road.page.get_by_role("button", name="Let it drive itself").click()
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
    road.done("Remove pothole")
    assert road.script.count("pothole") == 0
    x, y = road.at(road.ahead(3, 1))
    client = road.page.context.new_cdp_session(road.page)
    gesture = {"x": x, "y": y, "yDistance": -200, "gestureSourceType": "touch"}
    client.send("Input.synthesizeScrollGesture", gesture)
    road.page.wait_for_function("scrollY > 100")


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
    road.done("Move barrier")
    assert len(road.in_cell(end)) == 1
