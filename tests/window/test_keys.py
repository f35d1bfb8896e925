"""Keys: each does what the help says, seen in the session's own state."""

from __future__ import annotations

from pathlib import Path

import pygame
import pytest

from service.window.keys import key_groups
from service.window.panels import PANELS
from sim.config import Config
from sim.types import Mode
from tests.window.conftest import Open
from tests.window.driver import Driver

SHIFT, CTRL = pygame.KMOD_SHIFT, pygame.KMOD_CTRL
EMPTY = Config(seed=1, potholes=0, vehicles=0)


def cell(driver: Driver) -> tuple[int, int]:
    world = driver.game.session.run.world
    return world.road.cell(world.av)


def tick(driver: Driver) -> int:
    return driver.game.session.run.world.tick


@pytest.mark.parametrize("letter", ["p", "P", " "])
def test_p_and_space_stand_still_and_go_on(window: Open, letter: str) -> None:
    driver = window()
    driver.letter(letter)
    assert driver.game.session.paused
    stood = tick(driver)
    driver.seconds(2)
    assert tick(driver) == stood
    driver.letter(letter)
    driver.seconds(1.1)
    assert tick(driver) == stood + 2


def test_r_is_this_road_from_its_start(window: Open) -> None:
    driver = window()
    first = cell(driver)
    driver.seconds(3)
    assert cell(driver) != first
    driver.letter("r")
    assert cell(driver) == first
    assert driver.console.latest is not None
    assert "start" in driver.console.latest.reply


def test_m_and_arrows_drive_by_hand(window: Open) -> None:
    driver = window(config=EMPTY)
    driver.letter("m")
    assert driver.game.session.run.mode is Mode.MANUAL
    driver.seconds(1.1)
    column, row = cell(driver)
    assert row == 29
    for key, mod, way in (
        (pygame.K_UP, 0, (0, -1)),
        (pygame.K_LEFT, 0, (-1, 0)),
        (pygame.K_RIGHT, 0, (1, 0)),
        (pygame.K_LEFT, SHIFT, (-1, -1)),
        (pygame.K_RIGHT, SHIFT, (1, -1)),
        (pygame.K_DOWN, 0, (0, 0)),
    ):
        driver.press(key, mod)
        driver.seconds(0.55)
        column, row = column + way[0], row + way[1]
        assert cell(driver) == (column, row), key
    driver.letter("m")
    driver.seconds(0.55)
    assert cell(driver) == (column, row - 1)


def test_standing_still_by_hand_each_arrow_is_a_turn(window: Open) -> None:
    driver = window(config=EMPTY)
    driver.letter("m")
    driver.letter("p")
    stood, (column, row) = tick(driver), cell(driver)
    driver.press(pygame.K_UP)
    driver.press(pygame.K_LEFT)
    assert (tick(driver), cell(driver)) == (stood + 2, (column - 1, row - 1))
    assert driver.game.session.paused


def test_arrows_step_back_and_on_while_it_stands_still(window: Open) -> None:
    driver = window()
    driver.seconds(3)
    driver.letter("p")
    stood, world = tick(driver), driver.game.session.run.world.digest()
    driver.press(pygame.K_LEFT)
    assert tick(driver) == stood - 1
    driver.press(pygame.K_RIGHT)
    assert (tick(driver), driver.game.session.run.world.digest()) == (stood, world)
    driver.letter(",")
    driver.letter(".")
    assert (tick(driver), driver.game.session.run.world.digest()) == (stood, world)


def test_arrows_alone_say_what_to_press(window: Open) -> None:
    driver = window()
    driver.press(pygame.K_UP)
    assert driver.console.latest is not None
    assert "Press M" in driver.console.latest.reply


def test_plus_and_minus_change_the_pace(window: Open) -> None:
    driver = window()
    driver.letter("+")
    assert driver.game.session.playback_speed == 2.0
    began = tick(driver)
    driver.seconds(2.1)
    assert tick(driver) in (began + 8, began + 9)
    driver.letter("-")
    driver.letter("-")
    assert driver.game.session.playback_speed == 0.5


@pytest.mark.parametrize(("pace", "at_least"), [(32, 60), (64, 120)])
def test_no_pace_is_held_up_by_the_frames(window: Open, pace: int, at_least: int) -> None:
    driver = window(config=Config(seed=1, potholes=0, vehicles=0, rows=400))
    driver.say(f"set the playback speed to {pace}")
    assert driver.game.session.playback_speed == pace
    began = tick(driver)
    driver.seconds(1)
    assert tick(driver) - began >= at_least


def test_undo_and_redo(window: Open) -> None:
    driver = window()
    driver.letter("p")
    before = driver.game.session.run.world.digest()
    driver.say("add three potholes")
    driver.press(pygame.K_ESCAPE)
    after = driver.game.session.run.world.digest()
    driver.press(pygame.K_z, CTRL)
    assert driver.game.session.run.world.digest() == before
    driver.press(pygame.K_y, CTRL)
    assert driver.game.session.run.world.digest() == after
    driver.press(pygame.K_z, CTRL)
    driver.press(pygame.K_z, CTRL | SHIFT)
    assert driver.game.session.run.world.digest() == after


@pytest.mark.parametrize(("number", "name"), list(enumerate(PANELS, 1)))
def test_f_keys_hide_show_and_enlarge(window: Open, number: int, name: str) -> None:
    driver = window()
    key = getattr(pygame, f"K_F{number}")
    driver.press(key)
    assert name not in driver.window.panels.visible
    with pytest.raises(KeyError):
        driver.window.place(name)
    driver.press(key)
    assert name in driver.window.panels.visible
    driver.press(key, SHIFT)
    assert driver.window.panels.visible == (name,)
    assert driver.window.place(name).width > 1400
    driver.press(pygame.K_ESCAPE)
    assert len(driver.window.panels.visible) == 5


def test_escape_goes_back_step_by_step_and_asks_before_it_quits(window: Open) -> None:
    driver = window()
    driver.press(pygame.K_F1, SHIFT)
    driver.letter("/")
    assert driver.console.focused
    driver.press(pygame.K_ESCAPE)
    assert not driver.console.focused
    driver.letter("?")
    assert driver.controls.overlay == "help"
    driver.press(pygame.K_ESCAPE)
    assert driver.controls.overlay is None
    driver.press(pygame.K_ESCAPE)
    assert driver.window.panels.large is None
    driver.press(pygame.K_ESCAPE)
    assert driver.controls.overlay == "quit"
    driver.press(pygame.K_ESCAPE)
    assert (driver.controls.overlay, driver.window.closed) == (None, False)
    driver.press(pygame.K_ESCAPE)
    driver.press(pygame.K_RETURN)
    assert driver.window.closed


def test_a_key_that_is_held_down_pauses_once(window: Open) -> None:
    driver = window()
    for _ in range(4):
        pygame.event.post(pygame.event.Event(pygame.KEYDOWN, key=pygame.K_p, mod=0, unicode="p"))
        pygame.event.post(pygame.event.Event(pygame.TEXTINPUT, text="p"))
    driver.frames(2)
    assert driver.game.session.paused
    assert driver.game.session.sequence == 1


def test_f11_asks_for_the_whole_screen(window: Open) -> None:
    driver = window()
    driver.press(pygame.K_F11)
    assert driver.window.fullscreen
    driver.press(pygame.K_F11)
    assert not driver.window.fullscreen


def test_s_saves_a_picture_and_says_where(window: Open, tmp_path: Path) -> None:
    driver = window(folder=tmp_path)
    driver.seconds(1.2)
    driver.letter("s")
    driver.letter("s")
    names = sorted(path.name for path in tmp_path.iterdir())
    assert names == ["roadtalk-tick-2-2.png", "roadtalk-tick-2.png"]
    assert pygame.image.load(tmp_path / names[0]).get_size() == (1440, 900)
    assert driver.console.latest is not None
    assert names[0] in driver.console.latest.reply


def test_a_picture_that_cannot_be_saved_is_told(window: Open, tmp_path: Path) -> None:
    driver = window(folder=tmp_path / "nowhere")
    driver.letter("s")
    assert driver.console.latest is not None
    assert not driver.console.latest.done
    assert "could not be saved" in driver.console.latest.reply


def test_help_tells_every_letter_that_does_something(window: Open) -> None:
    told = " ".join(key for _, keys in key_groups() for key, _ in keys)
    for letter in window().controls._letters:
        if letter not in (" ", "=", "−"):
            assert letter.upper() in told, letter
