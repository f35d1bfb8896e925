"""What a sentence may ask of the road as it is while it is said: "double the cars", "rain for 10 ticks"."""

from __future__ import annotations

from sim.state import SimState
from sim.types import Kind


class Present:
    """The present state of one session, as sentences see it."""

    def __init__(self, state: SimState) -> None:
        self._state = state

    def count(self, kind: str) -> int:
        """How many things of a kind are on the road."""
        return self._state.world.count(Kind(kind))

    def value(self, parameter: str) -> int | float | str | None:
        """The value of a setting; None where it has none that can be set."""
        found = getattr(self._state.config, parameter, None)
        return found if isinstance(found, int | float | str) else None
