"""Parts of the page shown, hidden, enlarged; what each tells; the road drawn otherwise, and in words."""

from __future__ import annotations

import re
from typing import Any

import httpx
import pytest
from playwright.sync_api import Locator, expect

from tests.browser.conftest import Visit
from tests.browser.visitor import Visitor

COLOURS = """
(canvas) => new Set(canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data).size
"""
PARTS = ("road", "schematic", "plan", "occupancy", "metrics", "log")


def part(visitor: Visitor, name: str) -> Locator:
    return visitor.page.locator(f"[data-view={name}]")


def way(visitor: Visitor, name: str) -> Locator:
    """The line of one move in the plan."""
    return visitor.page.locator(".way").filter(has=visitor.page.get_by_text(name, exact=True))


def asked(visitor: Visitor, what: str) -> dict[str, Any]:
    answer = httpx.get(f"{visitor.url}/api/v1/sessions/{visitor.session}/{what}", timeout=60)
    values: dict[str, Any] = answer.raise_for_status().json()
    return values


def cleared(visitor: Visitor) -> list[int]:
    """Stop at the start of an empty road; the vehicle's cell."""
    visitor.script.act({"do": "pause"}, {"do": "reset"})
    visitor.script.act({"do": "remove", "kind": "everything", "count": "all"})
    expect(visitor.page.locator("#road .road-canvas")).to_have_attribute(
        "aria-label", re.compile("nothing on it")
    )
    cell: list[int] = visitor.script.state()["vehicles"][0]["cell"]
    return cell


def test_everything_is_seen_at_once_on_a_desk(visit: Visit) -> None:
    visitor = visit()
    visitor.pause()
    for name in (*PARTS, "talk"):
        expect(part(visitor, name)).to_be_in_viewport(ratio=1)
    boxes = {name: part(visitor, name).bounding_box() for name in (*PARTS, "talk")}
    for first in boxes:
        for second in boxes:
            one, other = boxes[first], boxes[second]
            assert one is not None
            assert other is not None
            apart = one["x"] + one["width"] <= other["x"] + 1 or one["y"] + one["height"] <= other["y"] + 1
            if first < second:
                assert (
                    apart
                    or other["x"] + other["width"] <= one["x"] + 1
                    or other["y"] + other["height"] <= one["y"] + 1
                )


def test_parts_are_shown_and_hidden_by_keys_heads_and_menu_and_stay_so(visit: Visit) -> None:
    visitor = visit()
    visitor.page.locator("body").click(position={"x": 720, "y": 20})
    for key, name in enumerate(PARTS, 1):
        visitor.page.keyboard.press(str(key))
        expect(part(visitor, name)).to_be_hidden()
        visitor.page.keyboard.press(str(key))
        expect(part(visitor, name)).to_be_visible()
    visitor.page.get_by_role("button", name="Hide the metrics").click()
    expect(part(visitor, "metrics")).to_be_hidden()
    menu = visitor.page.get_by_role("button", name="Views")
    expect(menu).to_be_focused()
    menu.press("ArrowDown")
    visitor.page.keyboard.press("p")  # the first that begins so
    entry = visitor.page.get_by_role("menuitemcheckbox", name="Plan")
    expect(entry).to_be_focused()
    visitor.page.keyboard.press("Enter")
    expect(entry).to_have_attribute("aria-checked", "false")
    expect(entry).to_be_focused()
    expect(visitor.page.get_by_role("menuitemcheckbox", name="Metrics")).to_have_attribute(
        "aria-checked", "false"
    )
    visitor.page.keyboard.press("Escape")
    expect(menu).to_be_focused()
    visitor.page.reload()
    visitor.wait_live()
    for name in PARTS:
        expect(part(visitor, name)).to_be_visible(visible=name not in ("plan", "metrics"))


def test_what_is_enlarged_fills_the_place_of_the_rest_and_comes_back(visit: Visit) -> None:
    visitor = visit()
    visitor.pause()
    expect(visitor.page.locator(".panel-note").first).to_have_text(re.compile("next"))
    before = part(visitor, "plan").bounding_box()
    visitor.page.get_by_role("button", name="Enlarge the plan").click()
    visitor.until("document.querySelector('.plan-canvas').clientWidth > 400")
    large = part(visitor, "plan").bounding_box()
    assert before is not None
    assert large is not None
    assert large["width"] > 2.5 * before["width"]
    expect(part(visitor, "talk")).to_be_in_viewport(ratio=1)
    canvas = visitor.page.locator(".plan-canvas")
    visitor.page.keyboard.press("Escape")
    visitor.until("document.querySelector('.plan-canvas').clientWidth < 300")
    visitor.drawn()
    assert part(visitor, "plan").bounding_box() == before
    road = part(visitor, "road").bounding_box()
    visitor.page.get_by_role("button", name="Enlarge the road").click()
    expect(canvas).to_be_hidden()
    wide = part(visitor, "road").bounding_box()
    assert road is not None
    assert wide is not None
    assert wide["width"] > road["width"] + 200


def test_parts_are_shown_and_hidden_by_sentence_on_every_page_that_watches(visit: Visit) -> None:
    first = visit()
    second = visit(f"/#/s/{first.session}")
    expect(first.say("hide the log").locator(".reply")).to_have_text("The log is hidden.")
    for visitor in (first, second):
        expect(part(visitor, "log")).to_be_hidden()
    second.script.act({"do": "show", "view": "log"}, {"do": "hide", "view": "occupancy"})
    for visitor in (first, second):
        expect(part(visitor, "log")).to_be_visible()
        expect(part(visitor, "occupancy")).to_be_hidden()
    assert first.page.locator(".log-line[data-tone=change]").count() == 0
    expect(first.say("show the occupancy matrix").locator(".reply")).to_contain_text("is shown")
    expect(part(second, "occupancy")).to_be_visible()
    refused = first.say("show the sensors")
    assert refused.get_attribute("data-standing") == "refused"
    expect(refused.locator(".reply")).to_contain_text("not available yet")


def test_the_road_is_seen_in_perspective_by_key_menu_and_sentence(visit: Visit) -> None:
    visitor = visit()
    flat = visitor.settled()
    visitor.page.locator("body").click(position={"x": 720, "y": 20})
    visitor.page.keyboard.press("d")
    deep = visitor.settled(unlike=flat)
    visitor.page.get_by_role("button", name="Views").click()
    entry = visitor.page.get_by_role("menuitemcheckbox", name="Perspective")
    expect(entry).to_have_attribute("aria-checked", "true")
    entry.click()
    visitor.settled(like=flat)
    visitor.page.keyboard.press("Escape")
    visitor.say("3D view")
    visitor.settled(like=deep)
    visitor.page.reload()
    visitor.wait_live()
    visitor.settled(like=deep)
    visitor.say("view from above")
    visitor.settled(like=flat)
    visitor.say("switch the renderer")
    expect(visitor.page.locator(".service-canvas")).to_be_visible()
    visitor.say("perspective on")
    expect(visitor.page.locator(".service-canvas")).to_be_hidden()


def test_things_are_pointed_at_and_placed_in_perspective(visit: Visit) -> None:
    visitor = visit()
    column, row = cleared(visitor)
    visitor.say("perspective")
    visitor.page.locator("body").click(position={"x": 720, "y": 20})
    visitor.settled()
    visitor.page.keyboard.press("g")
    visitor.page.keyboard.press("b")
    expect(visitor.page.locator("#road .road-canvas")).to_have_attribute(
        "aria-label", re.compile("1 barrier")
    )
    (barrier,) = visitor.script.state()["hazards"]
    assert barrier["cell"] == [column, row - 2]
    mark = visitor.page.locator(".cell-cursor").bounding_box()
    road = visitor.page.locator("#road").bounding_box()
    assert mark is not None
    assert road is not None
    visitor.page.mouse.move(mark["x"] + mark["width"] / 2, mark["y"] + mark["height"] / 2)
    expect(visitor.page.locator("#bubble")).to_contain_text(re.compile("barrier", re.IGNORECASE))
    assert road["y"] < mark["y"] < road["y"] + road["height"]


def test_the_plan_tells_the_next_move_and_why_not_the_others(visit: Visit) -> None:
    visitor = visit()
    column, row = cleared(visitor)
    expect(way(visitor, "Forward")).to_have_attribute("data-standing", "taken")
    visitor.script.act(
        {"do": "add", "kind": "barrier", "count": 1, "where": {"cell": [column, row - 1]}},
        {"do": "add", "kind": "pothole", "count": 1, "where": {"cell": [column - 1, row]}},
    )
    expect(way(visitor, "Forward")).to_contain_text("a barrier")
    expect(way(visitor, "Left")).to_contain_text("a pothole")
    expect(visitor.page.locator(".panel-note").first).to_have_text(f"next, at tick {visitor.tick()}")
    chosen = visitor.page.locator(".way[data-standing=taken] .way-name")
    expect(chosen).to_have_text("Forward left")
    expect(visitor.page.locator(".plan-canvas")).to_have_attribute(
        "aria-label", re.compile("Intended: forward left. 2 of six")
    )
    plain, tick = visitor.settled(), visitor.tick()
    way(visitor, "Forward").focus()
    visitor.settled(unlike=plain)  # the barrier is ringed on the road
    visitor.page.locator("#words").focus()
    visitor.page.get_by_role("button", name="Step").click()
    expect(visitor.page.locator(".caption")).to_contain_text("barrier")
    assert visitor.script.state()["vehicles"][0]["cell"] == [column - 1, row - 1]
    expect(visitor.page.locator(".panel-note").first).to_have_text(f"next, at tick {tick + 1}")
    expect(chosen).to_have_text("Forward")


def test_a_rejected_move_plays_beside_the_real_run(visit: Visit) -> None:
    visitor = visit()
    visitor.pause()
    visitor.script.act({"do": "step", "ticks": 3})
    tick = visitor.script.state()["tick"]
    expect(visitor.page.locator(".panel-note").first).to_have_text(f"next, at tick {tick}")
    visitor.page.locator(".way[data-standing=free]").first.click()
    expect(visitor.page.locator("#beside")).to_be_visible()


def test_the_matrix_holds_what_the_road_holds(visit: Visit) -> None:
    visitor = visit()
    column, row = cleared(visitor)
    canvas = visitor.page.locator(".occupancy-canvas")
    expect(canvas).to_have_attribute("aria-label", re.compile(r"1 of 240 cells are taken"))
    blank = canvas.evaluate("(canvas) => canvas.toDataURL()")
    visitor.script.act({"do": "add", "kind": "pothole", "count": 3})
    expect(canvas).to_have_attribute("aria-label", re.compile(r"4 of 240 cells are taken, 3 potholes"))
    visitor.until("(before) => document.querySelector('.occupancy-canvas').toDataURL() !== before", blank)
    assert f"column {column + 1} of row {row}" in (canvas.get_attribute("aria-label") or "")


def test_metrics_are_the_service_s_own(visit: Visit) -> None:
    visitor = visit()
    visitor.pause()
    visitor.script.act({"do": "step", "ticks": 70})
    state, judged = visitor.script.state(), None
    metrics = state["metrics"]
    rate = visitor.page.locator("[data-metric=rate]")
    expect(rate).to_contain_text(f"{metrics['successes']} of {metrics['episodes']}")
    expect(visitor.page.locator("[data-metric=distance]")).to_have_text(f"{round(metrics['distance_m'])} m")
    judged = asked(visitor, f"regret?from={state['tick'] - 60}&limit=60")["items"]
    lost = sum(item["ticks"] or 0 for item in judged)
    if any(item["lost"] for item in judged):
        expect(visitor.page.locator(".chart-told").nth(1)).to_have_text("the goal got out of reach")
    else:
        ticks = "1 tick" if lost == 1 else f"{lost} ticks"
        expect(visitor.page.locator(".chart-told").nth(1)).to_have_text(f"{ticks} lost in {len(judged)}")
    visitor.until(
        f"() => [...document.querySelectorAll('.chart-canvas')].every((one) => ({COLOURS})(one) > 1)"
    )


@pytest.mark.parametrize(
    ("said", "unsaid"), [("pothole map on", "pothole map off"), ("hide the path", "show the path")]
)
def test_layers_over_the_road_come_and_go_by_sentence(visit: Visit, said: str, unsaid: str) -> None:
    visitor = visit()
    visitor.pause()
    column, row = cleared(visitor)
    visitor.script.act({"do": "add", "kind": "pothole", "count": 1, "where": {"cell": [column, row - 4]}})
    visitor.step(2)
    expect(visitor.page.locator(".panel-note").first).to_have_text(f"next, at tick {visitor.tick()}")
    plain = visitor.settled()
    visitor.say(said)
    visitor.settled(unlike=plain)
    visitor.say(unsaid)
    visitor.settled(like=plain)


def test_layers_over_the_road_come_and_go_by_the_menu(visit: Visit) -> None:
    visitor = visit()
    visitor.pause()
    expect(visitor.page.locator(".panel-note").first).to_have_text(re.compile("next"))
    visitor.page.get_by_role("button", name="Views").click()
    pictures = [visitor.settled()]
    for name in ("Forecast", "Bounding boxes"):
        visitor.page.get_by_role("menuitemcheckbox", name=name).click()
        pictures.append(visitor.settled(unlike=pictures[-1]))
    assert len(set(pictures)) == 3


def test_the_service_draws_the_same_tick_and_the_page_again(visit: Visit) -> None:
    visitor = visit()
    visitor.pause()
    visitor.page.get_by_role("button", name="Views").click()
    visitor.page.get_by_role("menuitemradio", name="Renderer: server").click()
    theirs = visitor.page.locator(".service-canvas")
    expect(theirs).to_be_visible()
    expect(theirs).to_have_attribute("data-tick", str(visitor.tick()))
    visitor.script.act({"do": "step", "ticks": 1})
    expect(visitor.page.locator("[data-figure=tick] .figure-value")).to_have_text(
        str(visitor.script.state()["tick"])
    )
    expect(theirs).to_have_attribute("data-tick", str(visitor.tick()))
    assert theirs.evaluate(COLOURS) > 60
    visitor.page.get_by_role("menuitemradio", name="Renderer: browser").click()
    expect(theirs).to_be_hidden()


def test_pictures_that_cannot_be_read_are_told_and_the_page_draws_again(visit: Visit) -> None:
    visitor = visit()
    visitor.page.evaluate(
        "() => { window.createImageBitmap = () => Promise.reject(new Error('no picture')); }"
    )
    visitor.page.get_by_role("button", name="Views").click()
    visitor.page.get_by_role("menuitemradio", name="Renderer: server").click()
    expect(visitor.page.locator("#notice")).to_contain_text("The road is drawn here again.")
    visitor.page.keyboard.press("Escape")
    visitor.page.get_by_role("button", name="Views").click()
    expect(visitor.page.get_by_role("menuitemradio", name="Renderer: browser")).to_have_attribute(
        "aria-checked", "true"
    )
    expect(visitor.page.locator(".service-canvas")).to_be_hidden()


def test_between_desk_and_phone_the_views_stand_in_a_row_below(visit: Visit) -> None:
    visitor = visit(viewport={"width": 1100, "height": 768})
    boxes = [part(visitor, name).bounding_box() for name in ("plan", "occupancy", "metrics")]
    road = part(visitor, "road").bounding_box()
    assert road is not None
    assert len({box["y"] for box in boxes if box}) == 1
    assert all(box and box["y"] > road["y"] + road["height"] and box["height"] > 400 for box in boxes)
    part(visitor, "metrics").scroll_into_view_if_needed()
    expect(visitor.page.locator(".way").last).to_be_in_viewport(ratio=1)


def test_the_road_can_be_read_in_words(visit: Visit) -> None:
    visitor = visit()
    column, row = cleared(visitor)
    visitor.script.act({"do": "add", "kind": "pothole", "count": 1, "where": {"cell": [column, row - 2]}})
    words = visitor.page.get_by_role("region", name="The road in words")
    lane = words.locator("li").nth(column + 1)
    expect(lane).to_have_text(f"Lane {column + 1}, its own: a pothole 2 rows ahead.")
    expect(words.locator("li").first).to_contain_text(
        f"lane {column + 1} of 8, {row} rows from the destination"
    )
    assert words.get_attribute("aria-live") is None
    words.focus()
    box = words.bounding_box()
    assert box is not None
    assert box["width"] > 200


def test_a_phone_shows_one_panel_at_a_time_with_the_box_at_the_bottom(visit: Visit) -> None:
    visitor = visit(viewport={"width": 390, "height": 844}, has_touch=True, is_mobile=True)
    visitor.pause()
    for name in ("log", "plan", "metrics", "talk", "occupancy"):
        visitor.page.locator(f".tab[data-tab={name}]").tap()
        expect(visitor.page.locator(f"[data-view={name}]")).to_be_visible()
        shown = [each for each in ("log", "plan", "occupancy", "metrics") if part(visitor, each).is_visible()]
        assert shown == ([name] if name != "talk" else [])
        box = visitor.words.bounding_box()
        assert box is not None
        assert box["y"] + box["height"] <= 844
        assert box["y"] > 700
    visitor.page.get_by_role("button", name="Enlarge the occupancy").tap()
    large = part(visitor, "occupancy").element_handle()
    visitor.until(  # once the page has scrolled to it
        "(it) => { const at = it.getBoundingClientRect();"
        " return at.x === 0 && at.y === 0 && at.width === 390; }",
        large,
    )


def test_what_was_lost_is_reckoned_anew_when_the_run_becomes_another(visit: Visit) -> None:
    visitor = visit()
    column, row = cleared(visitor)
    first = visitor.tick()
    visitor.script.act({"do": "add", "kind": "barrier", "count": 1, "where": {"cell": [column, row - 1]}})
    visitor.script.act({"do": "step", "ticks": 4})
    judged = asked(visitor, f"regret?from={first}&limit=60")["items"]
    assert judged[0]["blocked"] == 1
    chart = visitor.page.locator("[data-chart=blocked]")
    told = asked(visitor, f"regret?from={max(0, first + 4 - 60)}&limit=60")["items"]
    expect(visitor.page.locator(".chart-told").nth(1)).to_contain_text(f"lost in {len(told)}")
    visitor.drawn()
    blocked = chart.evaluate("(canvas) => canvas.toDataURL()")
    visitor.script.act({"do": "undo"})
    assert asked(visitor, f"regret?from={first}&limit=60")["items"][0]["blocked"] == 0
    visitor.until(
        "(before) => document.querySelector('[data-chart=blocked]').toDataURL() !== before", blocked
    )
