"""Frames in which the vehicle is drawn over something are found, and told apart from those of a crash."""

from __future__ import annotations

from dataclasses import replace

from sim.config import Config
from sim.render.motion import STEP_FRAMES, glide_start, poses
from sim.state import FIRST, SimState
from sim.transition import transition
from sim.types import Kind, Mode, Move, Outcome
from sim.world import World
from tests.support.roads import road, run_on
from tools.contacts import Case, cases, worlds
from tools.drawn_overlaps import Found, overlaps, watch

CUTTING = Case(Move.FORWARD_LEFT, Kind.VEHICLE, (-1, 0), 1)


def test_a_contact_that_was_not_judged_is_found() -> None:
    before, after = worlds(CUTTING)
    unjudged = replace(after, outcome=Outcome.RUNNING, ended=None)
    frames = [overlaps(poses(before, unjudged, n / STEP_FRAMES)) for n in range(STEP_FRAMES + 1)]
    assert [0] in frames
    assert frames[0] == frames[-1] == []


def test_no_case_without_a_contact_is_found() -> None:
    for case in cases():
        before, after = worlds(case)
        assert not any(overlaps(poses(before, after, n / STEP_FRAMES)) for n in range(STEP_FRAMES + 1))


def test_an_episode_is_watched_tick_by_tick() -> None:
    found = Found()
    watch(Config(seed=3, vehicles=0, potholes=0, rows=8), found)
    assert (found.ticks, found.crashes, found.frames, found.overlapping) == (7, 0, 7 * (STEP_FRAMES + 1), 0)


def crashed() -> tuple[SimState, SimState]:
    """A run and its crash, into a pothole straight ahead."""
    state = run_on(road("........", "...o....", "...A....", "........")).with_ego(mode=Mode.MANUAL)
    return state, transition(state, {FIRST: Move.FORWARD}, by_person=(FIRST,)).state


def test_what_crashed_stays_where_it_touched_while_the_result_stands() -> None:
    before, after = crashed()
    assert after.world.outcome is Outcome.CRASH
    at_end = poses(*_way(after, before, 1.0))
    assert at_end.touch is not None
    assert 1 < at_end.av.row < 2
    later = replace(after, world=replace(after.world, tick=after.world.tick + 1))
    for seen in (poses(*_way(later, after, 0.2)), poses(*_way(later, None, 1.0))):
        assert (seen.av.row, seen.touch) == (at_end.av.row, at_end.touch)


def test_a_crash_is_approached() -> None:
    before, after = crashed()
    early, late = (poses(*_way(after, before, phase)) for phase in (0.2, 0.9))
    assert early.touch is None
    assert early.av.row > late.av.row


def _way(state: SimState, before: SimState | None, phase: float) -> tuple[World, World, float]:
    start, gone = glide_start(state, before.world if before else None, phase)
    return start, state.world, gone
