"""What is told of the road ahead holds for vehicles that go more than a cell a tick."""

from __future__ import annotations

import pytest

from service.actions import Ask
from service.narration import Narrator
from service.sessions.facts import Asked
from sim.config import CHOICES
from sim.explain.scene import describe_percept
from sim.perceive import perceive_truth
from sim.rules.dynamics import Dynamics, Swept
from sim.rules.dynamics_registry import DYNAMICS
from sim.rules.grid_dynamics import GridDynamics
from sim.session.timeline import Timeline
from sim.types import Move
from tests.support.roads import road, run_on


class TwoRows(Dynamics):
    """Forward two rows a tick, into row 0 at most; all other moves are the grid's."""

    name = "two_rows"
    rows_a_tick = 2

    def step(self, cell: int, move: Move) -> tuple[int, Swept] | None:
        found = GridDynamics(self.road, bodies=self.bodies).step(cell, move)
        if found is None or move is not Move.FORWARD or found[0] < self.road.columns:
            return found
        end = found[0] - self.road.columns
        return end, Swept((end, found[0]))


@pytest.fixture(autouse=True)
def _two_rows(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(DYNAMICS, "two_rows", TwoRows)  # type: ignore[arg-type]
    monkeypatch.setitem(CHOICES, "dynamics", ("grid", "two_rows"))


def test_the_scene_tells_in_how_many_ticks_things_are_met() -> None:
    world = road("....", "o...", "....", "....", ".o..", "....", "....", ".A..")
    state = run_on(world, dynamics="two_rows", visible_rows=6)
    scene = describe_percept(perceive_truth(state.world, state.config), state.config)
    assert {thing.id: thing.ticks for thing in scene.seen} == {"pothole-1": None, "pothole-2": 2}


@pytest.mark.parametrize("dynamics", ["grid", "two_rows"])
def test_what_comes_next_is_told_in_metres(dynamics: str) -> None:
    state = run_on(road("....", "....", "....", "....", "....", ".A.."), dynamics=dynamics, visible_rows=5)
    told = Narrator.load().answer(Asked(Ask(about="next"), Timeline(state.config, state)))
    assert told["text"] == "Next I go forward 25 m, and then I am there."
    scene = Narrator.load().answer(Asked(Ask(about="scene"), Timeline(state.config, state)))
    assert scene["text"]
