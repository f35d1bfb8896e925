"""What is supposed of a drive: no stop, the other side, other numbers of things; each is a plain question."""

from __future__ import annotations

from typing import Any

import pytest

from service.actions import Ask
from service.narration import Narrator
from service.narration.supposed_ends import ARRIVES, FAILS
from service.sessions.facts import Asked
from service.sessions.permission import ANSWERED, PERMISSION, as_it_stands
from service.sessions.referred import explained
from service.sessions.utterance import Utterance
from sim.actions import SetCount, SetMode
from sim.config import Config
from sim.explain import QuestionError
from sim.explain.query import latest_detour
from sim.session.timeline import Timeline
from sim.types import Kind, Mode, Move, Outcome
from tests.support.narration_checks import looks_like_sentences

NARRATORS = {"en": Narrator.load(), "de": Narrator.load().in_language("de")}
OTHER = {
    Move.LEFT: Move.RIGHT,
    Move.RIGHT: Move.LEFT,
    Move.FORWARD_LEFT: Move.FORWARD_RIGHT,
    Move.FORWARD_RIGHT: Move.FORWARD_LEFT,
}


def driven(seed: int, ticks: int) -> Timeline:
    timeline = Timeline(Config(seed=seed, columns=6, rows=16, potholes=8, vehicles=14, planner="priority"))
    for _ in range(ticks):
        if timeline.state.world.outcome is not Outcome.RUNNING:
            break
        timeline.advance()
    return timeline


def answer(timeline: Timeline, code: str = "en", supposes: str | None = None, **ask: Any) -> dict[str, Any]:
    return NARRATORS[code].answer(Asked(Ask(**ask), timeline, supposes))


def test_no_stop_is_forward_at_the_first_tick_of_the_latest_stop() -> None:
    stopped = 0
    for seed in range(30):
        timeline = driven(seed, 12)
        made = [timeline.decided(state) for state in timeline.between(0, timeline.tick)]
        stops = [each.tick for each in made if each is not None and each.move is Move.STAY]
        told = answer(timeline, about="what_if", what="unstopped")
        if not stops:
            assert "have not stopped" in told["text"]
            continue
        first = stops[-1]
        while first - 1 in stops:
            first -= 1
        stopped += 1
        assert told["text"] == answer(timeline, about="what_if", move=Move.FORWARD, tick=first)["text"]
    assert stopped > 3


def test_the_other_side_is_that_of_the_latest_move_to_a_side() -> None:
    swerved = 0
    for seed in range(20):
        timeline = driven(seed, 10)
        told = answer(timeline, about="what_if", what="other_side")
        try:
            found = latest_detour(timeline)
        except QuestionError:
            assert "stayed in my lane" in told["text"]
            continue
        other = OTHER[found.move]
        swerved += 1
        assert told["text"] == answer(timeline, about="what_if", move=other, tick=found.tick)["text"]
        why = answer(timeline, about="why", what="other_side")["text"]
        assert why == answer(timeline, about="why", move=found.move, instead=other)["text"]
    assert swerved > 5


@pytest.mark.parametrize(("what", "count"), [("halved", 7), ("doubled", 28)])
def test_half_and_twice_as_many_are_exactly_so_many(what: str, count: int) -> None:
    for seed in range(6):
        timeline = driven(seed, (4, 90)[seed % 2])
        for supposes in (None, FAILS, ARRIVES):
            told = answer(timeline, "en", supposes, about="what_if", what=what, kind="vehicle")
            change = (SetCount(kind=Kind.VEHICLE, count=count),)
            assert told["text"] == answer(timeline, "en", supposes, about="what_if", change=change)["text"]


@pytest.mark.parametrize("code", NARRATORS)
def test_every_answer_is_in_sentences_and_can_be_asked_on(code: str) -> None:
    for seed in range(6):
        timeline = driven(seed, (9, 90)[seed % 2])
        for about, what, more in (
            ("what_if", "unstopped", {}),
            ("what_if", "other_side", {}),
            ("why", "other_side", {}),
            ("what_if", "halved", {"kind": "vehicle"}),
            ("what_if", "doubled", {"kind": "pothole"}),
            ("what_if", "other_seeds", {}),
            ("what_if", "sooner_stop", {}),
        ):
            told = answer(timeline, code, about=about, what=what, **more)
            assert looks_like_sentences(told["text"]), told["text"]
            assert told["question"]
            explained(told, (Ask(about=about, what=what, **more),))


def test_leave_to_drive_is_a_request_while_a_drive_goes_on_and_a_question_after_it() -> None:
    manual = SetMode(mode=Mode.MANUAL)
    may = Utterance(actions=(manual, manual), supposes=(PERMISSION, None))
    goes_on, over = driven(1, 3), driven(1, 500)
    assert over.state.world.outcome is not Outcome.RUNNING
    assert as_it_stands(may, goes_on) == may
    assert as_it_stands(may, over).actions == (ANSWERED,)
    wanted = Utterance(actions=(manual,))
    assert as_it_stands(wanted, over) == wanted
