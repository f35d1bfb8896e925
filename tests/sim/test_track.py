"""The moves that were made: a past state is what it was, and nothing is decided for it again."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sim.actions import Drive, Prefer, SetMode
from sim.config import Config
from sim.forecast import Verdict
from sim.kinds import Mode, Move, Outcome
from sim.perceive import Percept
from sim.plan import Decision
from sim.plan.decision import Option
from sim.plan.guard import planned, stayed
from sim.run import Run, advance, repeated
from sim.timeline import Timeline
from sim.track import BLOCK, Track

DECISION = Decision(0, "av-1", "priority", Move.LEFT, (Option(Move.LEFT, (0, 0), Verdict.FREE, 0.0, ()),))


def noted(ticks: int) -> Track:
    track = Track()
    for _ in range(ticks):
        track.note(DECISION)
    return track


@pytest.mark.parametrize("planner", ["rules", "priority", "astar", "exact", "dijkstra"])
def test_a_state_is_come_to_by_the_move_as_by_the_decision(
    planner: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also where a person drives, a move is held back, an episode ends, and a planner fails."""

    def failing_at_times(percept: Percept, config: Config) -> Decision:
        return stayed(percept, config, "broke") if percept.tick % 7 == 3 else planned(percept, config)

    monkeypatch.setattr("sim.run.planned", failing_at_times)
    timeline = Timeline(
        Config(columns=5, rows=8, potholes=5, vehicles=8, seed=3, planner=planner, courtesy=0.3)
    )
    seen, faults, by_person = [], 0, 0
    for number in range(1, 120):
        if number % 9 == 0:
            timeline.apply(number, [Drive(move=tuple(Move)[number % 6])])
        if number % 31 == 0:
            timeline.apply(number, [SetMode(mode=Mode.MANUAL if number % 2 else Mode.AUTO)])
        run = timeline.run
        seen.append(run)
        tick = timeline.advance()
        if (decision := tick.decision) is None:
            continue
        faults += decision.fault is not None
        by_person += decision.asked is not None
        again = repeated(run, decision.move, by_person=decision.asked is not None, fault=decision.fault)
        assert again == tick.run == advance(run).run
    assert {run.world.outcome for run in seen} > {Outcome.RUNNING}
    assert faults
    assert by_person
    assert [*timeline.between(0, timeline.tick)] == seen
    twin = timeline.copy()
    twin.rewind(50)
    assert twin.run == seen[50]


def test_nothing_is_decided_again(monkeypatch: pytest.MonkeyPatch) -> None:
    timeline = Timeline(Config(seed=3, planner="astar", potholes=3))
    timeline.apply(1, [Prefer(preference="cautious")])
    seen = []
    for _ in range(100):
        seen.append(timeline.run)
        timeline.advance()

    def standing_only(run: Run) -> None:
        assert run.world.outcome is not Outcome.RUNNING, "while a result stands there is nothing to decide"

    monkeypatch.setattr("sim.run.decide", standing_only)
    assert [timeline.at(tick) for tick in range(100)] == seen
    timeline.rewind(37)
    assert timeline.run == seen[37]


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
    assert Track(track.blocks).blocks == track.blocks
    track.cut(kept)
    assert len(track) == min(ticks, kept)
    assert track.blocks == noted(len(track)).blocks


def test_blocks_that_are_nobodys_are_refused() -> None:
    with pytest.raises(ValueError, match="last"):
        Track([b"a", b"a" * BLOCK])
    timeline = Timeline(Config())
    timeline.advance()
    *parts, _ = timeline.parts()
    with pytest.raises(ValueError, match="0 moves lead to tick 1"):
        Timeline.made(*parts, moves=())
