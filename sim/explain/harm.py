"""What is known of the latest crash that could have hurt somebody: who was hit, and how fast each moved.

Injuries are not simulated. A published risk of death over the speed of impact is stated for people on foot
(`sim.hazard_advice.physics.death_risk`).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot

from sim.explain.past import latest_crash
from sim.session.timeline import Timeline
from sim.types import Kind, Move, is_ego


@dataclass(frozen=True, slots=True)
class Harm:
    """A crash, as far as people are concerned."""

    tick: int
    """the tick that the crash shows at"""
    kind: Kind
    """the kind of thing that was hit"""
    ids: tuple[str, ...]
    move: Move
    """of the ego in that tick"""
    speed_kmh: float
    """of the ego in that tick"""
    other_kmh: float
    """of what was hit"""

    @property
    def person(self) -> bool:
        """Whether somebody on foot was hit."""
        return self.kind is Kind.PEDESTRIAN

    @property
    def death_risk(self) -> float | None:
        """The published risk that a person on foot dies of a hit at that speed; None for other things."""
        if not self.person:
            return None
        from sim.hazard_advice.physics import death_risk  # needs numpy, which nothing else here does

        return float(death_risk(self.speed_kmh))


def harm(timeline: Timeline) -> Harm | None:
    """The latest crash of the first ego in this session; None where there was none."""
    tick = latest_crash(timeline)
    if tick is None:
        return None
    after, before = timeline.at(tick), timeline.at(tick - 1)
    cause, decision = after.world.cause, timeline.decided(before)
    if cause is None or decision is None:
        return None
    hit = [name for name in cause.ids if not is_ego(name)] or list(cause.ids)
    cell_kmh = after.config.cell_m / after.config.step_seconds * 3.6
    moved = 0.0
    was, now = before.world.find(hit[0]), after.world.find(hit[0])
    if was is not None and now is not None:
        moved = hypot(now.cell[0] - was.cell[0], now.cell[1] - was.cell[1])
    own, other = (round(cells * cell_kmh, 1) for cells in (hypot(*decision.move.offset), moved))
    return Harm(tick, cause.kind, tuple(hit), decision.move, own, other)
