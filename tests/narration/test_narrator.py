"""What is said holds to the facts and reads like sentences."""

from __future__ import annotations

from collections import Counter

import pytest

from service.actions import Ask
from service.actions.questions import WHATS
from service.narration import Narrator
from service.sessions.facts import Asked
from sim.actions import (
    Add,
    Adjust,
    Copy,
    Drive,
    MoveThings,
    OneThing,
    Prefer,
    Remove,
    Replace,
    Reset,
    Scenario,
    SetCount,
    SetMode,
    Shift,
    Swap,
    Where,
    WorldAction,
)
from sim.config import Config
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.transition import step
from sim.types import Mode, Move, Outcome
from tests.support.moments import moments
from tests.support.narration_checks import ids_in, looks_like_sentences
from tests.support.roads import road, run_on

NARRATOR = Narrator.load()


def answer(timeline: Timeline, **ask: object) -> dict[str, object]:
    return NARRATOR.answer(Asked(Ask(**ask), timeline))  # type: ignore[arg-type]


def replied(run: SimState, action: WorldAction) -> str:
    timeline = Timeline(run.config)
    timeline.state = run
    return NARRATOR.reply(tuple(timeline.apply(1, [action])))


def test_answers_name_only_what_is_in_their_facts() -> None:
    for timeline in moments(150, seed=4):
        for ask in (Ask(about="why"), *(Ask(about="why_not", move=move) for move in Move)):
            told = NARRATOR.answer(Asked(ask, timeline))
            text = told.pop("text")
            assert looks_like_sentences(text), text
            assert ids_in(text) <= ids_in(told)


def test_wishes_of_one_utterance_are_told_once() -> None:
    timeline = Timeline(Config(seed=1, planner="astar"))
    wishes = [Prefer(preference="avoid_potholes"), Prefer(preference="smooth_ride")]
    told = NARRATOR.reply(tuple(timeline.apply(1, wishes)))
    assert told == "From now on I keep away from potholes and drive smoothly."


def test_a_why_names_its_causes_and_the_flip() -> None:
    timeline = Timeline(run_on(road("........", "........", "...o....", "...A....")).config)
    timeline.state = run_on(road("........", "........", "...o....", "...A...."))
    timeline.advance()
    told = answer(timeline, about="why")
    assert told["text"] == (
        "Just now I moved left rather than going forward, because there was a pothole in the cell ahead. "
        "Without it I would go forward."
    )
    assert told["counterfactual"] == {
        "at_tick": 0,
        "change": [{"do": "remove", "kind": "pothole", "count": 1, "where": {"id": "pothole-1"}}],
        "decision": "forward",
    }
    assert told["verified"] == {"necessary": True, "sufficient": True, "minimal": True}


@pytest.mark.parametrize(
    ("ask", "words"),
    [
        ({"about": "why", "tick": 999}, "There is no tick 999 yet: this is tick 3."),
        ({"about": "why", "tick": 3}, "The decision of tick 3 is still to come"),
        ({"about": "why", "move": Move.STAY}, "In my last 3 moves I did not stay."),
        ({"about": "why_not", "move": Move.FORWARD}, "But that is what I did: I went forward."),
        ({"about": "status"}, "I am in lane 5, 26 rows (130 m) from the goal."),
    ],
)
def test_questions_about_what_is_not_so_are_answered_exactly(ask: dict[str, object], words: str) -> None:
    timeline = Timeline(Config(vehicles=0, potholes=0))
    for _ in range(3):
        timeline.advance()
    assert words in str(answer(timeline, **ask)["text"])


@pytest.mark.parametrize(
    ("rows", "told"),
    [
        (("....", ".A..", "....", "...."), "This drive has ended (arrived): I am at the goal, in lane 2"),
        (
            ("....", "####", ".A..", "...."),
            "This drive has ended (stuck) in lane 2, 2 rows (10 m) from the goal",
        ),
    ],
)
def test_an_ended_drive_tells_where_it_ended(rows: tuple[str, ...], told: str) -> None:
    timeline = Timeline(run_on(road(*rows)).config)
    timeline.state = run_on(road(*rows))
    while timeline.state.world.outcome is Outcome.RUNNING:
        timeline.advance()
    assert answer(timeline, about="status")["text"] == f"{told}."


OPEN = run_on(road("........", "...o....", "......>.", ".o......", "...A...."))


@pytest.mark.parametrize(
    ("action", "words"),
    [
        (Add(kind="pothole", count=5), "Added 5 potholes; there are 7 potholes now."),
        (
            Add(kind="barrier", count=1, where=Where(cell=(0, 2))),
            "Added a barrier in lane 1, 10 m ahead; there is 1 barrier now.",
        ),
        (Remove(kind="pothole", count="all"), "Removed 2 potholes; no potholes are left."),
        (Remove(kind="barrier", count="all"), "There were no barriers to remove."),
        (SetCount(kind="pothole", count=1), "There is exactly 1 pothole now; there were 2."),
        (SetCount(kind="vehicle", count=1), "There is 1 car already."),
        (
            MoveThings(kind="vehicle", count=1, by=Shift(side="left", cells=2)),
            "Moved a car from lane 7 to lane 5, 10 m ahead.",
        ),
        (MoveThings(kind="pothole", count="all", to=Where(lane=1)), "Moved 2 potholes to lane 1."),
        (
            MoveThings(kind="pothole", count=1, to=Where(lane=2)),
            "Nothing had to move: everything is there already.",
        ),
        (
            Swap(first=OneThing(kind="vehicle"), second=OneThing(kind="pothole")),
            "Swapped: the car is in lane 2, 5 m ahead now, the pothole in lane 7, 10 m ahead.",
        ),
        (
            Replace(kind="pothole", count="all", by="barrier"),
            "2 potholes became barriers; there are 2 barriers now.",
        ),
        (
            Replace(kind="vehicle", count=1, by="barrier"),
            "Where a car was there is a barrier; there is 1 barrier now.",
        ),
        (
            Copy(kind="vehicle", count=1, to=Where(lane=1)),
            "Added a car in lane 1, 10 m ahead, a copy; there are 2 cars now.",
        ),
        (
            Adjust(parameter="columns", by=2),
            "The number of lanes: 8 → 10. What is on the road stays where it is.",
        ),
        (
            Scenario(road="highway", potholes=2, vehicles=0),
            "A new highway: 2 potholes. The planner: Priority rules → Rules.",
        ),
        (Scenario(potholes=0, vehicles=0, planner="priority"), "A new road with nothing on it."),
        (
            Scenario(layout="crossing", potholes=2, vehicles=0, planner="priority"),
            "A new road: crossing traffic, 2 potholes.",
        ),
        (
            Scenario(
                layout="crossing",
                road="city",
                pedestrians=0,
                barriers=0,
                potholes=0,
                vehicles=0,
                planner="priority",
            ),
            "A new city road: crossing traffic.",
        ),
        (Reset(), "Back at the start of this road."),
        (SetMode(mode=Mode.AUTO), "That is how it is already."),
        (Drive(move=Move.LEFT), "Next I move left, then I drive on by myself."),
    ],
)
def test_a_reply_says_what_was_done(action: WorldAction, words: str) -> None:
    assert replied(OPEN, action) == words


def test_every_decision_and_event_reads_like_a_sentence() -> None:
    run = SimState.start(Config(seed=9, potholes=30, pedestrians=3))
    for _ in range(600):
        moved = step(run)
        if moved.decision is not None:
            assert looks_like_sentences(NARRATOR.decision(moved.decision, run))
        for event in moved.events:
            assert looks_like_sentences(NARRATOR.event(event, moved.state)), event
        run = moved.state


def test_things_taken_away_one_after_another_are_told_at_once() -> None:
    timeline = Timeline(Config(seed=4, barriers=3))
    ids = [name for name in timeline.state.world.hazards.values() if name.startswith("barrier-")]
    removals = [Remove(kind="barrier", count=1, where=Where(id=name)) for name in ids]
    assert NARRATOR.reply(tuple(timeline.apply(1, removals))) == "Removed 3 barriers; no barriers are left."


def test_what_is_asked_has_a_name_of_its_own_as_answerers_are_found_by_it() -> None:
    names = Counter(what for about in WHATS for what in WHATS[about])
    assert {what for what, count in names.items() if count > 1} == {
        "detour",
        "other_side",
    }  # answered by its kind of question
