"""Evaluations: what is refused before work starts, and results that depend on the evaluation alone."""

from __future__ import annotations

import json
import os
import signal
from collections.abc import Callable
from functools import partial
from pathlib import Path
from threading import Event

import numpy as np
import pytest

from sim.config import Config
from sim.evaluate import Evaluation, EvaluationError, Part
from sim.evaluate.cases import Case
from sim.evaluate.executor import CancelledError, LocalProcesses
from sim.evaluate.part import run_part
from sim.evaluate.rows import join, pack, unpack
from sim.evaluate.run import evaluate, pack_part, summarize_parts
from sim.evaluate.spec import LIVE_PART
from sim.state import SimState
from sim.world.notation import write

PAIR = Evaluation(planners=("astar", "priority"), episodes=50, seed=30)


@pytest.mark.parametrize(
    ("given", "field", "code"),
    [
        ({"episodes": 0}, "episodes", "must_be_between"),
        ({"episodes": 1_000_000_000}, "episodes", "must_be_between"),
        ({"planners": ("quickest-ever",)}, "planners", "must_be_one_of"),
        ({"planners": ("dwa",)}, "planners", "not_available_one_of"),
        ({"planners": ()}, "planners", "must_be_between"),
        ({"seed": -1}, "seed", "must_be_between"),
        ({"seed": 2**63}, "seed", "must_be_between"),
    ],
)
def test_what_cannot_be_run_is_refused_before_it_begins(
    given: dict[str, object], field: str, code: str
) -> None:
    with pytest.raises(EvaluationError) as refused:
        Evaluation(**{"planners": ("priority",), "episodes": 10, **given})  # type: ignore[arg-type]
    assert [(each.field, each.code) for each in refused.value.problems] == [(field, code)]


def test_a_road_without_a_way_is_refused_before_it_begins() -> None:
    config = Config(columns=3, rows=6, vehicles=0, potholes=12)
    world = write(SimState.start(config).world)
    spec = Evaluation(planners=("priority",), episodes=5, config=config, world=world)
    with pytest.raises(EvaluationError, match="has no way"):
        spec.check_road()


def test_a_planner_named_twice_or_by_an_older_name_drives_once() -> None:
    assert Evaluation(planners=("exact", "bfs", "exact"), episodes=1).planners == ("bfs",)


def test_json_and_back_is_the_same_evaluation() -> None:
    spec = Evaluation(planners=("rules",), episodes=7, config=Config(potholes=9), seed=3)
    assert Evaluation.from_json(json.loads(json.dumps(spec.to_json()))) == spec


def test_every_episode_is_in_one_part() -> None:
    for episodes in (1, 19, 20, 199, 201, 999, 1_000, 60_321):
        spec = Evaluation(planners=("priority",), episodes=episodes)
        covered = [range(part.first, part.first + part.count) for part in spec.parts()]
        assert [index for each in covered for index in each] == list(range(episodes))


def test_the_result_does_not_depend_on_how_it_is_cut() -> None:
    whole = run_part(PAIR, Part(0, 50))
    cut = join([run_part(PAIR, part) for part in (Part(0, 7), Part(7, 1), Part(8, 42))])
    assert pack(cut) == pack(whole)
    assert pack(unpack(pack(whole))) == pack(whole)


def test_two_processes_find_what_one_does() -> None:
    executor = LocalProcesses(2)
    told: list[int] = []
    try:
        several = evaluate(PAIR, executor, told.append)
    finally:
        executor.close()
    assert json.dumps(several) == json.dumps(evaluate(PAIR))
    assert told == sorted(told)
    assert told[-1] == PAIR.episodes


@pytest.mark.parametrize("planner", ["priority", "rules", "astar", "bfs"])
@pytest.mark.parametrize(
    "config",
    [
        Config(weather="rain"),
        Config(attentive=0.6, courtesy=0.3, potholes=30, pedestrians=3, rows=12, columns=5),
    ],
)
def test_the_compiled_batch_drives_as_the_live_engine_does(planner: str, config: Config) -> None:
    spec = Evaluation(planners=(planner,), episodes=1_000, config=config)
    assert spec.compiled(planner)
    part = Part(200, 60)
    fast = run_part(spec, part)
    slow = run_part(Evaluation(planners=(planner,), episodes=260, config=config), part)
    for name, column in slow[planner].items():
        assert np.array_equal(fast[planner][name], column), name
    assert np.array_equal(fast["roads"]["solvable"], slow["roads"]["solvable"])


@pytest.mark.parametrize("parts", [{"weather": "snow", "slip_probability": 0.1}, {"layout": "narrows"}])
def test_roads_that_the_compiled_batch_does_not_know_are_driven_one_by_one(parts: dict[str, str]) -> None:
    spec = Evaluation(planners=("priority",), episodes=1_000, config=Config(**parts))  # type: ignore[arg-type]
    assert not spec.compiled("priority")
    assert spec.part_size == LIVE_PART
    rows = run_part(spec, Part(300, 2))
    assert len(rows["priority"]["outcome"]) == 2


def test_parts_that_are_missing_or_there_twice_are_noticed() -> None:
    body = pack_part(PAIR.to_json(), Part(0, 20), lambda: False)
    with pytest.raises(ValueError, match="missing"):
        summarize_parts(PAIR, {Part(0, 20): body}, lambda: False)
    with pytest.raises(ValueError, match="twice"):
        summarize_parts(PAIR, {Part(0, 20): body, Part(10, 40): body}, lambda: False)


def test_a_cancelled_part_ends_after_the_episode_it_is_at() -> None:
    asked: list[None] = []

    def cancelled() -> bool:
        asked.append(None)
        return len(asked) > 5

    with pytest.raises(CancelledError):
        run_part(PAIR, Part(0, 50), cancelled)
    assert len(asked) == 6


def test_a_cancelled_evaluation_has_no_result() -> None:
    cancelled = Event()
    assert evaluate(PAIR, progress=lambda _: cancelled.set(), cancelled=cancelled) is None


def test_one_road_with_nothing_left_to_chance_always_ends_alike() -> None:
    config = Config(seed=4)
    spec = Evaluation(
        planners=("rules",), episodes=5, config=config, world=write(SimState.start(config).world)
    )
    assert spec.alike
    rows = run_part(spec, Part(0, 5))
    assert len(set(rows["rules"]["ticks"].tolist())) == 1
    drawn = run_part(Evaluation(planners=("rules",), episodes=1, config=Config(seed=4), seed=4), Part(0, 1))
    assert rows["rules"]["ticks"][0] == drawn["rules"]["ticks"][0]


def _lose_once(marker: str, spec: dict[str, object], piece: Part, cancelled: Callable[[], bool]) -> bytes:
    """Ends its process without a word the first time that it is run."""
    path = Path(marker)
    if piece.first == LIVE_PART and not path.exists():
        path.touch()
        os.kill(os.getpid(), signal.SIGKILL if hasattr(signal, "SIGKILL") else signal.SIGTERM)
    return pack_part(spec, piece, cancelled)


def test_a_lost_process_loses_no_episode(tmp_path: Path) -> None:
    executor = LocalProcesses(2)
    work = partial(_lose_once, str(tmp_path / "lost"), PAIR.to_json())
    try:
        parts = dict(executor.run(work, PAIR.parts(), Event()))
    finally:
        executor.close()
    assert (tmp_path / "lost").exists()
    assert json.dumps(summarize_parts(PAIR, parts, lambda: False)) == json.dumps(evaluate(PAIR))


@pytest.mark.parametrize(
    "spec",
    [
        Evaluation(planners=("rules",), episodes=7),
        Evaluation(planners=("rules", "priority"), episodes=500),
        Evaluation(planners=("astar",), episodes=6_001),
        Evaluation(planners=("rules",), episodes=20_100, cases=(Case({}, {}), Case({}, {"potholes": 9}))),
    ],
)
def test_what_parts_cost_tells_how_many_episodes_are_done(spec: Evaluation) -> None:
    work = episodes = 0
    for part in spec.parts():
        assert spec.episodes_after(work) == episodes
        work, episodes = work + spec.work_of(part), episodes + part.count
    assert work == spec.work
    assert spec.episodes_after(work) == episodes
