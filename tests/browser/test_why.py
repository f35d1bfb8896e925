"""The bubble that tells of a thing, and watching what would have been, as a person at the page does it."""

from __future__ import annotations

import re

from playwright.sync_api import expect

from tests.browser.conftest import Visit
from tests.browser.hands import Road, empty_road
from tests.browser.visitor import until
from tests.support.service_process import ServiceProcess

# All at one moment: a tick later, the one behind is where the other was, and in the end both stand anyway.
STOPPED_APART = """
() => {
  const beside = document.querySelector("#beside");
  const label = (side) => beside.querySelector(`[data-side=${side}] canvas`).ariaLabel;
  const tick = Number(beside.querySelector(".beside-tick").textContent.split(" ")[1]);
  if (tick < 2 || label("real") === label("changed")) return false;
  beside.dispatchEvent(new KeyboardEvent("keydown", { key: " ", bubbles: true, cancelable: true }));
  return true;
}
"""

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
    road.step()
    road.page.mouse.click(*road.at(cell))
    expect(road.bubble).to_contain_text("Forward: a barrier")
    road.bubble.get_by_role("button", name="Ask why").click()
    expect(road.bubble).to_be_hidden()
    answer = road.page.locator(".exchange").last
    expect(answer.locator(".said")).to_contain_text(re.compile(r"Why .+ at tick 0\?"))
    expect(answer.locator(".cause-name")).to_have_text("Barrier")
    expect(answer.locator(".cause")).to_have_attribute("title", re.compile(re.escape(name)))


def test_free_road_takes_what_is_put_there_from_the_bubble(road: Road) -> None:
    cell = road.ahead(4, 1)
    road.page.mouse.click(*road.at(cell))
    expect(road.bubble).to_contain_text("Free road")
    road.bubble.get_by_role("button", name="Pedestrian").click()
    road.done("Put a pedestrian here")
    assert road.in_cell(cell) == ["pedestrian-1"] or road.in_cell(cell)[0].startswith("pedestrian")


def test_the_bubble_goes_with_what_moves(road: Road) -> None:
    road.put("vehicle", road.ahead(6))
    road.page.mouse.click(*road.at(road.ahead(6)))
    expect(road.bubble).to_contain_text("Car")
    lanes = road.bubble.locator(".bubble-lines > :first-child")
    before, place = lanes.inner_text(), road.bubble.bounding_box()
    road.step()
    expect(lanes).not_to_have_text(before)
    until(
        road.page,
        "([x, y]) => { const at = document.querySelector('#bubble').getBoundingClientRect();"
        " return Math.abs(at.x - x) + Math.abs(at.y - y) > 20; }",
        [place["x"], place["y"]] if place else [0, 0],
    )
    expect(road.bubble).to_contain_text("Car")


def test_a_button_that_is_pressed_hears_its_click_whatever_comes_meanwhile(road: Road) -> None:
    road.step()
    road.page.mouse.click(*road.at(road.ego))
    button = road.bubble.locator(".bubble-move", has_text="stay")
    expect(button).to_be_visible()
    lines = road.bubble.locator(".bubble-lines")
    before = lines.inner_text()
    button.hover()  # which waits until the bubble, that goes with the car, stands still
    road.page.mouse.down()
    road.step()
    road.page.mouse.up()
    expect(road.page.locator("#beside-title")).to_have_text("Instead: stay, at tick 0")
    road.page.keyboard.press("Escape")
    road.page.mouse.click(*road.at(road.ego))
    expect(lines).not_to_have_text(before)


def test_the_schematic_tells_too(road: Road) -> None:
    name = road.put("barrier", road.ahead(12))
    canvas = road.page.locator("#schematic canvas")
    x, y = road.page.evaluate(
        """async (cell) => {
          const { viewUnder } = await import("/src/road/hitTest.js");
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
        road.step()
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
    road.step()
    before = road.script.state()
    expect(road.page.locator("[data-figure=tick] .figure-value")).to_have_text("1")
    road.page.mouse.click(*road.at(road.ego))
    road.bubble.locator(".bubble-move", has_text="a barrier").click()
    expect(road.beside).to_be_visible()
    expect(road.page.locator("#beside-title")).to_have_text("Instead: forward, at tick 0")
    expect(road.beside.locator("[data-side=real] .beside-end")).to_contain_text("arrives after")
    expect(road.beside.locator("[data-side=changed] .beside-end")).to_have_text(
        "crashes into a barrier at tick 1"
    )
    road.page.keyboard.press("Home")  # both play, and would go on to their ends meanwhile
    road.page.keyboard.press("ArrowRight")
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
    road.step()
    road.page.mouse.click(*road.at(road.ego))
    road.bubble.locator(".bubble-move", has_text="stay").click()
    tick = road.beside.locator(".beside-tick")
    expect(tick).to_have_text(re.compile("tick"))
    until(road.page, STOPPED_APART)
    expect(road.beside.get_by_role("button", name="Play both")).to_be_visible()
    stood = tick.inner_text()
    road.page.keyboard.press("ArrowRight")
    expect(tick).to_have_text(f"tick {int(stood.split()[1]) + 1}")
    expect(road.beside.locator(".beside-summary")).to_contain_text("I arrive 1 tick later.")
    assert road.script.state()["tick"] == 1


def test_a_move_in_the_plan_can_be_watched(road: Road) -> None:
    road.put("barrier", road.ahead(1))
    way = road.page.locator("#plan button", has_text="Forward").filter(has_text="barrier")
    way.click()
    expect(road.page.locator("#beside-title")).to_have_text("Instead: forward, at tick 0")
    expect(road.beside.locator("[data-side=changed] .beside-end")).to_contain_text("crashes into a barrier")
    expect(road.beside.locator("[data-side=real] .beside-end")).to_contain_text("arrives")


def test_the_past_is_told_and_not_changed(road: Road) -> None:
    start = road.ahead(4)
    name = road.put("barrier", start)
    for _ in range(2):
        road.step()
    expect(road.page.locator("[data-figure=tick] .figure-value")).to_have_text("2")
    road.page.keyboard.press("ArrowLeft")
    expect(road.page.locator("[data-figure=tick] .figure-value")).to_have_text("1")
    road.page.mouse.click(*road.at(start))
    expect(road.bubble).to_contain_text("3 rows ahead")
    expect(road.bubble.get_by_role("button", name="Remove")).to_have_count(0)
    road.bubble.get_by_role("button", name="What if it weren't there?").click()
    expect(road.beside.locator(".beside-tick")).to_have_text(re.compile(r"tick \d"))
    expect(road.page.locator("#beside-title")).to_have_text("Without the barrier")
    road.page.keyboard.press("Escape")
    road.drag(road.at(start), road.at(road.ahead(1, 1)))
    expect(road.page.locator(".road-toast")).to_contain_text("This is the past")
    assert road.in_cell(start) == [name]


def test_the_services_drawing_is_pointed_at_like_the_pages_own(road: Road) -> None:
    name = road.put("barrier", road.ahead(3, 2))
    road.page.locator("#views-menu button").first.click()
    road.page.get_by_text("Renderer: server").click()
    road.page.keyboard.press("Escape")
    expect(road.page.locator(".service-canvas")).to_be_visible()
    x, y = road.at(road.ahead(3, 2))
    road.page.mouse.click(x, y)
    expect(road.bubble).to_contain_text(name)


def test_who_wants_little_motion_gets_the_tick_where_they_part(visit: Visit, service: ServiceProcess) -> None:
    road = empty_road(visit, service, reduced_motion="reduce")
    road.step(2)
    expect(road.page.locator("[data-figure=tick] .figure-value")).to_have_text("2")
    road.page.mouse.click(*road.at(road.ego))
    road.bubble.locator(".bubble-move", has_text="stay").click()
    expect(road.beside.locator(".beside-tick")).to_have_text("tick 2")
    expect(road.beside.get_by_role("button", name="Play both")).to_be_visible()


def test_imagining_a_thing_away_answers_and_plays(road: Road) -> None:
    road.put("barrier", road.ahead(2))
    road.page.mouse.click(*road.at(road.ahead(2)))
    road.bubble.get_by_role("button", name="What if it weren't there?").click()
    expect(road.page.locator("#beside-title")).to_have_text("Without the barrier")
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
    road.step()
    answer = road.visitor.say("why did you do that?")
    answer.locator(".alternatives summary").click()
    answer.get_by_role("button", name="Watch forward beside the real run").click()
    expect(road.beside.locator("[data-side=changed] .beside-end")).to_contain_text("crashes into a barrier")
    road.beside.get_by_role("button", name="Close the comparison").click()
    expect(road.beside).to_be_hidden()
    answer.get_by_role("button", name="Watch it beside the real run", exact=True).click()
    expect(road.page.locator("#beside-title")).to_contain_text("Without ")
