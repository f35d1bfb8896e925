"""Blame holds to what happened: the last way out is one and the last, and what was expected was expected."""

from __future__ import annotations

from typing import Any

import pytest

from sim.explain import QuestionError
from sim.explain.blame import Entered, Fault, blame, foreseen
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.transition import next_world
from sim.types import Move, Outcome
from tests.sim.explain.test_ahead import moments, some_way


def crashes(count: int, **config: Any) -> list[Timeline]:
    """Sessions that have crashed, on roads where nobody reacts."""
    found = []
    for timeline in moments(10**6, attentive=0.0, planner="priority", vehicles=20, **config):
        while timeline.state.world.outcome is Outcome.RUNNING:
            timeline.advance()
        if timeline.state.world.outcome is Outcome.CRASH:
            found.append(timeline)
        if len(found) == count:
            break
    return found


CRASHES = crashes(12)


def test_the_last_way_out_is_one_and_no_later_one_is_there() -> None:
    faults = set()
    for timeline in CRASHES:
        found = blame(timeline)
        faults.add(found.fault)
        last, end = found.avoidable.last, found.crash.end
        first_lost = timeline.state.world.episode_start if last is None else last.tick + 1
        assert found.avoidable.proved
        for tick in range(first_lost, end):
            assert not some_way(timeline.at(tick), arrive=False)
        if last is not None:
            state = timeline.at(last.tick)
            there = next_world(state.world, (last.instead,), state.config)
            assert there.outcome is not Outcome.CRASH
            assert some_way(SimState(state.config, there), arrive=False)
            decision = timeline.decided(state)
            assert decision is not None
            assert decision.move is last.made
    assert faults <= {Fault.EGO, Fault.SHARED, Fault.OTHER, Fault.NOBODY}


def test_fault_follows_who_moved_and_who_could_have_kept_clear() -> None:
    for timeline in CRASHES:
        found = blame(timeline)
        decision = timeline.decision(timeline.tick - 1)
        assert decision is not None
        assert (found.entered is Entered.OTHER) is (decision.move is Move.STAY)
        could = found.avoidable.last is not None
        if found.entered is Entered.OTHER:
            assert found.fault is (Fault.SHARED if could else Fault.OTHER)
        else:
            assert found.fault is (Fault.EGO if could else Fault.NOBODY)


def test_what_was_seen_coming_was_there_to_be_seen() -> None:
    expected = 0
    for timeline in CRASHES:
        found = foreseen(timeline)
        since = found.expected_since
        assert found.seen_since is not None  # sensors show all here
        if since is None:
            continue
        expected += 1
        # Nobody reacts, so what hits would have come there whatever the ego did meanwhile.
        worlds = [timeline.at(tick).world for tick in range(since, timeline.tick)]
        ids = {name for name in found.crash.cause.ids if name != "av-1"}
        assert all(any(world.find(name) for name in ids) for world in worlds)
    assert expected > 0


def test_what_was_not_detected_where_it_was_was_not_seen_then() -> None:
    """A track that is remembered is no sighting: the answers about a crash agree."""
    missed = remembered = 0
    for timeline in crashes(25, sensor="radar", weather="rain"):
        found = foreseen(timeline)
        own = found.crash.explanation.decision.av
        hit = {name for name in found.crash.cause.ids if name != own}
        assert (found.seen_since is None) is hit.issubset(found.crash.missed)
        missed += found.seen_since is None
        taken = timeline.taken(found.state, own)
        assert taken is not None
        remembered += found.seen_since is None and any(taken.percept.find(name) for name in hit)
    assert missed > 0
    assert remembered > 0


def test_without_a_crash_there_is_no_blame() -> None:
    timeline = next(moments(1))
    for ask in (blame, foreseen):
        with pytest.raises(QuestionError, match="no_crash"):
            ask(timeline)
