"""The safest move: none that is told before another is less safe."""

from __future__ import annotations

from sim.config import Config
from sim.explain.safe_move import safe_move
from sim.explain.safest_moves import safest_moves
from sim.session.timeline import Timeline
from sim.types import Move


def test_a_safe_move_comes_before_one_that_crashes() -> None:
    for seed in range(6):
        timeline = Timeline(Config(seed=seed, vehicles=70, potholes=20, pedestrians=4))
        for _ in range(5):
            timeline.advance()
        if timeline.state.world.ended is not None:
            continue
        found = safest_moves(timeline)
        assert {each.move for each in found} == set(Move)
        crashes = [1.0 if each.then is None else each.then.crashes for each in found if not each.off_road]
        assert crashes == sorted(crashes)
        assert found[0].safe or not any(safe_move(timeline, move).safe for move in Move)
