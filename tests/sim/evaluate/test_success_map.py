"""Success maps: the cells are what they are alone, and a region is told only where every interval says so."""

from __future__ import annotations

import json
from typing import Any

import pytest

from service.actions import Evaluate
from service.evaluations.report.document import make_document
from service.evaluations.report.write import write_html
from service.evaluations.request import evaluation_of
from service.narration import evaluation_words
from sim.config import Config
from sim.evaluate import Evaluation, EvaluationError
from sim.evaluate.run import evaluate
from sim.evaluate.spec import MAX_EPISODES
from sim.evaluate.success_map import cells_of, success_map

AXES = ("potholes", "vehicles")
SMALL = Config(columns=5, rows=10)


def drawn(episodes: int = 30, planner: str = "priority") -> Evaluation:
    cases = cells_of(AXES, {"potholes": (12, 0), "vehicles": (0, 6)}, SMALL)
    return Evaluation(planners=(planner,), episodes=episodes, config=SMALL, cases=cases, axes=AXES)


def shares(*rows: list[tuple[int, int]]) -> list[dict[str, Any]]:
    """The summaries of cells whose arrivals are given as (low, high) in per cent."""
    return [
        {
            "said": {"potholes": row, "vehicles": column},
            "planners": {"astar": {"arrived": {"low": low / 100, "high": high / 100}}},
        }
        for row, each in enumerate(rows)
        for column, (low, high) in enumerate(each)
    ]


def test_each_cell_is_what_an_evaluation_of_it_alone_finds() -> None:
    spec = drawn()
    found = evaluate(spec)
    assert found is not None
    assert found["map"]["values"] == [[0, 12], [0, 6]]
    for row, potholes in enumerate((0, 12)):
        for column, vehicles in enumerate((0, 6)):
            cell = found["map"]["planners"]["priority"]["cells"][row][column]
            config = SMALL.with_parts(potholes=potholes, vehicles=vehicles)
            alone = evaluate(Evaluation(planners=("priority",), episodes=30, config=config))
            assert alone is not None
            assert {**alone["planners"]["priority"]["arrived"], "case": 2 * row + column} == cell
    assert Evaluation.from_json(json.loads(json.dumps(spec.to_json()))) == spec


def test_the_region_is_the_largest_of_which_every_interval_is_above_the_limit() -> None:
    sure, likely, bad = (97, 100), (91, 99), (10, 20)
    for rows, region in (
        ([[sure, sure, bad], [sure, sure, bad], [sure, bad, bad]], (0.95, 2, 2)),
        ([[sure, sure, sure], [sure, bad, bad], [bad, bad, bad]], (0.95, 1, 3)),
        ([[likely, likely], [likely, sure]], (0.9, 2, 2)),
        ([[sure, likely], [likely, bad]], (0.95, 1, 1)),
        ([[(95, 99), bad], [bad, bad]], (0.9, 1, 1)),  # not above 95 %
    ):
        found = success_map(AXES, ["astar"], shares(*rows))["planners"]["astar"]["region"]
        assert found == dict(zip(("above", "rows", "columns"), region, strict=True))
    assert success_map(AXES, ["astar"], shares([bad, sure]))["planners"]["astar"]["region"] is None


def test_the_report_begins_with_the_region_and_its_cells_lead_to_episodes() -> None:
    spec = drawn()
    found = evaluate(spec)
    assert found is not None
    words = evaluation_words("en")
    first = words.paragraphs(spec, found)[0]
    region = found["map"]["planners"]["priority"]["region"]
    assert first.startswith(f"Priority rules arrives in more than {100 * region['above']:g} % of runs with")
    document = make_document(spec, found, words, "en")
    table = document.tables[0]
    assert [cell.text for cell in table.rows[0]][1:] == ["0", "6"]
    names = {cell.name for each in document.tables for row in each.rows for cell in row}
    links = [cell.link for row in table.rows[1:] for cell in row[1:]]
    assert len(links) == 4
    assert all(link is not None and link.removeprefix("#") in names for link in links)
    if document.plots:
        page = write_html(document, words)
        assert all(page.count(f'"{link}"') >= 2 for link in links)  # the heat map and the table


def test_a_road_has_round_levels_for_its_size_where_none_are_given() -> None:
    spec = evaluation_of(Evaluate(map=AXES, runs=2), Config())
    assert {case.said["potholes"] for case in spec.cases} == {0, 10, 20, 30, 40, 50}
    assert (spec.total, len(spec.parts())) == (72, 36)
    small = evaluation_of(Evaluate(map=("barriers", "pedestrians"), runs=2), SMALL)
    assert {case.said["barriers"] for case in small.cases} == {0, 1, 2, 3, 4, 5}


@pytest.mark.parametrize(
    ("vary", "runs", "field"),
    [
        ({"potholes": (10,)}, 5, "levels"),
        ({"potholes": ()}, 5, "levels"),
        ({"potholes": tuple(range(13))}, 5, "levels"),
        ({"barriers": (0, 1)}, 5, "vary"),
        ({"potholes": (0, 10_000)}, 5, "potholes"),
        ({}, MAX_EPISODES // 36 + 1, "episodes"),
    ],
)
def test_maps_without_cells_and_huge_ones_are_refused_before_they_begin(
    vary: dict[str, Any], runs: int, field: str
) -> None:
    from service.actions import Varied

    with pytest.raises(EvaluationError) as refused:
        evaluation_of(Evaluate(map=AXES, runs=runs, vary=Varied(**vary)), Config())
    assert [each.field for each in refused.value.problems] == [field]
    with pytest.raises(EvaluationError):
        evaluation_of(Evaluate(map=("potholes", "potholes"), runs=2), Config())
