"""What a planner's process is asked and may answer, byte by byte; planners that mean harm, tried apart."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from sim import planner_names
from sim.config import Config
from sim.forecast import predict
from sim.perceive import Percept, perceive_truth
from sim.plan import traits_of
from sim.plan.conformance import check_apart, moments, name_conflicts
from sim.plan.decision import Measure
from sim.plan.priority import PriorityPlanner
from sim.plan.protocol import UNKNOWN
from sim.plan.sandbox.answer import FaultError, decision_of, parse_answer
from sim.plan.sandbox.codec import parse_question, percept_of, percept_values, question
from sim.state import SimState
from sim.types import Move
from tests.support import faulty_planners
from tests.support.hostile_planners import HOSTILE, POSING

COSTS = '"forward": 1, "left": 2.5, "right": null, "forward_left": 4, "forward_right": 5, "stay": -6'


def percept_and(config: Config) -> tuple[Percept, Config]:
    return perceive_truth(SimState.start(config).world, config), config


@pytest.mark.parametrize("config", [Config(seed=3), Config(columns=40, rows=300, pedestrians=9, seed=2**40)])
def test_a_question_comes_back_as_it_was(config: Config) -> None:
    percept, config = percept_and(config.with_parts(preferences=("cautious",)))
    assert parse_question(question(percept, config)) == (percept, config)
    assert question(percept, config) == question(*parse_question(question(percept, config)))


def test_numbers_of_any_size_and_sign_come_back() -> None:
    percept, _ = percept_and(Config(seed=3))
    for number in (0, 2**53 - 1, 2**53, 2**4_000 + 1, -(2**60)):
        again = percept_of(percept_values(replace(percept, right=number)))
        assert again.right == number


def test_an_answer_is_a_move_and_six_costs() -> None:
    answer = parse_answer(f'{{"move": "left", "costs": {{{COSTS}}}}}'.encode())
    assert (answer.move, answer.costs) == (Move.LEFT, (1.0, 2.5, None, 4.0, 5.0, -6.0))


@pytest.mark.parametrize(
    "line",
    [
        b"",
        b"null",
        b"[1]",
        b"\xff\xfe",
        b"[" * 4_000,
        b'{"move": "left"}',
        f'{{"move": "left", "costs": {{{COSTS}}}, "causes": []}}'.encode(),
        f'{{"move": "left", "move": "stay", "costs": {{{COSTS}}}}}'.encode(),
        f'{{"move": "Left", "costs": {{{COSTS}}}}}'.encode(),
        f'{{"move": ["left"], "costs": {{{COSTS}}}}}'.encode(),
        f'{{"move": "left", "costs": {{{COSTS}, "stay": 1}}}}'.encode(),
        f'{{"move": "left", "costs": {{{COSTS.replace("-6", "NaN")}}}}}'.encode(),
        f'{{"move": "left", "costs": {{{COSTS.replace("-6", "-Infinity")}}}}}'.encode(),
        f'{{"move": "left", "costs": {{{COSTS.replace("-6", "1e999")}}}}}'.encode(),
        f'{{"move": "left", "costs": {{{COSTS.replace("-6", "1" + "0" * 3_000)}}}}}'.encode(),
        f'{{"move": "left", "costs": {{{COSTS.replace("-6", "true")}}}}}'.encode(),
        f'{{"move": "left", "costs": {{{COSTS.replace("-6", "[]")}}}}}'.encode(),
        b'{"fault": "pedestrian-1 was the cause"}',
        b'{"fault": ["raised"]}',
    ],
)
def test_anything_else_is_a_fault_in_our_words(line: bytes) -> None:
    with pytest.raises(FaultError) as fault:
        parse_answer(line)
    assert str(fault.value).startswith("answered ")


def test_the_words_of_a_fault_are_not_the_planners() -> None:
    told = '{"fault": "raised", "kind": "Because of pedestrian-1", "detail": "\\u001b[2J pedestrian-1"}'
    with pytest.raises(FaultError) as fault:
        parse_answer(told.encode())
    assert str(fault.value) == "raised something"
    assert "\x1b" not in fault.value.detail


def test_all_but_the_move_and_costs_is_made_here() -> None:
    for state in moments(4):
        percept = perceive_truth(state.world, state.config)
        config = state.config.with_parts(planner="priority")
        own = PriorityPlanner().decide(predict(percept, 1), config)
        answer = parse_answer(f'{{"move": "{own.move}", "costs": {{{COSTS}}}}}'.encode())
        made = decision_of(answer, percept, config)
        assert (made.tick, made.av, made.planner, made.measure) == (own.tick, own.av, "priority", Measure.OWN)
        for option in own.options:
            told = made.option(option.move)
            assert (told.cell, told.reason, told.causes) == (option.cell, option.reason, option.causes)
            assert told.cost is None or not told.reason.blocks
        costs = [option.cost for option in made.options if option.cost is not None]
        assert costs == sorted(costs)


@pytest.fixture
def installed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    faulty_planners.package(str(tmp_path), HOSTILE, "hostile")
    faulty_planners.package(str(tmp_path), POSING, "posing")
    monkeypatch.syspath_prepend(str(tmp_path))
    planner_names.forget_installed()
    yield
    planner_names.forget_installed()


@pytest.mark.usefixtures("installed")
@pytest.mark.parametrize(
    ("name", "promise"),
    [
        ("never", "prompt"),
        ("dies", "answers"),
        ("raises-base", "answers"),
        ("pours", "answers"),
        ("nan", "legal"),
        ("poses", "itself"),
        ("blames", "honest"),
        ("lies", "honest"),
        ("leaves", "legal"),
    ],
)
def test_whatever_a_planner_does_the_checker_ends_and_finds_it(name: str, promise: str) -> None:
    told: list[str] = []
    report = check_apart(name, 120.0, moments(2), told.append)
    assert promise in {defect.promise for defect in report.defects}
    assert told[0] == "road 1, tick 0: 0 decisions, 0 defects"


@pytest.mark.usefixtures("installed")
def test_names_of_ours_are_not_to_be_had() -> None:
    assert set(planner_names.installed()) == set(HOSTILE)
    assert "name is one of Roadtalk's own" in name_conflicts("astar")[0].what
    assert "name is one of Roadtalk's own" in name_conflicts("AStar")[0].what
    assert name_conflicts("never") == []


@pytest.mark.usefixtures("installed")
def test_what_a_package_claims_of_its_planner_is_not_believed() -> None:
    assert any(getattr(kind, "traits", UNKNOWN).local for kind in HOSTILE.values())
    assert {traits_of(name) for name in HOSTILE} == {UNKNOWN}
    assert traits_of("astar") != UNKNOWN  # whoever else asks for the name
