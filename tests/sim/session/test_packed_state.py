"""Packed states are the states they were, and few bytes."""

from __future__ import annotations

import sys
from dataclasses import replace
from random import Random

import pytest

from sim.config import Config
from sim.session.packed_state import PackedState, pack
from sim.session.timeline import SNAPSHOT_TICKS, UNPACKED, Timeline
from sim.state import SimState
from tests.support.two_egos import drawn


def bytes_of(packed: PackedState) -> int:
    return sys.getsizeof(packed) + sys.getsizeof(packed._bytes) + sys.getsizeof(packed._configs)


@pytest.mark.parametrize("planner", ["priority", "rules", "astar"])
def test_a_packed_state_goes_on_as_the_state_itself(planner: str) -> None:
    timeline = Timeline(Config(seed=11, planner=planner, potholes=4))
    for _ in range(40):
        timeline.advance()
    state = timeline.state
    back = PackedState(state).unpack()
    assert back == state
    assert back is not state
    assert back.config is state.config
    one, two = timeline.copy(), timeline.copy()
    one.state = back
    for _ in range(20):
        assert one.advance().state.world.digest() == two.advance().state.world.digest()


def test_the_past_is_the_same_whether_packed_or_not(monkeypatch: pytest.MonkeyPatch) -> None:
    packed = Timeline(Config(seed=7))
    monkeypatch.setattr("sim.session.timeline.UNPACKED", 10_000)
    plain = Timeline(Config(seed=7))
    monkeypatch.undo()
    for _ in range(6 * SNAPSHOT_TICKS):
        packed.advance()
        plain.advance()
    for tick in range(0, packed.tick, 37):
        assert packed.at(tick) == plain.at(tick)
    kinds = [isinstance(shot._kept, PackedState) for shot in packed._snapshots]
    assert kinds == [True] * (len(kinds) - UNPACKED) + [False] * UNPACKED
    packed.rewind(SNAPSHOT_TICKS + 3)
    plain.rewind(SNAPSHOT_TICKS + 3)
    for _ in range(10):
        assert packed.advance().state == plain.advance().state


def test_a_running_session_grows_by_few_bytes_a_tick() -> None:
    """Packed states and moves are all that grows with the ticks."""
    timeline = Timeline(Config(seed=7))
    for _ in range(8 * SNAPSHOT_TICKS):
        timeline.advance()
    packed = [shot._kept for shot in timeline._snapshots if isinstance(shot._kept, PackedState)]
    moves = sum(map(sys.getsizeof, timeline._track.blocks))
    assert len(packed) >= 5
    assert (sum(map(bytes_of, packed)) + moves) / timeline.tick < 14


def test_a_restored_timeline_is_packed_as_well() -> None:
    timeline = Timeline(Config(seed=7))
    for _ in range(4 * SNAPSHOT_TICKS):
        timeline.advance()
    config, state, entries, shots, gap, work, worked, moves = timeline.parts()
    again = Timeline.made(config, state, entries, shots, gap, work, worked, moves)
    assert [shot.state for shot in again._snapshots] == [shot.state for shot in shots]
    assert all(isinstance(shot._kept, PackedState) for shot in again._snapshots[:-UNPACKED])


def test_several_egos_are_packed() -> None:
    state = drawn(Random(5), "rules")
    assert len(state.egos) == 2
    assert PackedState(state).unpack() == state


def test_a_belief_that_cannot_be_packed_is_kept_as_it_is() -> None:
    state = SimState.start(Config(seed=7))
    ego = replace(state.ego(), belief=lambda: None)  # type: ignore[arg-type]
    odd = replace(state, egos={ego.id: ego})
    assert pack(odd) is odd


def test_the_configurations_of_states_stay_one_object() -> None:
    timeline = Timeline(Config(seed=7))
    for _ in range(3 * SNAPSHOT_TICKS):
        timeline.advance()
    configs = {id(shot.state.config) for shot in timeline._snapshots}
    assert configs == {id(timeline.config)}
