"""The metamorphic suite: a planner with a defect breaks the relation that is for it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from typer.testing import CliRunner

from service.cli.main import cli
from sim.config import Config
from sim.evaluate.metamorphic import RELATIONS, check_relations, drive_of, mirrored, mirrored_move
from sim.forecast import Forecast
from sim.plan import Decision
from sim.plan.astar import AStarPlanner
from sim.plan.registry import planner_named, register
from sim.state import SimState
from sim.types import Kind, Move, kind_of
from sim.world.notation import read

ROADS = 20


def waits(decision: Decision) -> Decision:
    return replace(decision, move=Move.STAY)


class OnlyToTheLeft(AStarPlanner):
    """It never goes right."""

    name = "only-to-the-left"

    def decide(self, forecast: Forecast, config: Config) -> Decision:
        taken = super().decide(forecast, config)
        return waits(taken) if "right" in taken.move.value else taken


class CountsPotholes(AStarPlanner):
    """It stands still while the number of potholes is odd, wherever they are."""

    name = "counts-potholes"

    def decide(self, forecast: Forecast, config: Config) -> Decision:
        taken = super().decide(forecast, config)
        holes = sum(kind_of(id) is Kind.POTHOLE for id in forecast.percept.hazards.values())
        return waits(taken) if holes % 2 else taken


class LooksBack(AStarPlanner):
    """It waits for barriers behind it."""

    name = "looks-back"

    def decide(self, forecast: Forecast, config: Config) -> Decision:
        taken = super().decide(forecast, config)
        hazards = forecast.percept.hazards.items()
        behind = any(kind_of(id) is Kind.BARRIER and cell > forecast.ego for cell, id in hazards)
        return waits(taken) if behind else taken


class TooMuchToSee(AStarPlanner):
    """It stands still when it sees more than a dozen cars."""

    name = "too-much-to-see"

    def decide(self, forecast: Forecast, config: Config) -> Decision:
        taken = super().decide(forecast, config)
        return waits(taken) if len(forecast.percept.movers) > 12 else taken


BROKEN = {"mirror": OnlyToTheLeft, "pothole": CountsPotholes, "unreachable": LooksBack, "sight": TooMuchToSee}


@pytest.fixture(autouse=True)
def registered() -> None:
    for planner in BROKEN.values():
        if planner_named(planner.name) is None:
            register(planner())


@pytest.mark.parametrize("relation", RELATIONS)
def test_a_defect_is_found_by_its_relation_with_a_counterexample(relation: str) -> None:
    found = {each.name: each for each in check_relations(BROKEN[relation].name, ROADS)}
    assert found[relation].findings, relation
    for finding in found[relation].findings:
        assert finding.what[0].isupper()
        assert finding.what.endswith(".")
        one, other = read(finding.road), read(finding.other)
        if relation == "mirror":
            assert mirrored(one) == other
        elif relation == "sight":
            assert one == other
        else:
            kind = Kind.POTHOLE if relation == "pothole" else Kind.BARRIER
            assert other.board(kind).bit_count() == one.board(kind).bit_count() + 1


@pytest.mark.parametrize("planner", ["rules", "astar", "dijkstra", "bfs"])
def test_built_in_planners_keep_all_relations(planner: str) -> None:
    for relation in check_relations(planner, ROADS):
        assert relation.tried >= ROADS // 3
        assert relation.findings == ()


def test_the_priority_planner_prefers_a_side_and_that_is_found() -> None:
    found = {each.name: each for each in check_relations("priority", 40)}
    assert [finding.seed for finding in found["mirror"].findings] == [27, 35]
    for finding in found["mirror"].findings:
        config = Config(seed=finding.seed, planner="priority")
        ends = [drive_of(SimState.start(config, read(road))) for road in (finding.road, finding.other)]
        assert ends[0].arrived is not ends[1].arrived
        images = [mirrored_move(move) for move in ends[1].moves]
        assert list(ends[0].moves[: finding.tick]) == images[: finding.tick]
        assert ends[0].moves[finding.tick] is not images[finding.tick]
    assert not any(found[name].findings for name in ("pothole", "unreachable", "sight"))


def test_a_mirror_image_of_a_mirror_image_is_the_road() -> None:
    world = SimState.start(Config(seed=3, pedestrians=3, barriers=2)).world
    assert mirrored(mirrored(world)) == world
    assert mirrored(world) != world
    assert [mirrored_move(mirrored_move(move)) for move in Move] == list(Move)


def test_the_command_tells_findings_and_keeps_its_exit_status(tmp_path: Path) -> None:
    args = ["check-planner", "priority", "--relations", "--roads", "28", "--worlds", str(tmp_path)]
    answer = CliRunner().invoke(cli, args)
    assert answer.exit_code == 0, answer.output
    assert "held on 27 of 28 roads" in answer.output
    assert "seed 27, tick 2: It arrives after 38 ticks" in answer.output
    assert (tmp_path / "mirror-27.txt").read_text().count("road 8x30") == 2
