"""The moves that were made: a past state is what it was, and nothing is decided for it again."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sim.actions import Drive, Prefer, SetMode
from sim.config import Config
from sim.forecast import Forecast, StepVerdict
from sim.perceive import Percept
from sim.plan import Decision
from sim.plan.decision import Option
from sim.plan.safe_planning import hold_position, plan_safely
from sim.session.move_log import BLOCK, MoveLog
from sim.session.timeline import Timeline
from sim.state import FIRST
from sim.transition import step, transition
from sim.types import Mode, Move, Outcome

DECISION = Decision(0, "av-1", "priority", Move.LEFT, (Option(Move.LEFT, (0, 0), StepVerdict.FREE, 0.0, ()),))


def noted(ticks: int) -> MoveLog:
    track = MoveLog()
    for _ in range(ticks):
        track.note(DECISION)
    return track


@pytest.mark.parametrize("planner", ["rules", "priority", "astar", "bfs", "dijkstra"])
def test_a_state_is_come_to_by_the_move_as_by_the_decision(
    planner: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also where a person drives, a move is held back, an episode ends, and a planner fails."""

    def failing_at_times(percept: Percept, config: Config) -> tuple[Forecast, Decision]:
        forecast, decision = plan_safely(percept, config)
        if percept.tick % 7 == 3:
            decision = hold_position(percept, config, "broke")
        return forecast, decision

    monkeypatch.setattr("sim.decide.plan_safely", failing_at_times)
    timeline = Timeline(
        Config(columns=5, rows=8, potholes=5, vehicles=8, seed=3, planner=planner, courtesy=0.3)
    )
    seen, faults, by_person = [], 0, 0
    for number in range(1, 120):
        if number % 9 == 0:
            timeline.apply(number, [Drive(move=tuple(Move)[number % 6])])
        if number % 31 == 0:
            timeline.apply(number, [SetMode(mode=Mode.MANUAL if number % 2 else Mode.AUTO)])
        state = timeline.state
        seen.append(state)
        tick = timeline.advance()
        if (decision := tick.decision) is None:
            continue
        faults += decision.fault is not None
        by_person += decision.asked is not None
        again = transition(
            state,
            {FIRST: decision.move},
            by_person=() if decision.asked is None else (FIRST,),
            faults={} if decision.fault is None else {FIRST: decision.fault},
        ).state
        assert again == tick.state == step(state).state
    assert {state.world.outcome for state in seen} > {Outcome.RUNNING}
    assert faults
    assert by_person
    assert [*timeline.between(0, timeline.tick)] == seen
    twin = timeline.copy()
    twin.rewind(50)
    assert twin.state == seen[50]


def test_nothing_is_decided_again(monkeypatch: pytest.MonkeyPatch) -> None:
    timeline = Timeline(Config(seed=3, planner="astar", potholes=3))
    timeline.apply(1, [Prefer(preference="cautious")])
    seen = []
    for _ in range(100):
        seen.append(timeline.state)
        timeline.advance()

    def refused(*_: object) -> None:
        raise AssertionError("while a result stands there is nothing to decide, and all else is known")

    monkeypatch.setattr("sim.transition.decide_alone", refused)
    assert [timeline.at(tick) for tick in range(100)] == seen
    timeline.rewind(37)
    assert timeline.state == seen[37]


def test_a_copy_goes_its_own_way() -> None:
    track = noted(BLOCK + 3)
    twin = track.copy()
    twin.cut(BLOCK - 1)
    track.note(None)
    assert (len(track), len(twin)) == (BLOCK + 4, BLOCK - 1)
    twin.note(DECISION)
    assert twin.blocks == track.blocks[:1]


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 3 * BLOCK), st.integers(0, 3 * BLOCK))
def test_it_is_its_blocks(ticks: int, kept: int) -> None:
    track = noted(ticks)
    assert MoveLog(track.blocks).blocks == track.blocks
    track.cut(kept)
    assert len(track) == min(ticks, kept)
    assert track.blocks == noted(len(track)).blocks


def test_blocks_that_are_nobodys_are_refused() -> None:
    with pytest.raises(ValueError, match="last"):
        MoveLog([b"a", b"a" * BLOCK])
    timeline = Timeline(Config())
    timeline.advance()
    *parts, _ = timeline.parts()
    with pytest.raises(ValueError, match="0 moves lead to tick 1"):
        Timeline.made(*parts, moves=())
