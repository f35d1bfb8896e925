"""What a planner prefers may hang on something: one that orders the moves anew each time."""

from __future__ import annotations

import pytest

from service.actions import Ask
from service.narration import Narrator
from service.sessions.facts import Asked
from sim import planner_names
from sim.config import Config
from sim.forecast import Forecast
from sim.plan import Decision, Option, Traits, register, registry
from sim.session.timeline import Timeline
from sim.types import MOVES, Move
from tests.support.roads import road, run_on


class TwoAhead:
    """Straight on if there is nothing two cells ahead; else aside first."""

    name = "two_ahead"
    traits = Traits(forward_only=True, plans_to_goal=False, work=1)

    def horizon(self, config: Config) -> int:  # noqa: ARG002
        return 2

    def decide(self, forecast: Forecast, config: Config) -> Decision:  # noqa: ARG002
        beyond = forecast.ego - 2 * forecast.road.columns
        move = Move.LEFT if forecast.fixed >> beyond & 1 else Move.FORWARD
        options = []
        for rank, each in enumerate(sorted(MOVES, key=lambda other: other is not move)):
            end = forecast.dynamics.target(forecast.ego, each)
            reason, causes = forecast.check_step(forecast.ego, end)
            cell = None if end is None else forecast.road.cell(end)
            options.append(Option(each, cell, reason, None if reason.blocks else float(rank), causes))
        return Decision(forecast.tick, forecast.ego_id, self.name, move, tuple(options))


def test_what_a_first_choice_hangs_on_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(planner_names, "_registered", list(planner_names._registered))
    monkeypatch.setattr(registry, "_planners", dict(registry._planners))
    monkeypatch.setattr(registry, "_traits", dict(registry._traits))
    register(TwoAhead())
    world = road("........", "...o....", "........", "...A....", "........")
    config = run_on(world, planner="two_ahead").config
    timeline = Timeline(config, run_on(world, planner="two_ahead"))
    timeline.advance()
    told = Narrator.load().answer(Asked(Ask(about="why", tick=0), timeline))
    assert [cause["id"] for cause in told["causes"]] == ["pothole-1"]
    assert told["text"] == (
        "At tick 0 I moved left: that is my first choice, and the cell to my left was free. "
        "Without the pothole 10 m ahead I would go forward."
    )
