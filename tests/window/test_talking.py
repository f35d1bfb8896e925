"""Talking in the window: the service's own replies, and what the line does with them."""

from __future__ import annotations

import pygame
import pytest

from service.window.exchange import Exchange
from service.window.keys import examples
from service.window.theme import ACCENT
from sim.types import Kind, Outcome
from tests.window.conftest import Open
from tests.window.driver import CARELESS, Driver

CTRL = pygame.KMOD_CTRL


def potholes(driver: Driver) -> int:
    return driver.game.session.run.world.count(Kind.POTHOLE)


def test_a_sentence_is_done_and_answered(window: Open) -> None:
    driver = window()
    exchange = driver.say("add three potholes")
    assert exchange.said == "add three potholes"
    assert exchange.reply.startswith("Added 3 potholes")
    assert exchange.reply.endswith("; there are 13 potholes now.")
    assert [(each.path, each.before, each.after) for each in exchange.changes] == [("potholes", 10, 13)]
    assert potholes(driver) == 13
    assert driver.console.line.text == ""
    assert driver.game.session.log.latest(1)[0].text == exchange.reply


def test_why_is_answered(window: Open) -> None:
    driver = window()
    driver.seconds(3.2)
    exchange = driver.say("why did you do that?")
    assert exchange.done
    assert exchange.reply.startswith("Just now ")
    assert driver.say("explain why you stopped").done


def test_a_long_question_is_answered_while_frames_go_on(window: Open) -> None:
    driver = window()
    driver.seconds(2)
    exchange = driver.say("what if there were no potholes?")
    assert exchange.done
    assert exchange.reply.startswith("If there were no potholes")


def test_undo_moments_and_teaching_are_those_of_the_service(window: Open) -> None:
    driver = window()
    driver.letter("p")
    driver.say("save this as before lunch")
    driver.say("when I say rush hour, I mean exactly 20 potholes")
    assert driver.say("rush hour").done
    assert potholes(driver) == 20
    assert driver.say("undo that").done
    assert potholes(driver) == 10
    driver.say("remove all potholes")
    assert driver.say("load before lunch").done
    assert potholes(driver) == 10


def test_what_is_not_understood_leaves_the_line_and_offers_suggestions(window: Open) -> None:
    driver = window()
    before = driver.game.session.sequence
    exchange = driver.say("please add a big red truck")
    assert not exchange.done
    assert driver.game.session.sequence == before
    assert driver.console.line.text == "", "what was refused leaves the line; ↑ brings it back"
    first, second, *_ = exchange.offers
    driver.press(pygame.K_TAB)
    assert driver.console.line.text == first
    driver.press(pygame.K_DOWN)
    assert driver.console.line.text == second
    driver.press(pygame.K_UP)
    driver.press(pygame.K_UP)
    assert driver.console.line.text == "please add a big red truck"
    driver.press(pygame.K_TAB)
    driver.press(pygame.K_RETURN)
    assert driver.answered().said == first


@pytest.mark.parametrize("focused", [True, False])
def test_a_choice_is_made_by_its_number(window: Open, focused: bool) -> None:
    driver = window()
    exchange = driver.say("make it faster")
    assert exchange.asks
    if not focused:
        driver.press(pygame.K_ESCAPE)
    driver.letter("1")
    assert driver.answered().said == "make the simulation faster"
    assert driver.game.session.playback_speed == 2.0


def test_a_digit_in_a_sentence_is_no_choice(window: Open) -> None:
    driver = window()
    driver.say("make it faster")
    driver.press(pygame.K_u, CTRL)
    driver.type("add 2 cars")
    assert driver.console.line.text == "add 2 cars"


def test_an_offer_can_be_clicked(window: Open) -> None:
    driver = window()
    exchange = driver.say("make it faster")
    corner = driver.window.place("console").topleft
    spot = next(spot for spot, what in driver.console.spots if what == ("say", exchange.offers[0]))
    driver.click(spot.move(corner).center)
    assert driver.answered().said == exchange.offers[0]


def test_what_was_said_comes_back(window: Open) -> None:
    driver = window()
    driver.say("add two cars")
    driver.say("remove two cars")
    driver.press(pygame.K_UP)
    assert driver.console.line.text == "remove two cars"
    driver.press(pygame.K_UP)
    assert driver.console.line.text == "add two cars"
    driver.press(pygame.K_DOWN)
    driver.press(pygame.K_DOWN)
    assert driver.console.line.text == ""


def test_tab_completes(window: Open) -> None:
    driver = window()
    driver.letter("/")
    driver.type("remove all pot")
    driver.press(pygame.K_TAB)
    assert driver.console.line.text == "remove all potholes"


def test_the_slash_that_begins_a_sentence_is_not_in_it(window: Open) -> None:
    driver = window()
    driver.letter("/")
    assert (driver.console.focused, driver.console.line.text) == (True, "")
    driver.type("1/2")
    assert driver.console.line.text == "1/2"


def test_letters_are_no_commands_while_one_writes(window: Open) -> None:
    driver = window()
    driver.press(pygame.K_RETURN)
    driver.type("pmr?+-")
    assert driver.console.line.text == "pmr?+-"
    assert not driver.game.session.paused
    assert driver.game.session.sequence == 0


def test_editing_keys(window: Open) -> None:
    driver = window()
    driver.letter("/")
    driver.type("add five potholes")
    driver.press(pygame.K_w, CTRL)
    driver.type("cars")
    driver.press(pygame.K_a, CTRL)
    driver.press(pygame.K_DELETE)
    driver.type("A")
    driver.press(pygame.K_END)
    driver.press(pygame.K_BACKSPACE)
    driver.press(pygame.K_LEFT)
    driver.press(pygame.K_LEFT, CTRL)
    driver.press(pygame.K_HOME)
    driver.press(pygame.K_RIGHT, CTRL)
    assert (driver.console.line.text, driver.console.line.cursor) == ("Add five car", 3)


def test_an_input_method_shows_what_it_composes(window: Open) -> None:
    driver = window()
    driver.letter("/")
    plain = driver.picture()
    pygame.event.post(pygame.event.Event(pygame.TEXTEDITING, text="にほ", start=0, length=2))
    driver.frames(1)
    assert driver.console.line.composing == "にほ"
    assert driver.picture() != plain
    driver.type("日本")
    assert (driver.console.line.text, driver.console.line.composing) == ("日本", "")


def test_views_by_sentence(window: Open) -> None:
    driver = window()
    assert driver.say("hide the log").done
    assert "log" not in driver.window.panels.visible
    assert driver.say("show the log").done
    assert "log" in driver.window.panels.visible
    assert "large" in driver.say("show the planning view").reply
    assert driver.window.panels.visible == ("plan",)
    assert driver.say("hide the plan").done
    assert driver.window.panels.visible == ("road", "schematic", "occupancy", "log")


def test_a_view_and_a_change_in_one_breath_are_done_together_or_not_at_all(window: Open) -> None:
    driver = window()
    exchange = driver.say("hide the log and add two potholes")
    assert exchange.done
    assert potholes(driver) == 12
    assert "log" not in driver.window.panels.visible
    assert not driver.say("hide the schematic and add 900 potholes").done
    assert "schematic" in driver.window.panels.visible
    assert not driver.say("add two potholes and show the sensors").done
    assert potholes(driver) == 12


def test_a_view_that_is_not_here_is_refused_with_those_that_are(window: Open) -> None:
    exchange = window().say("show the sensors")
    assert not exchange.done
    assert "road, schematic, occupancy, plan, log" in exchange.reply


def test_clicks_on_titles_and_crosses(window: Open) -> None:
    driver = window()
    place = driver.window.place("occupancy")
    driver.click((place.right - 10, place.y + 10))
    assert "occupancy" not in driver.window.panels.visible
    place = driver.window.place("schematic")
    driver.click((place.x + 20, place.y + 10))
    assert driver.window.panels.visible == ("schematic",)
    corner = driver.window.place("console").topleft
    spots = {what: spot.move(corner) for spot, what in driver.console.spots}
    driver.click(spots["help", ""].center)
    assert driver.controls.overlay == "help"


def test_an_example_of_the_help_goes_into_the_line(window: Open) -> None:
    driver = window()
    driver.letter("?")
    spot = next(spot for spot, what in driver.window._spots() if what == ("write", examples()[0]))
    driver.click(spot.center)
    assert driver.controls.overlay is None
    assert (driver.console.focused, driver.console.line.text) == (True, examples()[0])


def test_every_sentence_of_the_help_can_be_said(window: Open) -> None:
    driver = window()
    driver.seconds(2.2)
    for sentence in examples():
        exchange = driver.say(sentence)
        assert exchange.done, exchange


def test_a_crash_is_told_in_the_log_and_asked_about(window: Open) -> None:
    driver = window(config=CARELESS)
    while driver.game.session.run.world.outcome is Outcome.RUNNING:
        driver.seconds(0.5)
    assert driver.game.session.run.world.outcome is Outcome.CRASH
    driver.game.settle()
    exchange = driver.say("why?")
    assert exchange.done
    assert "tick" in exchange.reply
    assert ACCENT in driver.colours(driver.window.place("console"))


def test_a_long_reply_can_be_scrolled(window: Open) -> None:
    driver = window(size=(640, 480))
    driver.letter("p")
    driver.letter("/")
    driver.console.take(Exchange(None, "The road is long. " * 40))
    driver.frames(1)
    first = driver.picture()
    driver.press(pygame.K_PAGEDOWN)
    assert driver.console.scroll > 0
    assert driver.picture() != first
    driver.console.scroll = 99
    driver.frames(1)
    assert driver.console.scroll < 40
    for _ in range(14):
        driver.press(pygame.K_PAGEUP)
    assert driver.console.scroll == 0


def test_a_defect_is_told_and_the_window_goes_on(window: Open, monkeypatch: pytest.MonkeyPatch) -> None:
    driver = window()

    async def broken(*_: object, **__: object) -> None:
        raise ZeroDivisionError

    with monkeypatch.context() as patch:
        patch.setattr(driver.game._listener, "execute", broken)
        assert "defect" in driver.say("add a pothole").reply
    assert driver.say("add a pothole").done
