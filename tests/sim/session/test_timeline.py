"""Walking time: the past is what it was, undo is as if never said, redo as if never undone."""

from __future__ import annotations

from collections.abc import Sequence

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sim.actions import Add, Drive, Remove, Reset, Scenario, SetCount, SetMode, Where, WorldAction
from sim.config import Config
from sim.decide import decide
from sim.session.errors import EditError
from sim.session.timeline import MAX_SNAPSHOTS, RECENT_RUNS, SNAPSHOT_TICKS, Entry, Timeline
from sim.state import SimState, StepResult
from sim.transition import step
from sim.types import Kind, Mode, Move

CONFIG = Config(columns=6, rows=10, seed=21, potholes=4, pedestrians=2)

ACTIONS = st.sampled_from(
    [
        Add(kind="pothole", count=2),
        Add(kind="vehicle", count=1, where=Where(side="ahead")),
        Add(kind="barrier", count=60),
        SetCount(kind="vehicle", count=5),
        Remove(kind="everything", count="all", where=Where(lane="left")),
        Remove(kind="pothole", count=1, where=Where(nearest=True)),
        Scenario(road="city", potholes=3),
        Reset(),
        SetMode(mode=Mode.MANUAL),
        SetMode(mode=Mode.AUTO),
        Drive(move=Move.LEFT),
        Drive(move=Move.FORWARD),
    ]
)
Script = list[tuple[int, list[WorldAction]]]
"""Pairs of ticks to let pass and actions said together then."""

SCRIPTS = st.lists(st.tuples(st.integers(0, 25), st.lists(ACTIONS, max_size=3)), max_size=7)


def said(timeline: Timeline, sequence: int, actions: Sequence[WorldAction]) -> bool:
    """Whether the actions were accepted."""
    try:
        timeline.apply(sequence, actions)
    except EditError:
        return False
    return True


def undone(timeline: Timeline) -> list[Entry]:
    """Take back what was said last; its entries."""
    last = timeline.entries[-1].sequence
    taken = [entry for entry in timeline.entries if entry.sequence == last]
    timeline.rewrite(timeline.entries[: -len(taken)], taken[0].tick)
    return taken


def redone(timeline: Timeline, taken: list[Entry]) -> None:
    """Say it again, at the ticks it was said."""
    timeline.rewrite(timeline.entries + taken, taken[0].tick)


def played(script: Script) -> tuple[Timeline, list[SimState]]:
    """A timeline, and the state at each tick as it was when the tick was left."""
    timeline, seen = Timeline(CONFIG), []
    for sequence, (ticks, actions) in enumerate(script, 1):
        for _ in range(ticks):
            seen.append(timeline.state)
            timeline.advance()
        said(timeline, sequence, actions)
    seen.append(timeline.state)
    return timeline, seen


@settings(max_examples=40, deadline=None)
@given(SCRIPTS)
def test_every_past_state_is_what_was_seen_live(script: Script) -> None:
    timeline, seen = played(script)
    assert timeline.tick == len(seen) - 1
    for tick, state in enumerate(seen):
        assert timeline.at(tick) == state
    assert list(timeline.between(0, timeline.tick)) == seen[:-1]
    assert list(timeline.between(timeline.tick // 2, timeline.tick)) == seen[timeline.tick // 2 : -1]


@settings(max_examples=30, deadline=None)
@given(SCRIPTS)
def test_every_past_decision_is_what_was_decided_live(script: Script) -> None:
    timeline, decisions = Timeline(CONFIG), []
    for sequence, (ticks, actions) in enumerate(script, 1):
        decisions += [timeline.advance().decision for _ in range(ticks)]
        said(timeline, sequence, actions)
    for tick, decision in enumerate(decisions):
        assert timeline.decision(tick) == decision
    assert timeline.decision(timeline.tick) == decide(timeline.state)


@settings(max_examples=40, deadline=None)
@given(SCRIPTS, st.integers(1, 20))
def test_undone_is_never_said_and_redone_is_never_undone(script: Script, later: int) -> None:
    timeline, _ = played(script)
    for _ in range(later):
        timeline.advance()
    if not timeline.entries:
        return
    last = timeline.entries[-1].sequence
    before, log = timeline.state, list(timeline.entries)

    taken = undone(timeline)
    assert taken == [entry for entry in log if entry.sequence == last]
    kept = {entry.sequence for entry in log} - {last}  # what was refused then might be accepted now
    never, _ = played([(ticks, actions if n in kept else []) for n, (ticks, actions) in enumerate(script, 1)])
    for _ in range(later):
        never.advance()
    assert timeline.state == never.state
    assert timeline.entries == never.entries
    for tick in range(0, timeline.tick + 1, 5):
        assert timeline.at(tick) == never.at(tick)

    redone(timeline, taken)
    assert timeline.state == before
    assert timeline.entries == log


@settings(max_examples=25, deadline=None)
@given(SCRIPTS)
def test_everything_can_be_undone_and_redone(script: Script) -> None:
    timeline, seen = played(script)
    log = list(timeline.entries)
    changes = len({entry.sequence for entry in log})
    taken = [undone(timeline) for _ in range(changes)]
    assert timeline.entries == []
    assert timeline.state == played([(len(seen) - 1, [])])[0].state
    for entries in reversed(taken):
        redone(timeline, entries)
    assert timeline.entries == log
    assert [timeline.at(tick) for tick in range(len(seen))] == seen


def test_redo_says_it_again_at_the_tick_it_was_said() -> None:
    timeline, _ = played([(5, [Add(kind="pothole", count=3)])])
    taken = undone(timeline)
    assert taken == [Entry(1, 5, Add(kind="pothole", count=3))]
    timeline.advance()
    redone(timeline, taken)
    straight, _ = played([(5, [Add(kind="pothole", count=3)]), (1, [])])
    assert timeline.state == straight.state


def test_all_the_actions_or_none() -> None:
    timeline, _ = played([(4, [Add(kind="pothole", count=1)])])
    before = timeline.state
    with pytest.raises(EditError):
        timeline.apply(2, [Add(kind="barrier", count=2), Add(kind="pothole", count=500)])
    assert timeline.state == before
    assert len(timeline.entries) == 1


def test_actions_said_together_are_one_change() -> None:
    timeline = Timeline(CONFIG)
    done = timeline.apply(7, [Add(kind="barrier", count=1), Remove(kind="barrier", count="all")])
    assert [len(applied.added) for applied in done] == [1, 0]
    assert [entry.sequence for entry in timeline.entries] == [7, 7]
    assert len(undone(timeline)) == 2
    assert timeline.state == SimState.start(CONFIG)


def test_nothing_said_changes_nothing() -> None:
    timeline, _ = played([(2, [Add(kind="pothole", count=1)])])
    before = timeline.state
    assert timeline.apply(2, []) == []
    assert timeline.state == before
    assert len(timeline.entries) == 1


def test_a_copy_goes_its_own_way() -> None:
    timeline, seen = played([(9, [Add(kind="pothole", count=2)]), (9, [])])
    copy = timeline.copy()
    assert (copy.state, copy.entries, copy.tick) == (timeline.state, timeline.entries, timeline.tick)
    copy.apply(50, [Scenario(potholes=0)])
    for _ in range(80):
        copy.advance()
    undone(copy)
    undone(copy)
    assert (timeline.tick, len(timeline.entries)) == (18, 1)
    assert [timeline.at(tick) for tick in range(19)] == seen
    for _ in range(100):
        timeline.advance()
    assert copy.tick == 98
    assert copy.state == played([(98, [])])[0].state


@pytest.mark.parametrize("tick", [-1, 6, 10**9])
def test_there_is_no_state_outside_of_what_has_been(tick: int) -> None:
    timeline, _ = played([(5, [])])
    for question in (timeline.at, timeline.decision):
        with pytest.raises(IndexError, match="not between 0 and 5"):
            question(tick)


@pytest.mark.parametrize(("first", "stop"), [(-1, 3), (0, 7), (-5, -2)])
def test_there_are_no_states_outside_of_what_has_been(first: int, stop: int) -> None:
    timeline, _ = played([(5, [])])
    with pytest.raises(IndexError, match="not between 0 and 5"):
        list(timeline.between(first, stop))


def test_the_last_few_states_are_kept_and_forgotten_when_the_past_changes() -> None:
    timeline, seen = played([(RECENT_RUNS + 5, [Add(kind="pothole", count=5)]), (3, [])])
    assert all(timeline.at(tick) is seen[tick] for tick in range(timeline.tick - RECENT_RUNS, timeline.tick))
    undone(timeline)
    timeline.advance()
    never, _ = played([(timeline.tick, [])])
    assert [timeline.at(tick) for tick in range(timeline.tick)] == [never.at(t) for t in range(timeline.tick)]


@pytest.fixture
def ran(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """The ticks that are run from here on, by where they begin."""
    ticks: list[int] = []

    def counted(state: SimState) -> StepResult:
        ticks.append(state.world.tick)
        return step(state)

    monkeypatch.setattr("sim.session.timeline.step", counted)
    return ticks


def test_taking_back_what_was_said_last_runs_only_the_ticks_since_then(ran: list[int]) -> None:
    potholes = [Add(kind="pothole", count=1)]
    timeline, _ = played([(90, potholes), (20, potholes), (3, potholes), (4, [])])
    ran.clear()
    first = undone(timeline)
    assert ran == [113, 114, 115, 116]
    ran.clear()
    undone(timeline)
    assert ran == list(range(110, 117))
    ran.clear()
    redone(timeline, first)
    assert ran == [113, 114, 115, 116], "what came before is driven as it was"
    assert timeline.state == played([(90, potholes), (23, potholes), (4, [])])[0].state


def test_a_later_state_is_not_looked_for_from_an_older_change(ran: list[int]) -> None:
    ticks = 4 * SNAPSHOT_TICKS
    timeline, seen = played([(5, [Add(kind="pothole", count=1)]), (ticks, [])])
    ran.clear()
    tick = ticks - RECENT_RUNS
    assert timeline.at(tick) == seen[tick]
    assert len(ran) <= SNAPSHOT_TICKS


def test_snapshots_thin_out_and_the_past_stays_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    """The same with fewer of them, so that the bound is passed several times in little time."""
    monkeypatch.setattr("sim.session.timeline.MAX_SNAPSHOTS", 5)
    monkeypatch.setattr("sim.session.timeline.SNAPSHOT_TICKS", 4)
    script: Script = [
        (37, [Add(kind="pothole", count=2)]),
        (27, [Add(kind="barrier", count=1)]),
        (64, [Scenario(potholes=6)]),
        (33, []),
    ]
    timeline, seen = played(script)
    assert len(timeline._snapshots) <= 5
    assert [timeline.at(tick) for tick in range(len(seen))] == seen
    undone(timeline)
    undone(timeline)
    for _ in range(50):
        timeline.advance()
    never, _ = played([(37, [Add(kind="pothole", count=2)]), (len(seen) - 1 - 37 + 50, [])])
    assert timeline.state == never.state
    assert len(timeline._snapshots) <= 6
    assert timeline.at(40) == never.at(40)


def test_a_long_session_keeps_a_bounded_number_of_states(monkeypatch: pytest.MonkeyPatch) -> None:
    """Past the real bound, on a road so small that it takes a second."""
    gap = SNAPSHOT_TICKS // 2
    monkeypatch.setattr("sim.session.timeline.SNAPSHOT_TICKS", gap)
    config = Config(columns=3, rows=4, vehicles=0, potholes=0, reset_delay_s=0, seed=1)
    timeline = Timeline(config)
    ticks = MAX_SNAPSHOTS * gap + 100
    marks = {}
    for tick in range(ticks):
        if tick % 4111 == 0:
            marks[tick] = timeline.state
        timeline.advance()
    assert len(timeline._snapshots) <= MAX_SNAPSHOTS
    for tick, state in marks.items():
        assert timeline.at(tick) == state


def test_undo_reaches_across_the_end_of_an_episode() -> None:
    timeline, _ = played([(1, [SetCount(kind="barrier", count=0), Add(kind="pothole", count=4)]), (60, [])])
    assert timeline.state.world.episode > 1
    undone(timeline)
    assert timeline.state == played([(61, [])])[0].state
    assert timeline.state.world.count(Kind.AV) == 1


def test_states_are_kept_by_the_work_between_them_also_within_one_tick() -> None:
    """However much is said at one tick, no state is far from one that is kept."""
    timeline = Timeline(CONFIG)
    for number in range(1, 200):
        timeline.apply(number, [SetCount(kind="pothole", count=number % 5)])
    timeline.advance()
    assert len(timeline._snapshots) > 4
    there = timeline.at(0)
    assert timeline.work_to(0) <= SNAPSHOT_TICKS
    timeline.rewrite(timeline.entries[:150], 0)
    straight = Timeline(CONFIG)
    for number in range(1, 151):
        straight.apply(number, [SetCount(kind="pothole", count=number % 5)])
    assert timeline.at(0) == straight.state != there
    straight.advance()
    assert timeline.state == straight.state
    assert timeline.work_since(0) > timeline.work_to(0)
    timeline.rewind(0)
    assert timeline.state.world == straight.at(0).world
