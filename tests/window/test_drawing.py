"""What is on the screen: every view shows the same state, and only what has changed is drawn."""

from __future__ import annotations

import pygame
import pytest

from service.window.layout import body_of
from service.window.theme import CARD, GROUND
from sim.config import Config
from sim.render import theme
from sim.types import Kind, Outcome
from tests.window.conftest import Open
from tests.window.driver import CARELESS, Driver

SPARSE = Config(seed=3, potholes=6, vehicles=6, barriers=2, pedestrians=2)


def body(driver: Driver, name: str) -> pygame.Rect:
    return body_of(driver.window.place(name))


def _like(colour: tuple[int, int, int], colours: set[tuple[int, int, int]]) -> bool:
    """Whether one of these colours is nearly it: letters are drawn smoothly, and may have no full pixel."""
    return any(max(abs(a - b) for a, b in zip(colour, each, strict=True)) < 40 for each in colours)


def test_the_five_views_show_what_there_is(window: Open) -> None:
    driver = window(config=SPARSE)
    driver.seconds(1.3)
    for name in ("schematic", "occupancy"):
        colours = driver.colours(body(driver, name))
        for kind in (Kind.AV, Kind.VEHICLE, Kind.POTHOLE, Kind.BARRIER, Kind.PEDESTRIAN):
            assert theme.SCHEMATIC[kind] in colours, (name, kind)
    assert theme.MOVE in driver.colours(body(driver, "plan"))
    assert theme.EDGE_LINE in driver.colours(body(driver, "road"))
    assert not _like(theme.LINES["changed"], driver.colours(body(driver, "log")))
    driver.say("add a pothole")
    assert _like(theme.LINES["changed"], driver.colours(body(driver, "log")))


def test_the_header_names_the_planner_as_people_know_it(window: Open) -> None:
    driver = window(config=Config(seed=3, planner="astar"))
    assert driver.window._status("road") == "1×  ·  A*  ·  seed 3"
    driver.say("let me drive")
    assert driver.window._status("road") == "1×  ·  by hand  ·  seed 3"


def test_what_is_not_on_the_road_is_in_no_view(window: Open) -> None:
    driver = window(config=Config(seed=3, potholes=0, vehicles=5))
    for name in ("schematic", "occupancy"):
        colours = driver.colours(body(driver, name))
        assert theme.SCHEMATIC[Kind.POTHOLE] not in colours
        assert theme.SCHEMATIC[Kind.VEHICLE] in colours


def test_a_change_is_in_all_views_in_the_same_frame(window: Open) -> None:
    driver = window(config=Config(seed=3, potholes=0, vehicles=0))
    driver.letter("p")
    driver.seconds(1)
    bare = driver.colours(body(driver, "road"))
    driver.say("add a barrier 5 m ahead")
    for name in ("schematic", "occupancy"):
        assert theme.SCHEMATIC[Kind.BARRIER] in driver.colours(body(driver, name))
    assert theme.REFUSED in driver.colours(body(driver, "plan"))
    new = driver.colours(body(driver, "road")) - bare
    assert any(red > 200 > 160 > green > blue for red, green, blue in new)  # stripes of orange, smoothed


def test_things_glide_between_ticks(window: Open) -> None:
    driver = window(config=SPARSE)
    driver.seconds(1.0)
    pictures = set()
    for _ in range(20):
        driver.frames(1)
        pictures.add(pygame.image.tobytes(driver.screen.subsurface(body(driver, "road")), "RGB"))
    assert len(pictures) >= 18


def test_nothing_is_drawn_while_nothing_changes(window: Open) -> None:
    driver = window()
    driver.seconds(1)
    driver.letter("p")
    driver.seconds(1)
    before = driver.picture()
    assert all(driver.frames(1) == [] for _ in range(30))
    assert driver.picture() == before


def test_between_ticks_only_the_road_is_drawn(window: Open) -> None:
    driver = window()
    driver.seconds(1.25)
    dirty = driver.frames(1)
    assert len(dirty) == 1
    assert body(driver, "road").contains(dirty[0])


def test_what_is_drawn_bit_by_bit_is_what_would_be_drawn_at_once(window: Open) -> None:
    driver = window()
    driver.say("why?")
    driver.letter("?")
    driver.press(pygame.K_ESCAPE)
    driver.press(pygame.K_F3)
    driver.press(pygame.K_F3)
    driver.seconds(2.3)
    driver.say("pause")
    driver.press(pygame.K_ESCAPE)
    driver.seconds(1)
    bit_by_bit = driver.picture()
    driver.window.resize(driver.screen)
    driver.frames(1)
    assert driver.picture() == bit_by_bit


def test_a_card_stays_on_top_while_it_drives_below(window: Open) -> None:
    driver = window()
    driver.letter("?")
    middle = driver.screen.get_rect().center
    for _ in range(40):
        driver.frames(1)
        assert driver.screen.get_at(middle)[:3] == CARD
    driver.press(pygame.K_ESCAPE)
    assert driver.screen.get_at(middle)[:3] != CARD


def test_a_crash_is_written_over_the_road(window: Open) -> None:
    driver = window(config=CARELESS)
    assert theme.OUTCOMES["crash"] not in driver.colours(body(driver, "road"))
    while driver.game.session.run.world.outcome is Outcome.RUNNING:
        driver.seconds(0.5)
    assert driver.game.session.run.world.outcome is Outcome.CRASH
    driver.game.settle()
    driver.frames(1)
    assert theme.OUTCOMES["crash"] in driver.colours(body(driver, "road"))
    assert theme.OUTCOMES["crash"] in driver.colours(body(driver, "log"))


def test_arriving_is_written_over_the_road(window: Open) -> None:
    driver = window(config=Config(seed=1, potholes=0, vehicles=0, rows=6))
    while driver.game.session.run.world.outcome is Outcome.RUNNING:
        driver.seconds(0.5)
    assert theme.OUTCOMES["success"] in driver.colours(body(driver, "road"))


def test_the_plan_is_that_of_the_state_it_names(window: Open) -> None:
    driver = window()
    driver.seconds(2.25)
    showing = driver.window._showing
    assert showing is not None
    state, decision = showing.planned
    assert decision is not None
    assert state.world.tick == decision.tick == driver.game.session.run.world.tick - 1
    driver.letter("p")
    driver.seconds(1)
    state, decision = showing.planned
    assert decision is not None
    assert state is driver.game.session.run
    foretold = decision.move
    driver.press(pygame.K_RIGHT)
    done = driver.game.session.latest_decision()
    assert done is not None
    assert done[0].move is foretold


@pytest.mark.parametrize("size", [(320, 320), (640, 480), (800, 600), (1024, 400), (420, 1000), (2560, 1440)])
def test_any_size_has_a_picture(window: Open, size: tuple[int, int]) -> None:
    driver = window(size=size)
    driver.seconds(1.1)
    driver.say("why did you do that?")
    driver.press(pygame.K_ESCAPE)
    for key in (pygame.K_F1, pygame.K_F2, pygame.K_F3, pygame.K_F4, pygame.K_F5):
        driver.press(key, pygame.KMOD_SHIFT)
        driver.frames(1)
    driver.press(pygame.K_ESCAPE)
    driver.letter("?")
    driver.press(pygame.K_ESCAPE)
    for key in (pygame.K_F1, pygame.K_F2, pygame.K_F3, pygame.K_F4, pygame.K_F5):
        driver.press(key)
        driver.frames(1)
    assert driver.window.panels.visible == ()
    assert len(driver.colours(driver.window.place("console"))) > 5


@pytest.mark.parametrize(
    "config",
    [
        Config(seed=1, columns=3, rows=4, visible_rows=4, potholes=0, vehicles=1),
        Config(seed=1, columns=64, rows=30),
        Config(seed=1, columns=8, rows=512),
        Config(seed=1, visible_rows=30),
    ],
)
def test_any_shape_of_road_has_a_picture(window: Open, config: Config) -> None:
    driver = window(config=config, size=(1000, 700))
    driver.seconds(1.2)
    for name in ("schematic", "occupancy"):
        assert theme.SCHEMATIC[Kind.AV] in driver.colours(body(driver, name)), name


def test_another_size_is_drawn_anew(window: Open) -> None:
    driver = window()
    driver.seconds(1)
    driver.window.resize(pygame.display.set_mode((900, 700), pygame.RESIZABLE))
    driver.frames(1)
    assert driver.window.place("console").bottom <= 700
    assert driver.screen.get_at((2, 2))[:3] == GROUND


def test_ticks_come_at_the_session_s_pace_whatever_the_frames(window: Open) -> None:
    driver = window()
    driver.seconds(10)
    assert driver.game.session.run.world.tick in (19, 20)


def test_after_a_stall_nothing_is_made_up_for(window: Open) -> None:
    driver = window()
    driver.seconds(1.1)
    tick = driver.game.session.run.world.tick
    driver.now_s += 60
    driver.frames(1)
    assert driver.game.session.run.world.tick <= tick + 1


def test_the_log_can_be_read_back(window: Open) -> None:
    driver = window()
    driver.letter("p")
    for _ in range(6):
        driver.say("add a pothole")
        driver.say("undo")
    driver.press(pygame.K_ESCAPE)
    place = body(driver, "log")
    newest = pygame.image.tobytes(driver.screen.subsurface(place), "RGB")
    driver.press(pygame.K_PAGEUP)
    assert pygame.image.tobytes(driver.screen.subsurface(place), "RGB") != newest
    driver.press(pygame.K_PAGEDOWN)
    assert pygame.image.tobytes(driver.screen.subsurface(place), "RGB") == newest
    pygame.event.post(pygame.event.Event(pygame.MOUSEWHEEL, x=0, y=2))
    driver.frames(1)
    assert driver.controls.log_back == 2
