"""Time on the page: looked along, played, jumped through, forked, gone back to."""

from __future__ import annotations

import re

from playwright.sync_api import expect

from tests.browser.conftest import Visit
from tests.browser.visitor import Visitor
from tests.browser.walking import TICKS, bar, choose, figure, look, slider, world

# And whether it goes on at that moment: a slow machine may not look before it has come to the end.
PLAY = """
async () => {
  const { page } = await import("/src/main.js");
  document.body.dispatchEvent(new KeyboardEvent("keydown", { key: " ", bubbles: true, cancelable: true }));
  return String(page.state().look.playing);
}
"""


def log_lines(run: Visitor) -> list[tuple[int, bool]]:
    """The tick of each line of the log, and whether it is dimmed."""
    lines = run.page.locator(".log-line").all()
    return [
        (int(line.get_attribute("data-tick") or 0), line.get_attribute("data-later") is not None)
        for line in lines
    ]


def test_dragging_shows_the_past_as_it_was(run: Visitor) -> None:
    box = slider(run).bounding_box()
    assert box is not None
    middle = box["y"] + box["height"] / 2
    run.page.mouse.move(box["x"] + box["width"] * 0.7, middle)
    run.page.mouse.down()
    run.page.mouse.move(box["x"] + box["width"] * 0.5, middle, steps=4)
    expect(bar(run)).to_be_visible()
    run.page.mouse.move(box["x"] + box["width"] * 0.3, middle, steps=8)
    run.page.mouse.up()
    run.drawn()
    tick = int(slider(run).get_attribute("aria-valuenow") or "-1")
    assert 20 < tick < 60
    expect(figure(run)).to_have_text(str(tick))
    lane = world(run, tick)["vehicles"][0]["cell"][0] + 1
    expect(run.page.locator("#road .road-canvas")).to_have_attribute(
        "aria-label", re.compile(f"lane {lane},")
    )
    expect(bar(run)).to_contain_text(f"Tick {tick} of {TICKS}")
    assert run.script.state()["tick"] == TICKS
    run.page.get_by_role("button", name="Back to live").click()
    expect(bar(run)).to_be_hidden()
    expect(figure(run)).to_have_text(str(TICKS))


def test_the_line_is_a_slider_for_the_keyboard(run: Visitor) -> None:
    keys = run.page.keyboard
    slider(run).focus()
    expect(slider(run)).to_have_attribute("aria-valuetext", "live")
    keys.press("ArrowLeft")
    expect(figure(run)).to_have_text(str(TICKS - 1))
    keys.press("PageDown")
    expect(slider(run)).to_have_attribute("aria-valuenow", str(TICKS - 11))
    expect(slider(run)).to_have_attribute("aria-valuetext", re.compile(f"^tick {TICKS - 11} of {TICKS}"))
    keys.press("Home")
    expect(figure(run)).to_have_text("0")
    keys.press("ArrowLeft")
    expect(figure(run)).to_have_text("0")
    keys.press("Shift+ArrowRight")
    expect(figure(run)).to_have_text("10")
    keys.press("End")
    expect(bar(run)).to_be_hidden()
    expect(slider(run)).to_have_attribute("aria-valuetext", "live")


def test_the_decision_of_the_tick_is_told_everywhere(run: Visitor) -> None:
    look(run, 44)
    path = f"{run.url}/api/v1/sessions/{run.session}/decisions/44"
    decision = run.page.request.get(path).json()
    expect(run.page.locator(".caption-text")).to_have_text(decision["narration"])
    expect(run.page.locator("#plan-when")).to_have_text("next, at tick 44")
    expect(run.page.locator(".way[data-standing=taken]")).to_contain_text(
        decision["move"].replace("_", " ").capitalize()
    )
    blocked = sum(option["verdict"] != "free" for option in decision["options"])
    expect(run.page.locator(".chart-told").first).to_have_text(f"{blocked} of 6 blocked")
    dimmed = dict(log_lines(run))
    assert dimmed == {tick: tick > 44 for tick in dimmed}
    assert set(dimmed.values()) == {False, True}
    expect(bar(run)).to_contain_text("Tick 44 of")


def test_questions_are_asked_of_the_tick_that_is_looked_at_and_orders_are_done_now(run: Visitor) -> None:
    look(run, 44)
    why = run.say("why didn't you go right here?")
    expect(why.locator(".reply").first).to_contain_text("At tick 44")
    expect(run.say("what will you do next?").locator(".reply").first).to_contain_text("At tick 44: Next I")
    expect(run.say("what did I change?").locator(".reply").last).to_contain_text(f"Now, at tick {TICKS}:")
    expect(bar(run)).to_contain_text("Tick 44 of")
    run.say("add a pothole")
    expect(bar(run)).to_be_hidden()  # what was changed is to be seen
    assert run.script.state()["tick"] == TICKS


def test_a_leap_back_marks_the_lines_it_took_and_tells_the_move_that_led_there(run: Visitor) -> None:
    path = f"{run.url}/api/v1/sessions/{run.session}/decisions/49"
    narration = run.page.request.get(path).json()["narration"]
    run.say("go back to tick 50")
    expect(figure(run)).to_have_text("50")
    expect(run.page.locator(".caption-text")).to_have_text(narration)
    dimmed = dict(log_lines(run))
    assert dimmed == {tick: tick > 50 for tick in dimmed}
    assert True in dimmed.values()
    run.say("undo")
    expect(figure(run)).to_have_text(str(TICKS))
    expect(run.page.locator(".log-line[data-later]")).to_have_count(0)


def test_arrows_walk_back_and_forth_and_play_goes_on_by_itself(run: Visitor) -> None:
    keys = run.page.keyboard
    run.page.locator("body").click(position={"x": 2, "y": 2})
    keys.press("ArrowLeft")
    keys.press("ArrowLeft")
    expect(figure(run)).to_have_text(str(TICKS - 2))
    keys.press("ArrowRight")
    expect(figure(run)).to_have_text(str(TICKS - 1))
    for _ in range(3):
        keys.press("ArrowLeft")
    expect(figure(run)).to_have_text(str(TICKS - 4))
    assert run.page.evaluate(PLAY) == "true"
    expect(bar(run)).to_be_hidden()
    expect(figure(run)).to_have_text(str(TICKS))
    assert run.script.state()["paused"] is True


def test_stepping_back_on_a_running_road_stops_it_first(visit: Visit) -> None:
    visitor = visit(running=True)
    expect(figure(visitor)).not_to_have_text(re.compile("^[0-2]$"))
    visitor.page.keyboard.press("ArrowLeft")
    expect(bar(visitor)).to_be_visible()
    expect(visitor.page.get_by_role("toolbar").get_by_role("button", name="Play")).to_be_visible()
    expect(visitor.page.locator(".log-line").filter(has_text="Paused.")).to_have_count(1)
    assert visitor.script.state()["paused"] is True


def test_what_is_pointed_at_says_what_it_is(run: Visitor) -> None:
    tip = run.page.locator(".line-tip")
    look(run, 40)
    expect(tip).to_contain_text("Tick 40")
    expect(tip).to_contain_text("“set the number of cars to 14”")
    expect(slider(run)).to_have_attribute("aria-valuetext", re.compile("set the number of cars to 14"))
    box = slider(run).bounding_box()
    assert box is not None
    run.page.mouse.move(box["x"] + box["width"] * 0.75, box["y"] + 20)
    expect(tip).to_contain_text(re.compile(r"Tick (8|9)\d"))
    run.page.mouse.move(5, 5)
    expect(tip).to_contain_text("Tick 40")


def test_jumps_find_what_matters(run: Visitor) -> None:
    told = run.page.request.get(f"{run.url}/api/v1/sessions/{run.session}/timeline").json()
    ends = [mark["tick"] for mark in told["marks"] if mark["kind"] in ("crash", "success", "stuck")]
    near = [mark["tick"] for mark in told["marks"] if mark["kind"] == "near_miss"]
    assert ends
    assert near
    stops = sorted({*ends, *near, 40})
    run.page.locator("body").click(position={"x": 2, "y": 2})
    run.page.keyboard.press("[")
    expect(figure(run)).to_have_text(str(max(stop for stop in stops if stop < TICKS)))
    run.page.get_by_role("combobox", name="Jump between").select_option("command")
    run.page.get_by_role("button", name="Previous event").click()
    expect(figure(run)).to_have_text("40")
    expect(run.page.locator("#announcer")).to_have_text("Tick 40: “set the number of cars to 14”")
    run.page.get_by_role("button", name="Previous event").click()
    expect(run.page.locator(".notice-box")).to_have_text("No earlier change.")
    run.page.get_by_role("button", name="Next event").click()
    expect(bar(run)).to_be_hidden()


def test_a_fork_goes_its_own_way_and_the_browser_leads_back(run: Visitor) -> None:
    parent = run.session
    look(run, 25)
    bar(run).get_by_role("button", name="Fork here").click()
    expect(run.page).not_to_have_url(re.compile(parent))
    run.wait_live()
    expect(figure(run)).to_have_text("25")
    expect(run.page.locator(".notice-box")).to_contain_text("Forked at tick 25")
    origin = run.page.get_by_role("link", name=re.compile("Forked at tick 25"))
    expect(origin).to_be_visible()
    run.page.go_back()
    expect(run.page).to_have_url(re.compile(parent))
    run.wait_live()
    expect(bar(run)).to_contain_text("Tick 25 of")
    look(run, 25)
    expect(slider(run)).to_have_attribute("aria-valuetext", re.compile("Forked here"))
    choose(run, "Open the fork made here")
    expect(run.page).not_to_have_url(re.compile(parent))
    run.wait_live()
    expect(origin).to_be_visible()
    origin.click()
    expect(bar(run)).to_contain_text("Tick 25 of")


def test_rewinding_makes_it_the_present_and_undo_brings_it_back(run: Visitor) -> None:
    look(run, 30)
    choose(run, "Rewind to tick 30")
    expect(figure(run)).to_have_text("30")
    expect(bar(run)).to_be_hidden()
    assert run.script.state()["tick"] == 30
    expect(slider(run)).to_have_attribute("aria-valuemax", "30")
    notice = run.page.locator(".notice-box")
    expect(notice).to_contain_text("Back at tick 30")
    notice.get_by_role("button", name="Undo").click()
    expect(figure(run)).to_have_text(str(TICKS))
    assert run.script.state()["tick"] == TICKS


def test_speed_is_chosen_and_shown(visit: Visit) -> None:
    visitor = visit()
    speed = visitor.page.get_by_role("combobox", name="Playback speed")
    expect(speed).to_have_value("1")
    speed.select_option("4")
    expect(visitor.page.locator(".exchange").last).to_contain_text("1× → 4×")
    expect(speed).to_have_value("4")
    visitor.page.locator("body").click(position={"x": 2, "y": 2})
    visitor.page.keyboard.press("-")
    expect(speed).to_have_value("2")
    assert visitor.script.state()["playback_speed"] == 2
    visitor.script.act({"do": "set", "parameter": "playback_speed", "value": "max"})
    expect(speed).to_have_value("max")
    visitor.page.keyboard.press("+")
    expect(speed).to_have_value("max")
    visitor.page.keyboard.press("-")
    expect(speed).to_have_value("64")


def test_the_past_is_asked_for_in_pages_and_ahead_of_time(visit: Visit) -> None:
    """So that a tick of it is there at once, even in a long run: most of them cost no question."""
    visitor = visit()
    for _ in range(2):
        visitor.script.act({"do": "step", "ticks": 1000})
    expect(slider(visitor)).to_have_attribute("aria-valuemax", "2000")
    slider(visitor).focus()
    visitor.page.keyboard.press("Home")
    expect(figure(visitor)).to_have_text("0")
    visitor.requests.clear()
    times: list[float] = visitor.page.evaluate(
        """async () => {
          const figure = document.querySelector("[data-figure=tick] .figure-value");
          const line = document.querySelector("[role=slider]");
          const times = [];
          for (let tick = 1; tick <= 60; tick += 1) {
            const began = performance.now();
            line.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight", bubbles: true }));
            while (figure.textContent !== String(tick)) await new Promise(requestAnimationFrame);
            times.push(performance.now() - began);
          }
          return times.sort((a, b) => a - b);
        }"""
    )
    print(f"a tick of the past: median {times[30]:.0f} ms, worst {times[-1]:.0f} ms")
    asked = [url for url in visitor.requests if "/moments" in url]
    assert 0 < len(asked) <= 8


def test_on_a_phone_the_past_can_be_reached_and_left(visit: Visit) -> None:
    visitor = visit(viewport={"width": 360, "height": 780}, has_touch=True, is_mobile=True)
    visitor.pause()
    visitor.script.act({"do": "step", "ticks": 60})
    expect(slider(visitor)).to_have_attribute("aria-valuemax", re.compile("^6"))
    slider(visitor).tap(position={"x": 60, "y": 20})
    expect(bar(visitor)).to_be_visible()
    assert visitor.page.evaluate("document.documentElement.scrollWidth") <= 360
    small = (
        bar(visitor)
        .locator("button")
        .evaluate_all(
            """(all) => all.map((one) => one.getBoundingClientRect())
            .filter(({ width, height }) => width < 44 || height < 44).length"""
        )
    )
    assert small == 0
    edges = bar(visitor).bounding_box()
    assert edges is not None
    assert edges["x"] >= 0
    assert edges["x"] + edges["width"] <= 360
    visitor.page.get_by_role("button", name="Back to live").tap()
    expect(bar(visitor)).to_be_hidden()


def test_the_wheel_goes_along_the_run_and_a_page_that_can_scroll_is_scrolled(run: Visitor) -> None:
    def turn(target: str, across: int, down: int) -> None:
        run.page.locator(target).hover(position={"x": 100, "y": 10}, force=True)
        run.page.mouse.wheel(across, down)

    turn(".line", 0, 300)
    run.shows(TICKS - 3)
    turn(".line", 0, -100)
    run.shows(TICKS - 2)
    turn("#road", 0, 300)
    run.say("enlarge the road")
    run.shows(TICKS - 2)
    turn("#road", 0, 100)
    run.shows(TICKS - 3)
    run.say("back to live")
    run.page.keyboard.press("Escape")
    run.page.set_viewport_size({"width": 700, "height": 700})
    turn(".line", 0, 200)
    run.until("() => scrollY > 0")
    assert run.tick() == TICKS
