"""The first picture asks how many potholes, shows them, and goes on to exactly that road."""

from __future__ import annotations

import pygame

from service.window.theme import ACCENT
from sim.render.theme import REFUSED
from sim.state import SimState
from sim.types import Kind
from tests.window.conftest import Open


def test_enter_takes_what_is_proposed(window: Open) -> None:
    driver = window(ask=True)
    assert driver.window.game is None
    driver.press(pygame.K_RETURN)
    assert driver.game.session.run.world.count(Kind.POTHOLE) == 10


def test_digits_replace_what_is_proposed_and_letters_are_nothing(window: Open) -> None:
    driver = window(ask=True)
    driver.type("2x3")
    assert driver.window.start.text == "23"
    driver.press(pygame.K_BACKSPACE)
    driver.press(pygame.K_UP)
    driver.press(pygame.K_UP)
    driver.press(pygame.K_DOWN)
    driver.press(pygame.K_RETURN)
    assert driver.game.session.run.world.count(Kind.POTHOLE) == 3


def test_the_road_behind_is_the_one_that_is_driven(window: Open) -> None:
    driver = window(ask=True)
    driver.type("17")
    shown = driver.window.start._tick
    assert shown is not None
    first = SimState.start(shown.state.config).world.digest()
    driver.press(pygame.K_RETURN)
    assert driver.game.session.run.world.digest() == first


def test_a_number_that_no_road_can_have_is_refused_in_words(window: Open) -> None:
    driver = window(ask=True)
    driver.type("999")
    assert "room for" in driver.window.start.message
    driver.press(pygame.K_RETURN)
    assert driver.window.game is None
    assert REFUSED in driver.colours(driver.screen.get_rect())
    driver.press(pygame.K_BACKSPACE)
    assert driver.window.start.message == ""
    driver.press(pygame.K_RETURN)
    assert driver.game.session.run.world.count(Kind.POTHOLE) == 99


def test_no_number_is_not_taken_for_none(window: Open) -> None:
    driver = window(ask=True)
    driver.press(pygame.K_BACKSPACE)
    driver.press(pygame.K_RETURN)
    assert driver.window.game is None
    assert driver.window.start.message


def test_the_button_can_be_clicked(window: Open) -> None:
    for size in ((1440, 900), (800, 600)):
        driver = window(ask=True, size=size)
        button = driver.window.start.button(driver.screen)
        assert ACCENT in driver.colours(button)
        driver.click(button.center)
        assert driver.window.game is not None


def test_the_preview_drives(window: Open) -> None:
    driver = window(ask=True)
    driver.seconds(1.2)
    shown = driver.window.start._tick
    assert shown is not None
    assert shown.state.world.tick == 3


def test_escape_leaves(window: Open) -> None:
    driver = window(ask=True)
    driver.press(pygame.K_ESCAPE)
    assert driver.window.closed


def test_with_a_number_given_nothing_is_asked(window: Open) -> None:
    assert window(ask=False).window.game is not None
