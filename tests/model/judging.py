"""Ticks judged by the slow twin of `tests.sim`: the world moved by its rules, nobody drove into anything."""

from __future__ import annotations

from dataclasses import replace

from sim.state import SimState
from sim.transition import step
from sim.types import Mode, Outcome
from tests.model.compare import holds, same
from tests.model.plain import Plain
from tests.support import twin
from tools.twin_run import braking, courteous

LOCAL = ("priority", "rules")
"""Planners that see the vehicle's row and the one ahead, and so may be seen to repeat themselves."""


class Judge:
    """Looks at each tick once."""

    def __init__(self) -> None:
        self._seen: set[tuple[object, ...]] = set()
        self._looked: dict[tuple[object, ...], int] = {}
        self.ticks = 0

    def look(self, plain: Plain) -> None:
        """All ticks of a session that were not seen yet."""
        way = plain.config, plain.stand.log
        begun = self._looked.get(way, 0)
        self._looked[way] = max(begun, plain.tick)
        for run in plain.runs[begun : plain.tick]:
            key = run.config, run.world.digest(), run.mode, run.queue, run.watch
            if key not in self._seen and run.world.outcome is Outcome.RUNNING:
                self._seen.add(key)
                self._tick(run, plain.runs[: run.world.tick + 1])

    def _tick(self, run: SimState, runs: list[SimState]) -> None:
        """One tick; `runs`: all states up to it."""
        self.ticks += 1
        now = twin.position(run.world)
        yielding, brakes, swept = courteous(run), braking(run), run.config.collision == "swept"
        later = twin.moved_bodies(now, yielding)
        tick = step(run)
        decision = tick.decision
        assert decision is not None
        free = {move: twin.outlook(now, move, later, brakes, swept=swept)[2] for move in twin.STEPS}
        where = f"tick {run.world.tick} of seed {run.config.seed} by {decision.planner}"
        if decision.asked is None:
            holds(f"{where} drives into something", free[decision.move] or not any(free.values()), decision)
        if run.config.planner == "priority" and decision.asked is None:
            same(f"{where}, the rule", decision.move, twin.priority_move(now, later, brakes, swept=swept))
        _, after = twin.step(now, decision.move, yielding, brakes, swept=swept)
        if tick.state.world.outcome is Outcome.STUCK and after.outcome is Outcome.RUNNING:
            holds(f"{where}, STUCK though nothing repeats", repeated([*runs, tick.state]), after)
            after = replace(after, outcome=Outcome.STUCK)
        same(f"{where}, the world after it", twin.position(tick.state.world), after)


def repeated(runs: list[SimState]) -> bool:
    """Whether the last state is like an earlier one of its road from which the rule alone led to it."""
    last = runs[-1]
    sought = situation(last)
    for run in reversed(runs[:-1]):
        config = run.config
        if (
            not config.repetition
            or config.planner not in LOCAL
            or run.mode is not Mode.AUTO
            or config.courtesy != 0
            or config.attentive not in (0, 1)
            or run.edits != last.edits
            or run.world.episode_start != last.world.episode_start
        ):
            return False
        if situation(run) == sought:
            return True
    return False


def situation(run: SimState) -> tuple[object, ...]:
    """What has a part in what comes while the vehicle is in its row."""
    now = twin.position(run.world)
    near = frozenset(
        (body.cell, body.heading, body.walks)
        for body in now.bodies
        if body.cell[1] in (now.av[1], now.av[1] - 1)
    )
    return now.av, now.episode_tick % 2, near
