"""Time on the page: looked along, played, jumped through, forked, shared, taken away and brought back."""

from __future__ import annotations

import json
import re
from io import BytesIO
from pathlib import Path
from typing import Any

import pytest
from PIL import Image
from playwright.sync_api import Locator, expect

from tests.browser.conftest import Visit
from tests.browser.visitor import Visitor

TICKS = 120


@pytest.fixture
def run(visit: Visit) -> Visitor:
    """A paused run of so many ticks, with something said at tick 40 and heavy traffic from there on."""
    visitor = visit()
    began(visitor)
    return visitor


def began(visitor: Visitor) -> None:
    visitor.pause()
    now = visitor.script.state()["tick"]
    visitor.script.act({"do": "step", "ticks": 40 - now})
    visitor.say("set the number of cars to 14")
    visitor.script.act({"do": "step", "ticks": TICKS - 40})
    expect(figure(visitor)).to_have_text(str(TICKS))
    expect(slider(visitor)).to_have_attribute("aria-valuenow", str(TICKS))


def slider(visitor: Visitor) -> Locator:
    return visitor.page.get_by_role("slider", name="The run so far")


def figure(visitor: Visitor) -> Locator:
    return visitor.page.locator("[data-figure=tick] .figure-value")


def bar(visitor: Visitor) -> Locator:
    return visitor.page.get_by_role("group", name="The past")


def look(visitor: Visitor, tick: int) -> None:
    """By keys from the start, as one who counts."""
    slider(visitor).focus()
    visitor.page.keyboard.press("Home")
    for _ in range(tick // 10):
        visitor.page.keyboard.press("PageUp")
    for _ in range(tick % 10):
        visitor.page.keyboard.press("ArrowRight")
    expect(figure(visitor)).to_have_text(str(tick))


def world(visitor: Visitor, tick: int) -> dict[str, Any]:
    path = f"{visitor.url}/api/v1/sessions/{visitor.session}/state?tick={tick}"
    told: dict[str, Any] = visitor.page.request.get(path).json()
    return told


def choose(visitor: Visitor, name: str | re.Pattern[str]) -> None:
    """From the session's menu."""
    visitor.page.get_by_role("button", name="Session", exact=True).click()
    visitor.page.get_by_role("menuitem", name=name).click()


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
    path = f"{run.url}/api/v1/sessions/{run.session}/decisions/43"
    narration = run.page.request.get(path).json()["narration"]
    expect(run.page.locator(".caption-text")).to_have_text(narration)
    expect(bar(run)).to_contain_text("Tick 44 of")


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
    keys.press("Space")
    expect(bar(run).get_by_role("button", name="Play from here")).to_have_attribute("data-playing", "true")
    expect(bar(run)).to_be_hidden(timeout=8_000)
    expect(figure(run)).to_have_text(str(TICKS))
    assert run.script.state()["paused"] is True


def test_stepping_back_on_a_running_road_stops_it_first(visit: Visit) -> None:
    visitor = visit()
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
    run.page.get_by_role("button", name="Previous mark").click()
    expect(figure(run)).to_have_text("40")
    expect(run.page.locator("#announcer")).to_have_text("Tick 40: “set the number of cars to 14”")
    run.page.get_by_role("button", name="Previous mark").click()
    expect(run.page.locator(".notice-box")).to_have_text("No earlier change.")
    run.page.get_by_role("button", name="Next mark").click()
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


def test_a_link_carries_the_moment(visit: Visit) -> None:
    run = visit(permissions=["clipboard-read", "clipboard-write"])
    began(run)
    look(run, 77)
    there = world(run, 77)["digest"]
    run.page.keyboard.press("l")
    expect(run.page.locator(".notice-box")).to_contain_text(
        "Link to tick 77 copied. It carries the whole run"
    )
    link = run.page.evaluate("navigator.clipboard.readText()")
    assert link.startswith(run.url + "/#/r/")
    other = visit(link.removeprefix(run.url))
    expect(figure(other)).to_have_text("77")
    expect(other.page).to_have_url(re.compile("#/s/"))
    assert other.session != run.session
    assert other.script.state()["digest"] == there


def test_without_a_clipboard_the_link_stands_in_a_field(run: Visitor) -> None:
    run.page.evaluate("() => { navigator.clipboard.writeText = () => Promise.reject(new Error('no')); }")
    choose(run, "Share a link to this moment")
    field = run.page.get_by_role("dialog").get_by_role("textbox", name="Link")
    expect(field).to_be_focused()
    expect(field).to_have_value(re.compile("#/r/"))
    assert run.page.evaluate("document.getSelection().toString() || document.activeElement.value").startswith(
        "http"
    )
    run.page.keyboard.press("Escape")
    expect(field).to_be_hidden()


def test_the_address_carries_the_tick_and_survives_a_reload(run: Visitor) -> None:
    look(run, 33)
    expect(run.page).to_have_url(re.compile(r"#/s/[^/]+/33$"))
    run.page.reload()
    run.wait_live()
    expect(bar(run)).to_contain_text(f"Tick 33 of {TICKS}")
    expect(figure(run)).to_have_text("33")
    run.page.keyboard.press("n")
    expect(run.page).to_have_url(re.compile(r"#/s/[^/]+$"))


def test_a_link_that_is_broken_says_so(visit: Visit) -> None:
    visitor = visit("/#/r/AAAA", live=False)
    expect(visitor.page.locator(".verdict-text")).to_contain_text("This link does not open.")
    visitor.page.get_by_role("button", name="Try again").click()
    visitor.wait_live()
    visitor.console.clear()  # the browser's own line about the refused request


def test_pictures_films_and_recordings_are_taken_away(run: Visitor) -> None:
    look(run, 50)
    with run.page.expect_download() as picture:
        choose(run, "Save a picture of tick 50")
    assert picture.value.suggested_filename.endswith("-tick-50.png")
    with Image.open(picture.value.path()) as image:
        assert image.width > 300
        assert len(image.convert("RGB").getcolors(1 << 24) or []) > 50
    choose(run, "Make a film…")
    dialog = run.page.get_by_role("dialog", name="Make a film")
    expect(dialog.get_by_label("From tick")).to_have_value("40")
    expect(dialog.get_by_label("To tick")).to_have_value("60")
    dialog.get_by_label("From tick").fill("56")
    dialog.get_by_label("Size").select_option("320")
    expect(dialog.get_by_role("status")).to_have_text("4 ticks, 2.0 s long.")
    with run.page.expect_download() as film:
        dialog.get_by_role("button", name="Make film").click()
    expect(dialog.get_by_role("status")).to_have_text(re.compile(r"Saved: \d+ kB\."))
    with Image.open(BytesIO(Path(film.value.path()).read_bytes())) as moving:
        assert (moving.format, getattr(moving, "n_frames", 1) > 5) == ("GIF", True)
    dialog.get_by_label("To tick").fill("20")
    dialog.get_by_role("button", name="Make film").click()
    expect(dialog.get_by_role("status")).to_contain_text("is after the last tick")
    run.console.clear()  # the browser's own line about the refused request
    run.page.keyboard.press("Escape")
    with run.page.expect_download() as recording:
        choose(run, "Save the recording")
    assert json.loads(Path(recording.value.path()).read_text())["tick"] == TICKS


def test_a_recording_is_opened_and_a_broken_one_says_why(run: Visitor, tmp_path: Path) -> None:
    before, digest = run.session, run.script.state()["digest"]
    broken = tmp_path / "broken.json"
    broken.write_text('{"format": "roadtalk-recording", "version": 1')
    with run.page.expect_file_chooser() as chooser:
        choose(run, "Open a recording…")
    chooser.value.set_files(broken)
    notice = run.page.locator(".notice-box")
    expect(notice).to_contain_text("“broken.json” is no recording: it is not JSON, or cut off.")
    expect(notice).to_contain_text("The session here is as it was.")
    assert run.session == before
    recording = run.page.request.get(f"{run.url}/api/v1/sessions/{before}/recording").text()
    dropped = run.page.evaluate_handle(
        """(text) => {
          const files = new DataTransfer();
          files.items.add(new File([text], "run.json", { type: "application/json" }));
          return files;
        }""",
        recording,
    )
    run.page.dispatch_event("body", "dragover", {"dataTransfer": dropped})
    expect(run.page.locator(".drop")).to_be_visible()
    run.page.dispatch_event("body", "drop", {"dataTransfer": dropped})
    expect(run.page).not_to_have_url(re.compile(before))
    run.wait_live()
    expect(figure(run)).to_have_text(str(TICKS))
    path = f"{run.url}/api/v1/sessions/{run.session}/state"
    assert run.page.request.get(path).json()["digest"] == digest


def test_moments_get_names_and_are_gone_back_to(run: Visitor) -> None:
    choose(run, "Save this moment as…")
    dialog = run.page.get_by_role("dialog", name="Saved moments")
    expect(dialog.get_by_role("textbox", name="Name")).to_be_focused()
    run.page.keyboard.type("rush hour")
    run.page.keyboard.press("Enter")
    expect(dialog.get_by_role("listitem")).to_contain_text("rush hour")
    expect(dialog.get_by_role("listitem")).to_contain_text(f"tick {TICKS}")
    run.page.keyboard.press("Escape")
    run.script.act({"do": "step", "ticks": 9})
    expect(figure(run)).to_have_text(str(TICKS + 9))
    choose(run, "Saved moments…")
    dialog.get_by_role("button", name="Look at rush hour").click()
    expect(bar(run)).to_contain_text(f"Tick {TICKS} of {TICKS + 9}")
    choose(run, "Saved moments…")
    dialog.get_by_role("button", name="Go back to rush hour").click()
    expect(bar(run)).to_be_hidden()
    expect(figure(run)).to_have_text(str(TICKS))
    assert run.script.state()["tick"] == TICKS


def test_sessions_are_listed_opened_and_deleted(visit: Visit) -> None:
    visitor = visit()
    first = visitor.session
    choose(visitor, "New session")
    expect(visitor.page).not_to_have_url(re.compile(first))
    visitor.wait_live()
    choose(visitor, "Sessions…")
    dialog = visitor.page.get_by_role("dialog", name="Sessions")
    row = dialog.locator(f"[data-session='{first}']")
    expect(dialog.locator(f"[data-session='{visitor.session}']")).to_contain_text("this one")
    row.get_by_role("button", name=re.compile("^Delete Session")).click()
    expect(row.get_by_role("button", name="Keep")).to_be_focused()
    visitor.page.keyboard.press("Enter")
    expect(row.get_by_role("button", name=re.compile("^Delete Session"))).to_be_visible()
    row.get_by_role("link").click()
    expect(visitor.page).to_have_url(re.compile(first))
    visitor.wait_live()
    choose(visitor, "New session")
    expect(visitor.page).not_to_have_url(re.compile(first))
    choose(visitor, "Sessions…")
    row.get_by_role("button", name=re.compile("^Delete Session")).click()
    row.get_by_role("button", name="for good").click()
    expect(row).to_have_count(0)
    expect(dialog.get_by_role("status")).to_contain_text("was deleted")
    assert visitor.page.request.get(f"{visitor.url}/api/v1/sessions/{first}").status == 404


def test_the_menu_is_one_for_the_keyboard(visit: Visit) -> None:
    visitor = visit()
    keys = visitor.page.keyboard
    button = visitor.page.get_by_role("button", name="Session", exact=True)
    button.focus()
    keys.press("ArrowDown")
    expect(button).to_have_attribute("aria-expanded", "true")
    expect(visitor.page.get_by_role("menuitem").first).to_be_focused()
    keys.press("End")
    expect(visitor.page.get_by_role("menuitem", name="New session")).to_be_focused()
    keys.press("ArrowDown")
    expect(visitor.page.get_by_role("menuitem").first).to_be_focused()
    keys.press("o")
    expect(visitor.page.get_by_role("menuitem", name="Open a recording…")).to_be_focused()
    keys.press("Escape")
    expect(button).to_be_focused()
    expect(button).to_have_attribute("aria-expanded", "false")


def test_speed_is_chosen_and_shown(visit: Visit) -> None:
    visitor = visit()
    speed = visitor.page.get_by_role("combobox", name="Playback speed")
    expect(speed).to_have_value("1")
    speed.select_option("4")
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


def test_the_past_is_quick_even_in_a_long_run(visit: Visit) -> None:
    visitor = visit()
    visitor.pause()
    for _ in range(2):
        visitor.script.act({"do": "step", "ticks": 1000})
    expect(slider(visitor)).to_have_attribute("aria-valuemax", re.compile("^20"))
    slider(visitor).focus()
    visitor.page.keyboard.press("Home")
    expect(figure(visitor)).to_have_text("0")
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
    assert times[30] <= 50


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
