"""Advice is said in sentences that hold to its figures, and never with more certainty than there is."""

from __future__ import annotations

import re

import pytest

from service.narration.advice import Advices
from service.narration.sayings import Sayings
from service.sessions.facts import Advised
from sim.hazard_advice import advise
from sim.hazard_advice.parameters import FRICTION
from sim.types import Kind
from tools.advice_calibration import questions

ADVICES = Advices(Sayings.load())
NUMBER = re.compile(r"\d+(?:\.\d+)?")


def said(hazard: str, distance_m: float, speed_kmh: float, weather: str = "clear") -> str:
    return ADVICES.text(advise(Kind(hazard), distance_m, speed_kmh, weather))  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("asked", "text"),
    [
        (
            ("pothole", 2, 40),
            "Brake hard, late as it is: at 40 km/h the pothole is 0.18 s away, and a driver takes 1 s to "
            "react. Half of all drivers need more than 20 m to stop, or 17 m to steer clear, and you have "
            "2 m. "
            "It ends well in 19 of 100 cases.",
        ),
        (
            ("pothole", 10, 15),
            "Keep going: at 15 km/h a pothole is not likely to harm a car. "
            "I am more than 99 % sure that this ends well.",
        ),
        (
            ("pedestrian", 40, 50),
            "Brake and steer round the pedestrian, if there is room: at 50 km/h that takes 24 m, and you "
            "have 40 m. Braking alone, half of all drivers stop within 28 m, which is less sure. "
            "I am 96 % sure that this ends well, as long as the pedestrian stays put. "
            "Of people who are hit all the same, about 5 in 100 die of it.",
        ),
        (
            ("barrier", 60, 50),
            "Brake: at 50 km/h 95 of 100 drivers stop within 42 m, and the barrier is 60 m away. "
            "I am more than 99 % sure that this ends well.",
        ),
        (
            ("vehicle", 60, 80, "rain"),
            "Brake and steer round the vehicle, if there is room: at 80 km/h on a wet road that takes 45 m, "
            "and you have 60 m. Braking alone, you still do about 33 km/h when you get there. "
            "I am 85 % sure that this ends well, as long as the vehicle stays put.",
        ),
        (
            ("barrier", 12, 60),
            "Brake hard, late as it is: at 60 km/h the barrier is 0.72 s away, and a driver takes 1 s to "
            "react. Half of all drivers need more than 37 m to stop, or 31 m to steer clear, and you have "
            "12 m. "
            "It ends well in fewer than 1 of 100 cases.",
        ),
    ],
)
def test_advice_as_it_is_said(asked: tuple[str, float, float], text: str) -> None:
    assert said(*asked) == text


def test_every_advice_reads_like_sentences() -> None:
    for advice in questions(1500, seed=21):
        text = ADVICES.text(advice)
        assert re.fullmatch(r"[A-Z][^{}]*\.", text), text
        assert not re.search(r"  |\.\.|None|nan|inf|e[+-]\d|100 %| 0 (m|km/h|s)\b", text), text
        assert re.fullmatch(r"What is to be done about an? .* ahead, at .*\?", ADVICES.question(advice))
        # What is needed and what there is are told apart wherever they differ by a tenth.
        if abs(advice.figures.stopping_m - advice.distance_m) > 0.1:
            assert not re.search(r"you need ([\d.]+ m) to stop and have \1\b", text), text


def test_the_certainty_that_is_said_is_the_confidence() -> None:
    for advice in questions(500, seed=22):
        text = ADVICES.text(advice)
        percent = 100 * advice.confidence
        if "more than 99 %" in text:
            assert percent >= 99.5
        elif "fewer than 1 of" in text:
            assert percent <= 0.5
        else:
            stated = re.search(r"(\d+) (?:% sure|of 100 cases)", text)
            assert stated is not None
            assert abs(int(stated[1]) - percent) <= 0.5


def test_numbers_said_are_among_the_facts() -> None:
    for advice in questions(500, seed=23):
        told = ADVICES.answer(Advised(advice, 3))
        facts = [advice.distance_m, advice.speed_kmh, 100, 99, 95, 1, 100 * advice.confidence]
        facts += [*told["physics"].values(), *(option["meets_kmh"] for option in told["options"])]
        facts += [option["needs_m"] for option in told["options"]]
        facts += [100 * advice.chosen.death / max(1e-9, 1 - advice.chosen.chance)]
        for number in map(float, NUMBER.findall(told["text"])):
            # as precisely as it was said: to half a unit, or a tenth below ten
            close = 0.51 if number >= 10 or number == 1 else 0.051
            assert any(abs(number - fact) <= close or round(fact) == number for fact in facts), (
                number,
                told["text"],
            )


@pytest.mark.parametrize("weather", FRICTION)
@pytest.mark.parametrize("hazard", Kind)
def test_every_hazard_and_weather_has_words(hazard: Kind, weather: str) -> None:
    told = ADVICES.answer(Advised(advise(hazard, 30, 50, weather)))  # type: ignore[arg-type]
    assert (told["about"], told["hazard"], told["weather"]) == ("advice", hazard, weather)
    assert told["text"]
