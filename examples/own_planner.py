"""A planner of your own, checked and driven: python examples/own_planner.py"""

from sim.config import Config
from sim.forecast import Forecast
from sim.plan import Decision, Option, Traits, register
from sim.plan.conformance import check
from sim.state import SimState
from sim.transition import step
from sim.types import Move, Outcome

ORDER = (Move.FORWARD, Move.STAY, Move.LEFT, Move.RIGHT, Move.FORWARD_LEFT, Move.FORWARD_RIGHT)


class Patient:
    """Drives forward if that is free, waits otherwise, and steps aside only if waiting would crash."""

    name = "patient"
    traits = Traits(local=True, forward_only=True, plans_to_goal=False, work=1)

    def horizon(self, config: Config) -> int:
        """Reads one tick of forecast."""
        return 1

    def decide(self, forecast: Forecast, config: Config) -> Decision:
        """Takes the first move in `ORDER` that is not blocked."""
        options = []
        for rank, move in enumerate(ORDER):
            end = forecast.road.moved(forecast.ego, move)
            reason, causes = forecast.check_step(forecast.ego, end)
            cell = None if end is None else forecast.road.cell(end)
            options.append(Option(move, cell, reason, None if reason.blocks else float(rank), causes))
        move = next((option.move for option in options if not option.reason.blocks), Move.STAY)
        return Decision(forecast.tick, forecast.ego_id, self.name, move, tuple(options))


if __name__ == "__main__":
    report = check(Patient())
    print(f"{report.decisions} decisions checked, {len(report.defects)} defects")

    register(Patient())
    arrived = 0
    for seed in range(20):
        state = SimState.start(Config(seed=seed, potholes=4, vehicles=6, planner="patient"))
        while state.world.outcome is Outcome.RUNNING:
            state = step(state).state
        arrived += state.world.outcome is Outcome.SUCCESS
    print(f"arrived on {arrived} of 20 roads")
