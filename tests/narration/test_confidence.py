"""How sure, said: never more than is known. How worn: never more than is counted."""

from __future__ import annotations

import random
import re
from typing import Any

import pytest

from service.actions import Ask
from service.narration.confidence import Confidences
from service.narration.maintenance import SERVICE_INTERVAL_M, Maintenance
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim import planner_names
from sim.config import Config
from sim.explain.confidence import Confidence, Method
from sim.metrics import Metrics
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Mode, Outcome
from tests.support.narration_checks import ID, looks_like_sentences
from tests.support.roads import road, run_on
from tests.support.sensors import Missing, registered
from tools.confidence_calibration import drawn_config

SAYINGS = Sayings.load()
SURE = Confidences(SAYINGS)
OPEN = run_on(road("........", "........", "........", "...A...."))


def answer(run: SimState) -> dict[str, Any]:
    timeline = Timeline(run.config)
    timeline.state = run
    return SURE.answer(Asked(Ask(about="confidence"), timeline))


def found(**parts: Any) -> Confidence:
    known = {
        "tick": 0, "method": Method.SAMPLED, "arrives": 0.5, "low": 0.43, "high": 0.57, "crashes": 0.5,
        "stuck": 0.0, "shut_off": 0.0, "arrival_ticks": (12, 20), "end_ticks": (3, 20), "futures": 200,
        "decisions": 600, "chance": True, "by_hand": False, "clarity": None,
    }  # fmt: skip
    return Confidence(**known | parts)


@pytest.mark.parametrize(
    ("run", "text"),
    [
        (OPEN, "I am sure: I see everything, and nothing is left to chance. Run on, I arrive in 1.5 s."),
        (
            OPEN.with_ego(mode=Mode.MANUAL),
            "You are driving, so it is up to you. Suppose I take over now. I am sure: "
            "I see everything, and nothing is left to chance. Run on, I arrive in 1.5 s.",
        ),
        (
            run_on(OPEN.world, courtesy=0.5),
            "I am sure: how others react is left to chance, but makes no difference to me. "
            "Run on, I arrive in 1.5 s.",
        ),
        (
            run_on(road("........", "########", "........", "...A...."), repetition=False),
            "I will not arrive, and I am sure of that: no way leads to the goal any more, "
            "however others react.",
        ),
        (
            run_on(road("........", "########", "........", "...A....")),
            "I will not arrive, and I am sure of that: run on, the same situation comes again in 3 s, "
            "and would for ever.",
        ),
    ],
)
def test_what_is_sure_is_said_to_be(run: SimState, text: str) -> None:
    assert answer(run)["text"] == text


@pytest.mark.parametrize(
    ("parts", "beginning"),
    [
        ({}, "I am about 50 % sure that I arrive (43 to 57 %): "),
        (
            {"arrives": 1.0, "low": 0.987, "high": 1.0, "crashes": 0.0},
            "I am at least 98 % sure that I arrive: ",
        ),
        ({"arrives": 0.0, "low": 0.0, "high": 0.012}, "I am at most 2 % sure that I arrive: "),
        (
            {"arrives": 0.995, "low": 0.972, "high": 0.999},
            "I am about 99 % sure that I arrive (97 to more than 99 %): ",
        ),
        ({"arrives": 0.0, "low": 0.0, "high": 0.79, "futures": 1}, "I did not arrive in the one future "),
        (
            {"method": Method.ALL_FUTURES, "arrives": 0.9996, "crashes": 0.0004},
            "I am more than 99 % sure that I arrive: ",
        ),
        ({"method": Method.ALL_FUTURES, "arrives": 1.0, "crashes": 0.0}, "I am sure: I ran every way "),
    ],
)
def test_no_more_is_stated_than_is_known(parts: dict[str, Any], beginning: str) -> None:
    text = SURE.text(found(**parts), OPEN)
    assert text.startswith(beginning), text
    assert looks_like_sentences(text)
    assert "100 %" not in text


def test_nobody_claims_to_see_everything_who_may_not() -> None:
    with registered(Missing(frozenset())):
        told = answer(run_on(OPEN.world, sensor="missing"))["text"]
    assert told.startswith("I am sure: nothing is left to chance, and whatever my sensor misses")
    assert "see everything" not in told
    assert looks_like_sentences(told)


def test_how_it_ends_otherwise_is_told() -> None:
    exact = {"method": Method.ALL_FUTURES, "futures": None}
    assert SURE.text(found(**exact), OPEN).endswith(", and in the rest I crash.")
    both = found(**exact, arrives=0.0, crashes=0.25, stuck=0.75, arrival_ticks=None)
    assert SURE.text(both, OPEN).endswith(", and in 25 % I crash and in 75 % I get stuck.")


def test_every_answer_reads_like_sentences_and_has_its_figures() -> None:
    draw = random.Random(12)
    for _ in range(40):
        config = drawn_config(draw)
        if config.rows > 8:
            continue
        timeline = Timeline(config)
        for _ in range(draw.randrange(30)):
            timeline.advance()
        told = SURE.answer(Asked(Ask(about="confidence"), timeline))
        assert looks_like_sentences(told["text"]), told["text"]
        assert not ID.search(told["text"])
        ended = timeline.state.world.outcome is not Outcome.RUNNING
        assert ("confidence" in told) != ended
        if not ended:
            assert sum(told["ends"].values()) == pytest.approx(1.0)
            low, high = told["interval"]
            assert low <= told["confidence"] <= high


def test_a_planner_that_fails_leaves_nothing_to_be_sure_of(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(planner_names, "known", lambda _: True)  # as one that is no longer installed was
    run = run_on(OPEN.world, planner="gone")
    assert answer(run)["text"] == "I cannot tell how it ends: the planner gone is not installed."


def worn(metrics: Metrics) -> dict[str, Any]:
    timeline = Timeline(Config())
    timeline.state = timeline.state.with_ego(metrics=metrics)
    return Maintenance(SAYINGS).answer(Asked(Ask(about="maintenance"), timeline))


def test_wear_is_answered_from_what_is_counted_alone() -> None:
    told = worn(Metrics(distance_m=1240.0, crashes=2))
    assert told["wear"] is told["potholes_hit"] is None
    assert told["service_in_m"] == SERVICE_INTERVAL_M - 1240.0
    assert told["text"] == (
        "Wear is not measured here, neither of the suspension nor of the tyres. What is "
        "counted: 1.2 km driven, "
        "and 2 crashes; which of them were into potholes is not kept. "
        "By distance alone, with a service every 15,000 km, the next is in 14,998.8 km."
    )


def test_without_a_crash_no_pothole_was_hit() -> None:
    told = worn(Metrics())
    assert (told["potholes_hit"], told["distance_m"]) == (0, 0.0)
    assert "0 m driven, and no crash, so no pothole hit either." in told["text"]
    assert not re.search(r"\d+ %", told["text"])
