"""How long an episode may last. Compiled as well (`sim.batch.compiled`)."""

from __future__ import annotations


def max_ticks(rows: int) -> int:
    """The ticks of an episode on a road of so many rows; one that lasts longer is STUCK."""
    return 10 * rows


def steps_left(rows: int, episode_tick: int) -> int:
    """How many steps an episode may still take: arriving is judged before being stuck."""
    return max(0, max_ticks(rows) + 1 - episode_tick)
