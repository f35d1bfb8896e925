"""Ticks judged by the slow twin of `tests.sim`: the world moved by its rules, nobody drove into anything."""

from __future__ import annotations

from sim.courtesy import yielding
from sim.kinds import Outcome
from sim.road import bits
from sim.run import Run, advance
from tests.model.compare import holds, same
from tests.model.plain import Plain
from tests.sim import twin


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
            key = run.config, run.world.digest(), run.mode, run.queue
            if key not in self._seen and run.world.outcome is Outcome.RUNNING:
                self._seen.add(key)
                self._tick(run)

    def _tick(self, run: Run) -> None:
        self.ticks += 1
        now = twin.position(run.world)
        courteous = {run.world.road.cell(cell) for cell in bits(yielding(run.world, run.config))}
        later = twin.moved_bodies(now, courteous)
        tick = advance(run)
        decision = tick.decision
        assert decision is not None
        free = {
            move: twin.will_be_free(now, later, (now.av[0] + column, now.av[1] + row))
            for move, (column, row) in twin.STEPS.items()
        }
        where = f"tick {run.world.tick} of seed {run.config.seed} by {decision.planner}"
        if decision.asked is None:
            holds(f"{where} drives into something", free[decision.move] or not any(free.values()), decision)
        if run.config.planner == "priority" and decision.asked is None:
            same(f"{where}, the rule", decision.move, twin.priority_move(now, later))
        _, after = twin.step(now, decision.move, courteous)
        same(f"{where}, the world after it", twin.position(tick.run.world), after)
