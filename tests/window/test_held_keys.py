"""Arrows that are held down, and decisions in the log."""

from __future__ import annotations

import pygame

from service.window.decision_lines import DecisionLine
from sim.config import Config
from sim.types import Mode, Outcome
from tests.window.conftest import Open
from tests.window.driver import CARELESS, Driver

EMPTY = Config(seed=4, potholes=0, vehicles=0)


def hold(driver: Driver, key: int, seconds: float) -> None:
    """A key down for so long, repeated as the system repeats it, then up."""
    for _ in range(round(seconds * 20)):
        pygame.event.post(pygame.event.Event(pygame.KEYDOWN, key=key, mod=0, unicode=""))
        driver.seconds(0.05)
    pygame.event.post(pygame.event.Event(pygame.KEYUP, key=key, mod=0))
    driver.frames(1)


def row(driver: Driver) -> int:
    world = driver.game.session.run.world
    return world.road.cell(world.av)[1]


def test_an_arrow_held_down_drives_on_while_the_clock_stands_and_while_it_runs(window: Open) -> None:
    driver = window(config=EMPTY)
    driver.letter("p")
    driver.letter("m")
    assert driver.game.session.run.mode is Mode.MANUAL
    first = row(driver)
    hold(driver, pygame.K_UP, 1.0)
    stood = row(driver)
    assert 4 <= first - stood <= 7, "about five moves a second"
    driver.letter("p")
    hold(driver, pygame.K_UP, 2.0)
    assert 3 <= stood - row(driver) <= 5, "a move for each tick"
    assert len(driver.game.session.run.queue) <= 1, "no moves pile up"


def test_an_arrow_held_down_steps_on_and_back(window: Open) -> None:
    driver = window(config=EMPTY)
    driver.letter("p")
    first = driver.game.session.timeline.tick
    hold(driver, pygame.K_RIGHT, 1.0)
    assert driver.game.session.timeline.tick >= first + 4


def test_the_log_has_the_decisions_between_what_happened(window: Open) -> None:
    driver = window(config=EMPTY)
    driver.seconds(2.1)
    driver.say("add five potholes")
    driver.seconds(1.1)
    lines = driver.game.decisions.among(driver.game.session.log.latest(100))
    told = [line for line in lines if isinstance(line, DecisionLine)]
    assert told[0].text
    assert told[0].last > told[0].first, "ticks that say the same share a line"
    kinds = [isinstance(line, DecisionLine) for line in lines]
    said = next(at for at, line in enumerate(lines) if "potholes" in line.text)
    assert any(kinds[:said]), "before what was said"
    assert any(kinds[said:]), "and after it"
    tick = driver.game.session.timeline.tick
    driver.letter("p")
    driver.say("rewind three ticks")
    left = [line for line in driver.game.decisions.among([]) if isinstance(line, DecisionLine)]
    assert all(line.last < tick for line in left)


def test_the_log_tells_a_crash_after_the_decision_that_led_to_it(window: Open) -> None:
    driver = window(config=CARELESS)
    while driver.game.session.run.world.outcome is Outcome.RUNNING:
        driver.seconds(0.25)
    driver.seconds(0.3)
    lines = driver.game.decisions.among(driver.game.session.log.latest(100))
    ticks = [line.last if isinstance(line, DecisionLine) else line.tick for line in lines]
    assert ticks == sorted(ticks)
    assert lines[-1].type == "crashed"
