"""Everything that a key or a click of the window does can be said, and does the same."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import pygame
import pytest

from service.window import texts
from service.window.controls import F_KEYS
from service.window.panels import PANELS
from service.window.spoken import phrases, spoken_act
from service.window.texts import text
from sim.types import Mode
from tests.window.conftest import Open
from tests.window.driver import Driver

CTRL, SHIFT = pygame.KMOD_CTRL, pygame.KMOD_SHIFT
Do = Callable[[Driver], object]


def letter(each: str) -> Do:
    return lambda driver: driver.letter(each)


def key(code: int, mod: int = 0) -> Do:
    return lambda driver: driver.press(code, mod)


def steps(driver: Driver) -> None:
    driver.say("step three ticks")
    driver.press(pygame.K_ESCAPE)


def changes(driver: Driver) -> None:
    driver.say("add three potholes")
    driver.press(pygame.K_ESCAPE)


def undone(driver: Driver) -> None:
    changes(driver)
    driver.press(pygame.K_z, CTRL)


def by_hand(driver: Driver) -> None:
    driver.letter("m")


def nothing(_: Driver) -> None:
    """The road as it stands, paused."""


ACTS: dict[str, tuple[Do, Do, list[str]]] = {
    "resume": (nothing, letter("p"), ["resume"]),
    "restart": (steps, letter("r"), ["restart the road"]),
    "by hand": (nothing, letter("m"), ["let me drive"]),
    "by itself": (by_hand, letter("m"), ["drive yourself"]),
    "faster": (nothing, letter("+"), ["faster playback"]),
    "slower": (nothing, letter("-"), ["slower playback"]),
    "back": (steps, letter(","), ["go back one tick"]),
    "step": (nothing, letter("."), ["step"]),
    "undo": (changes, key(pygame.K_z, CTRL), ["undo"]),
    "redo": (undone, key(pygame.K_y, CTRL), ["redo"]),
    "full screen": (nothing, key(pygame.K_F11), ["full screen"]),
    "help": (nothing, letter("?"), ["show the keys"]),
    "quit": (nothing, key(pygame.K_ESCAPE), ["quit"]),
    "forward": (by_hand, key(pygame.K_UP), ["drive forward", "step"]),
    "stay": (by_hand, key(pygame.K_DOWN), ["stay", "step"]),
    "left": (by_hand, key(pygame.K_LEFT), ["drive left", "step"]),
    "right": (by_hand, key(pygame.K_RIGHT), ["drive right", "step"]),
    "diagonally left": (by_hand, key(pygame.K_LEFT, SHIFT), ["drive diagonally left", "step"]),
    "diagonally right": (by_hand, key(pygame.K_RIGHT, SHIFT), ["drive diagonally right", "step"]),
    **{
        f"hide {view}": (nothing, key(F_KEYS[number]), [f"hide the {view}"])
        for number, view in enumerate(PANELS)
    },
    **{
        f"show {view}": (key(F_KEYS[number]), key(F_KEYS[number]), [f"show the {view}"])
        for number, view in enumerate(PANELS)
    },
    **{
        f"enlarge {view}": (nothing, key(F_KEYS[number], SHIFT), [f"enlarge the {view}"])
        for number, view in enumerate(PANELS)
    },
}
"""What comes before, the key, and what says the same."""


def standing(driver: Driver) -> dict[str, Any]:
    """All that a key can change."""
    session, controls, panels = driver.game.session, driver.controls, driver.window.panels
    return {
        "world": session.run.world,
        "mode": session.run.mode,
        "queue": session.run.queue,
        "paused": session.paused,
        "speed": session.playback_speed,
        "shown": set(panels.shown),
        "large": panels.large,
        "overlay": controls.overlay,
        "fullscreen": controls.fullscreen,
    }


@pytest.mark.parametrize("name", ACTS)
def test_what_a_key_does_can_be_said(window: Open, name: str) -> None:
    before, press, sentences = ACTS[name]
    ways: list[Do] = [press, lambda driver: [driver.say(sentence) for sentence in sentences]]
    came: list[dict[str, Any]] = []
    for way in ways:
        driver = window()
        driver.letter("p")
        before(driver)
        start = standing(driver)
        way(driver)
        driver.game.settle()
        came.append(standing(driver))
        assert came[-1] != start, f"{name} did nothing"
    assert came[0] == came[1]
    print(f"{len(ACTS) + 1} acts")


def test_a_picture_is_saved_because_it_was_said(window: Open, tmp_path: Any) -> None:
    driver = window(folder=tmp_path)
    exchange = driver.say("save a picture")
    assert exchange.reply.startswith("Saved a picture")
    assert len(list(tmp_path.glob("*.png"))) == 1


def test_views_are_all_back_because_it_was_said(window: Open) -> None:
    driver = window()
    driver.say("hide the log")
    driver.say("enlarge the plan")
    assert driver.say("show all views").reply == text("panels", "all_again")
    assert driver.window.panels.visible == PANELS
    assert driver.game.session.run.mode is Mode.AUTO


@pytest.fixture(params=texts.languages())
def spoken(request: pytest.FixtureRequest) -> Iterator[str]:
    """Each language, for a while."""
    texts.choose_language(request.param)
    yield request.param
    texts.choose_language("en")


def test_each_phrase_names_one_act(spoken: str) -> None:
    found = list(phrases())
    assert len(found) >= 20, spoken
    for name, view, phrase in found:
        assert spoken_act(f"{phrase.capitalize()}!") == (name, view)
    assert spoken_act("add five potholes") is None
    assert spoken_act("") is None
