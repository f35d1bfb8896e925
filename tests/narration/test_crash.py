"""Why there was a crash, in words that hold to the facts."""

from __future__ import annotations

import pytest

from service.actions import Ask
from service.narration import Narrator
from service.sessions.facts import Asked
from sim.actions import Add, SetMode, Where
from sim.config import Config
from sim.session.timeline import Timeline
from sim.types import Mode, Move, Outcome
from tests.support.narration_checks import ids_in, looks_like_sentences

NARRATOR = Narrator.load()


def crashed(seed: int = 11, **config: object) -> Timeline:
    parts = {"planner": "priority", "attentive": 0.0, "collision": "cell", **config}
    timeline = Timeline(Config(seed=seed, potholes=30, vehicles=25).with_parts(**parts))
    while timeline.state.world.outcome is Outcome.RUNNING:
        timeline.advance()
    assert timeline.state.world.outcome is Outcome.CRASH
    return timeline


def answer(timeline: Timeline, supposes: str | None = "crash", **ask: object) -> dict[str, object]:
    return NARRATOR.answer(Asked(Ask(about="why", **ask), timeline, supposes))  # type: ignore[arg-type]


def test_a_crash_is_told_with_what_it_hung_on_and_what_would_have_saved_it() -> None:
    told = answer(crashed())
    assert told["text"] == (
        "I crashed at tick 20: I stayed, and the car on my right came into my cell. "
        "Without the car on my right I would not have crashed then. The same holds for 2 more things. "
        "The last tick with a way to the goal was 17: there I went forward, "
        "and moving diagonally right would have come to it."
    )
    assert told["question"] == "Why did you crash?"
    assert told["about"] == "why"
    assert told["verified"] == {"necessary": True, "sufficient": True, "minimal": True}
    evidence = told["evidence"]
    assert isinstance(evidence, dict)
    assert evidence["crash"]["saving"] == {
        "tick": 17,
        "made": "forward",
        "instead": "forward_right",
        "ticks": 41,
    }
    assert evidence["crash"]["ids"] == ("vehicle-18",)


def test_whatever_the_crash_the_words_are_sentences_about_what_is_in_the_facts() -> None:
    found = 0
    for seed in range(60):
        things = {"potholes": 18, "vehicles": 14, "barriers": 3, "pedestrians": 4}
        config = Config(seed=seed, columns=6, rows=20, planner="priority", attentive=0.0).with_parts(**things)
        timeline = Timeline(config)
        for _ in range(80):
            timeline.advance()
            if timeline.state.world.outcome is Outcome.CRASH:
                break
        if timeline.state.world.outcome is Outcome.CRASH:
            found += 1
            told = answer(timeline, None)
            text = str(told.pop("text"))
            assert looks_like_sentences(text), text
            assert text.startswith("I crashed at tick ")
            assert ids_in(text) == set()
    assert found > 10


def test_what_was_decided_in_the_tick_of_a_crash_is_told_with_the_crash() -> None:
    timeline = crashed()
    assert answer(timeline, None)["text"] == answer(timeline)["text"]
    assert answer(timeline, None, tick=19)["question"] == "Why did you crash at tick 19?"
    assert "crashed" not in str(answer(timeline, None, tick=18)["text"])
    assert "crashed" not in str(answer(timeline, None, move=Move.STAY)["text"])
    for _ in range(10):
        timeline.advance()
    assert str(answer(timeline)["text"]).startswith("I crashed at tick 20")
    assert "crashed" not in str(answer(timeline, None)["text"])


@pytest.mark.parametrize(
    ("ticks", "tick", "text"),
    [
        (3, None, "I have not crashed: no episode has ended yet."),
        (40, None, "I have not crashed: the one episode so far ended otherwise."),
        (100, None, "I have not crashed in any of 3 episodes."),
        (3, 2, "I did not crash at tick 2."),
        (3, 9, "There is no tick 9 yet: this is tick 3."),
    ],
)
def test_that_there_was_no_crash_is_an_answer(ticks: int, tick: int | None, text: str) -> None:
    timeline = Timeline(Config(vehicles=0, potholes=0))
    for _ in range(ticks):
        timeline.advance()
    told = answer(timeline, tick=tick)
    assert told["text"] == text
    assert told["causes"] == []


def test_who_drove_is_told() -> None:
    timeline = Timeline(Config(seed=3, potholes=0, vehicles=0, attentive=0.0))
    timeline.apply(1, [SetMode(mode=Mode.MANUAL)])
    column, row = timeline.state.world.road.cell(timeline.state.world.av)
    timeline.apply(2, [Add(kind="vehicle", count=1, where=Where(cell=(column - 2, row)))])
    while timeline.state.world.outcome is Outcome.RUNNING:
        timeline.advance()
    text = str(answer(timeline)["text"])
    assert "You were driving." in text
    assert "The cell ahead" in text
    assert "Even then a way led to the goal: going forward would have come there" in text
