"""Words that decide what a sentence means are used by what it does, or it is refused or asked about."""

from __future__ import annotations

import pytest

from service.actions import dump
from service.grammar import Language, Understood
from tests.grammar.beside import meaning


@pytest.mark.parametrize(
    "text",
    [
        "instead of switch to automatic mode",
        "rather than make it night",
        "instead of save this run as monday demo",
        "run under 100 episodes with DWA in the rain",
        "compare A* and DWA over all but 50 runs",
        "add over five rows",
        "advance time to 3 ticks",
        "use the default planner as much as before",
        "evaluate A* versus the rule planner over and over",
        "test the A* planner for a while",
        "duplicate half all potholes",
        "cruise at 50 km/h less",
        "lower twice the step length",
        "lower the safety buffer by minus two",
        "make the playback two times slower",
        "turn left, not then go straight",
        "stop, not stop",
        "pause or then drop a barrier",
        "add a pothole at lane 2 of row 9 but not in lane 2",
        "add a cone in the middle lane but not in lane 2",
        "don't add cars and make it rain",
        "simulate a city without narrow streets and 2 potholes",
        "do I have to let the simulation run faster",
        "why will you move to the left",
        "rewind to the next crash",
        "patch up the cars",
        "playback too fast",
        "add three cones less",
        "half a lane more",
        "at 40 pothole 2 m ahead, what do I do",
    ],
)
def test_a_word_that_nothing_uses_keeps_the_sentence_from_acting(language: Language, text: str) -> None:
    assert not isinstance(language.parse(text), Understood)


@pytest.mark.parametrize(
    ("text", "actions"),
    [
        ("go five steps", [{"do": "step", "ticks": 5}]),
        ("go five steps back", [{"do": "rewind", "ticks": 5}]),
        ("evaluate A* over 100 runs", [{"do": "evaluate", "runs": 100, "planners": ["astar"]}]),
        ("instead of A* use Dijkstra", [{"do": "set", "parameter": "planner", "value": "dijkstra"}]),
        ("instead of adding a cone, add a bus", [{"do": "add", "kind": "vehicle", "count": 1}]),
        (
            "add a cone in the left lane but not in lane 2",
            [{"do": "add", "kind": "barrier", "count": 1, "where": {"lane": "left"}}],
        ),
        ("less sensor noise", [{"do": "adjust", "parameter": "sensor_noise", "direction": "down"}]),
        (
            "slow the playback down, not the car",
            [{"do": "adjust", "parameter": "playback_speed", "direction": "down"}],
        ),
        ("fill in the potholes", [{"do": "remove", "kind": "pothole", "count": "all"}]),
    ],
)
def test_the_same_words_in_their_place_are_used(
    language: Language, text: str, actions: list[dict[str, object]]
) -> None:
    assert meaning(language, text) == actions


def test_a_particle_is_no_amount_of_change() -> None:
    german = Language.load("de")
    assert not isinstance(german.parse("stelle den Sicherheitspuffer um drei"), Understood)
    set_to = german.parse("stelle den Sicherheitspuffer auf drei")
    assert isinstance(set_to, Understood)
    assert dump(set_to.actions) == [{"do": "set", "parameter": "safety_buffer", "value": 3}]
