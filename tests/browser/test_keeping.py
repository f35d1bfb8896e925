"""Runs shared by link, taken away as files and brought back, and moments and sessions by their names."""

from __future__ import annotations

import json
import re
from io import BytesIO
from pathlib import Path

from PIL import Image
from playwright.sync_api import expect

from tests.browser.conftest import Visit
from tests.browser.visitor import Visitor
from tests.browser.walking import TICKS, bar, began, choose, figure, look, world


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
    visitor.forgive("Failed to load resource")


def test_pictures_videos_and_recordings_are_taken_away(run: Visitor) -> None:
    look(run, 50)
    with run.page.expect_download() as picture:
        choose(run, "Save a picture of tick 50")
    assert picture.value.suggested_filename.endswith("-tick-50.png")
    with Image.open(picture.value.path()) as image:
        assert image.width > 300
        assert len(image.convert("RGB").getcolors(1 << 24) or []) > 50
    choose(run, "Export a video…")
    dialog = run.page.get_by_role("dialog", name="Export a video")
    expect(dialog.get_by_label("From tick")).to_have_value("40")
    expect(dialog.get_by_label("To tick")).to_have_value("60")
    dialog.get_by_label("From tick").fill("56")
    dialog.get_by_label("Size").select_option("320")
    expect(dialog.get_by_role("status")).to_have_text("4 ticks, 2.0 s long.")
    with run.page.expect_download() as film:
        dialog.get_by_role("button", name="Make video").click()
    expect(dialog.get_by_role("status")).to_have_text(re.compile(r"Saved: [\d.]+ [kM]B\."))
    with Image.open(BytesIO(Path(film.value.path()).read_bytes())) as moving:
        assert (moving.format, getattr(moving, "n_frames", 1) > 5) == ("GIF", True)
    dialog.get_by_label("To tick").fill("20")
    dialog.get_by_role("button", name="Make video").click()
    expect(dialog.get_by_role("status")).to_contain_text("is after the last tick")
    run.forgive("Failed to load resource")
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


def test_a_new_session_begins_with_a_welcome_and_its_own_talk(visit: Visit) -> None:
    visitor = visit()
    first = visitor.session
    welcome = visitor.page.locator(".welcome")
    expect(welcome).to_be_visible()
    visitor.say("add five potholes")
    expect(welcome).to_have_count(0)
    choose(visitor, "New session")
    expect(visitor.page).not_to_have_url(re.compile(first))
    expect(welcome).to_be_visible()
    expect(visitor.page.locator(".exchange")).to_have_count(0)


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
