"""This drive beside others of its settings, what was detected late, the best way, the safest of the moves."""

from __future__ import annotations

from functools import cache

import pytest

from sim.config import Config
from sim.explain.alternatives import after_move
from sim.explain.best_way import best_way
from sim.explain.chosen_safest import chosen_safest
from sim.explain.foresight import driving
from sim.explain.late import NEAR_LANES, NEAR_ROWS, late_things
from sim.explain.safest_moves import safety
from sim.explain.seed_drives import seed_drives
from sim.explain.sightings import sightings
from sim.explain.typical import typical
from sim.session.timeline import Timeline
from sim.types import Move, Outcome
from tests.narration.test_barred_rows import NARRATORS, YES_NO, told

HISTORY, OUTLOOK = "history", "outlook"
SEEDS = range(4)


@cache
def driven(seed: int, ticks: int = 200, planner: str = "priority") -> Timeline:
    config = Config(
        seed=seed,
        columns=6,
        rows=20,
        vehicles=10,
        pedestrians=2,
        potholes=6,
        sensor="camera",
        weather="fog",
        planner=planner,
    )
    timeline = Timeline(config)
    while timeline.state.world.outcome is Outcome.RUNNING and timeline.tick < ticks:
        timeline.advance()
    return timeline


@pytest.mark.parametrize("code", NARRATORS)
@pytest.mark.parametrize("ticks", [1, 9, 200])
def test_a_drive_is_compared_with_what_sessions_of_other_seeds_do(code: str, ticks: int) -> None:
    for seed in SEEDS:
        timeline = driven(seed, ticks)
        answer = told(timeline, code, about=HISTORY, what="typical")
        found = typical(timeline)
        assert answer["better"] + answer["worse"] <= len(found.others)  # type: ignore[operator]
        other = driven(seed + 1)
        told_of = seed_drives(timeline)[0]
        world = other.state.world
        assert (told_of.outcome, told_of.ticks) == (world.outcome, other.tick)
        assert len(told_of.stays) == other.state.metrics.stay
        rows = [other.at(tick).world.av // 6 for tick in (0, min(found.drive.ticks, other.tick))]
        assert told_of.rows_after(found.drive.ticks) == rows[0] - rows[1]
        if not found.ended:
            assert found.better == sum(
                each.rows_after(found.drive.ticks) > found.drive.done for each in found.others
            )
        text = str(answer["text"])
        assert f" {found.better} " in text
        assert f" {found.worse} " in text
        hard = told(timeline, code, "hard", about=HISTORY, what="typical")
        arrived = found.count_all(Outcome.SUCCESS)
        assert not arrived or str(arrived) in str(hard["text"])


def test_the_quickest_drive_is_not_called_worse_than_usual() -> None:
    for seed in SEEDS:
        found = typical(driven(seed))
        if found.drive.outcome is Outcome.SUCCESS:
            least = min((each.ticks for each in found.others if each.outcome is Outcome.SUCCESS), default=0)
            assert (found.better == 0) is (found.drive.ticks <= least or not least)
        else:
            assert found.worse == 0
        assert found.standing != "better" or found.worse > found.better


@pytest.mark.parametrize("code", NARRATORS)
def test_late_is_what_was_near_when_it_was_first_detected(code: str) -> None:
    yes, no = YES_NO[code]
    late = 0
    for seed in SEEDS:
        timeline = driven(seed)
        found = late_things(timeline)
        first = {each.id: each for each in sightings(timeline).things}
        for each in found.late:
            assert (first[each.id].first, first[each.id].rows) == (each.tick, each.rows)
            assert 1 <= each.rows <= NEAR_ROWS
            assert each.lanes <= NEAR_LANES
        assert all(first[each.id].first in (None, found.last) for each in found.never)
        late += len(found.late)
        text = str(told(timeline, code, about=HISTORY, what="late")["text"])
        assert text.startswith(yes) is bool(found.late)
        assert text.startswith(no) is not bool(found.late)
        of_kind = told(timeline, code, about=HISTORY, what="late", kind="pothole")
        assert all(each["id"].startswith("pothole") for each in of_kind["late"])  # type: ignore[attr-defined]
    assert late
    perfect = Timeline(Config(columns=6, rows=20))
    perfect.advance()
    assert str(told(perfect, code, about=HISTORY, what="late")["text"]).startswith(no)
    told(Timeline(Config(columns=6, rows=20)), code, about=HISTORY, what="late")


@pytest.mark.parametrize("code", NARRATORS)
def test_the_best_way_is_driven_as_it_is_told(code: str) -> None:
    found_ways = 0
    for seed in SEEDS:
        for ticks in (0, 6, 200):
            timeline = driven(seed, ticks)
            answer = told(timeline, code, about=HISTORY, what="best_way")
            told(timeline, code, "lane", about=HISTORY, what="best_way")
            told(timeline, code, about=OUTLOOK, what="best_way_here")
            way = best_way(timeline)
            if not way.plan:
                continue
            found_ways += 1
            state = driving(way.start)
            for move in way.plan:
                assert state.world.outcome is Outcome.RUNNING
                state = after_move(state, move)
            assert state.world.outcome is Outcome.SUCCESS
            assert answer["plan"] == list(way.plan)
            if timeline.state.world.outcome is Outcome.SUCCESS:
                assert len(way.plan) <= timeline.tick
    assert found_ways


@pytest.mark.parametrize("code", NARRATORS)
def test_the_move_made_is_held_against_all_others(code: str) -> None:
    yes, no = YES_NO[code]
    judged = set()
    for seed in SEEDS:
        timeline = driven(seed)
        for tick in (None, 3, timeline.tick - 1):
            found = chosen_safest(timeline, tick)
            parts: dict[str, object] = {} if tick is None else {"tick": tick}
            answer = told(timeline, code, None, about=HISTORY, what="chosen_safest", **parts)
            assert answer["made"] is timeline.decision(found.tick).move  # type: ignore[union-attr]
            assert len(found.moves) == len(Move)
            least = min(safety(each) for each in found.moves)
            assert found.was_safest is (safety(found.made) == least)
            assert str(answer["text"]).startswith(yes if found.was_safest else no)
            judged.add(found.was_safest)
        if timeline.state.world.outcome is Outcome.CRASH:
            assert chosen_safest(timeline).made.then is None
    assert judged == {True, False}
    told(Timeline(Config(columns=6, rows=20)), code, about=HISTORY, what="chosen_safest")
