"""Searches for failures: every case fails when replayed, can be driven, and is 1-minimal."""

from __future__ import annotations

import json
from threading import Event
from typing import Any

import pytest

from sim.actions import Drive, SetMode
from sim.config import Config
from sim.evaluate.executor import CancelledError, LocalProcesses
from sim.evaluate.spec import EvaluationError
from sim.falsify import Case, CaseError, Falsification
from sim.falsify.case import replay
from sim.falsify.cross_entropy import Distribution, draw, fit
from sim.falsify.search import falsify
from sim.falsify.shrink import Shrinking
from sim.falsify.space import KINDS_SEARCHED, LAYOUTS, Point, config_at
from sim.falsify.spec import MAX_WORLDS
from sim.falsify.stages import pieces, run_piece, total
from sim.falsify.summary import summarize
from sim.falsify.world import FAILURE_SCORE, Finding, drive, look
from sim.randomness import Stream
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Move, Outcome
from tests.support.broken_planner import registered

SMALL = Config(columns=6, rows=14)


@pytest.fixture(scope="module", params=["priority", "rules", "broken"])
def found(request: pytest.FixtureRequest) -> dict[str, Any]:
    planner = registered() if request.param == "broken" else request.param
    result = falsify(Falsification(planner=planner, worlds=100, config=SMALL, seed=3))
    assert result is not None
    return result


def cases(found: dict[str, Any]) -> list[Case]:
    return [Case.from_json(json.loads(json.dumps(each["case"]))) for each in found["cases"]]


def judged(case: Case, planner: str | None) -> Outcome:
    """How it ends in a session: with the planner, or driven by hand along the way that is claimed."""
    timeline = Timeline(case.config, SimState.start(case.config, case.world))
    way = iter(case.way)
    while timeline.state.world.outcome is Outcome.RUNNING:
        if planner is None:
            timeline.apply(timeline.tick + 1, [SetMode(mode="manual"), Drive(move=next(way))])
        timeline.advance()
    return timeline.state.world.outcome


def test_failures_are_found_and_shrunk(found: dict[str, Any]) -> None:
    assert found["cases"]
    assert found["hardest"] is None
    assert sum(found["findings"].values()) == 100
    for each in found["cases"]:
        assert len(each["things"]) < each["things_before"]


def test_every_case_fails_when_it_is_replayed(found: dict[str, Any]) -> None:
    for case in cases(found):
        again = replay(case)
        assert again.as_recorded(case)
        assert judged(case, case.config.planner) is case.outcome is not Outcome.SUCCESS


def test_every_case_can_be_driven_as_a_session_driven_by_hand_shows(found: dict[str, Any]) -> None:
    for case in cases(found):
        assert replay(case).drivable
        assert judged(case, None) is Outcome.SUCCESS


def test_without_any_one_thing_the_planner_arrives(found: dict[str, Any]) -> None:
    for case in cases(found):
        for name in case.things:
            less = SimState.start(case.config, case.world.without([name]))
            assert drive(less)[-1].world.outcome is Outcome.SUCCESS, (case.name, name)


def test_planners_that_are_said_to_arrive_do(found: dict[str, Any]) -> None:
    for each, case in zip(found["cases"], cases(found), strict=True):
        for name in each["arrive"]:
            assert replay(case, name).outcome is Outcome.SUCCESS


def test_a_planner_that_never_fails_is_told_the_hardest_world() -> None:
    result = falsify(Falsification(planner="bfs", worlds=40, config=SMALL.with_parts(attentive=0.0)))
    assert result is not None
    assert (result["cases"], result["findings"]["crashed"], result["findings"]["stuck"]) == ([], 0, 0)
    assert result["hardest"]["ticks"] >= result["hardest"]["least"] > 0


def test_two_processes_find_what_one_does() -> None:
    spec = Falsification(planner="priority", worlds=60, config=SMALL)
    executor = LocalProcesses(2)
    told: list[int] = []
    try:
        several = falsify(spec, executor, told.append)
    finally:
        executor.close()
    assert json.dumps(several) == json.dumps(falsify(spec))
    assert told == sorted(told)
    assert told[-1] == total(spec)


def test_a_search_goes_on_from_the_pieces_that_are_kept() -> None:
    spec = Falsification(planner="priority", worlds=40, config=SMALL)
    parts: dict[str, bytes] = {}
    rounds = 0
    while left := pieces(spec, parts):
        rounds += 1
        piece = left[0]  # one at a time, everything else forgotten
        parts[piece.key] = run_piece(spec.to_json(), piece, lambda: False)
    assert rounds == len(parts)
    assert json.dumps(summarize(spec, parts)) == json.dumps(falsify(spec))
    with pytest.raises(ValueError, match="missing"):
        summarize(spec, {key: body for key, body in parts.items() if key != "case:0"})


def test_a_cancelled_search_has_no_result() -> None:
    spec = Falsification(planner="priority", worlds=40, config=SMALL)
    cancelled = Event()
    assert falsify(spec, progress=lambda _: cancelled.set(), cancelled=cancelled) is None
    with pytest.raises(CancelledError):
        run_piece(spec.to_json(), pieces(spec, {})[0], lambda: True)


@pytest.mark.parametrize(
    ("given", "field"),
    [
        ({"worlds": 0}, "episodes"),
        ({"worlds": MAX_WORLDS + 1}, "episodes"),
        ({"planner": "quickest-ever"}, "planner"),
        ({"seed": -1}, "seed"),
    ],
)
def test_what_cannot_be_searched_is_refused_before_it_begins(given: dict[str, Any], field: str) -> None:
    with pytest.raises(EvaluationError) as refused:
        Falsification(**{"planner": "priority", "worlds": 10, **given})
    assert [each.field for each in refused.value.problems] == [field]


def test_json_and_back_is_the_same_search() -> None:
    spec = Falsification(planner="exact", worlds=7, config=Config(weather="rain", sensor="camera"), seed=3)
    assert spec.planner == "bfs"
    assert Falsification.from_json(json.loads(json.dumps(spec.to_json()))) == spec


def test_every_world_is_in_one_stretch() -> None:
    for worlds in (1, 9, 11, 399, 20_000):
        cut = Falsification(planner="priority", worlds=worlds).stretches()
        indices = [
            index for part in cut for each in part for index in range(each.first, each.first + each.count)
        ]
        assert indices == list(range(worlds))


@pytest.mark.parametrize("layout", range(len(LAYOUTS)))
def test_every_point_has_a_configuration_unless_the_road_is_too_small(layout: int) -> None:
    for level in (0.0, 0.5, 1.0):
        point = Point((level,) * len(KINDS_SEARCHED), layout)
        config = config_at(SMALL, point, 5)
        assert config is not None
        assert (config.layout, config.seed, config.columns) == (LAYOUTS[layout], 5, 6)


def test_the_distribution_moves_towards_the_elite() -> None:
    points = [draw(None, Stream.of(1, "test", number)) for number in range(200)]
    scores = [FAILURE_SCORE if point.levels[0] > 0.7 else 0.1 for point in points]
    fitted = fit(Distribution(), points, scores, FAILURE_SCORE)
    assert fitted.means[0] > 0.72
    assert abs(fitted.means[1] - 0.5) < 0.1
    scores = [FAILURE_SCORE if point.layout == 2 else 0.1 for point in points]
    assert fit(Distribution(), points, scores, FAILURE_SCORE).layouts[2] > 0.6
    assert sum(fitted.layouts) == pytest.approx(1, abs=1e-5)
    assert fit(fitted, [], [], FAILURE_SCORE) == fitted


def test_directed_draws_find_a_rare_defect_more_often_than_random_ones() -> None:
    planner = registered()
    found = [
        falsify(Falsification(planner=planner, worlds=200, config=SMALL, seed=11, directed=directed))
        for directed in (False, True)
    ]
    random, directed = (sum(each["findings"][name] for name in ("crashed", "stuck")) for each in found)  # type: ignore[index]
    assert directed > random > 0


def test_what_nobody_can_drive_is_no_failure() -> None:
    spec = Falsification(planner="rules", worlds=60, config=Config(columns=3, rows=12), seed=0)
    seen = [look(spec, index, draw(None, Stream.of(0, "falsify", index))) for index in range(60)]
    blocked = [each for each in seen if each.finding is Finding.UNSOLVABLE]
    assert blocked
    assert all(each.score < FAILURE_SCORE and not each.finding.failed for each in blocked)


def test_a_world_that_fails_for_one_thing_shrinks_to_it() -> None:
    planner = registered()
    for seed in range(40):
        start = SimState.start(Config(planner=planner, potholes=45, vehicles=8, seed=seed, rows=16))
        shrinking = Shrinking(start)
        names = (*start.world.movers.values(), *start.world.hazards.values())
        if shrinking.holds(names):
            kept = shrinking.minimal()
            assert kept is not None
            assert len(kept) >= 14  # the defect takes as many
            assert not any(shrinking.fails([each for each in kept if each != name]) for name in kept)
            return
    pytest.fail("no road on which it fails")


@pytest.mark.parametrize(
    "change",
    [
        {"format": "roadtalk-recording"},
        {"version": 2},
        {"more": 1},
        {"name": "../../etc"},
        {"world": "road 3x3"},
        {"outcome": "bored"},
        {"way": ["fly"]},
        {"config": {"columns": 1}},
    ],
)
def test_what_is_no_case_is_refused(change: dict[str, Any]) -> None:
    result = falsify(Falsification(planner="priority", worlds=20, config=SMALL))
    assert result is not None
    good = result["cases"][0]["case"]
    assert json.loads(json.dumps(Case.from_json(good).to_json())) == json.loads(json.dumps(good))
    with pytest.raises(CaseError):
        Case.from_json({**good, **change})


def test_a_case_that_says_another_way_is_found_out() -> None:
    result = falsify(Falsification(planner="priority", worlds=20, config=SMALL))
    assert result is not None
    good = Case.from_json(result["cases"][0]["case"])
    assert not replay(Case.from_json({**good.to_json(), "way": [Move.STAY]})).drivable
