"""Answers that are the same in every drive, or for each planner, sensor or the like: "do you oscillate?"."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, Final

from service.narration.answerer import Json, plain
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.state import SimState

OTHERWISE: Final = "else"
"""The key of what is said where no other text fits."""

DEPENDS: Final[Mapping[str, Callable[[SimState], str]]] = {
    "planner": lambda state: str(state.config.planner),
    "sensor": lambda state: str(state.config.sensor),
    "weather": lambda state: state.config.weather,
    "time_of_day": lambda state: state.config.time_of_day,
    "mode": lambda state: state.mode.value,
    "outcome": lambda state: state.world.outcome.value,
}
"""What an answer may depend on, and its value in a session."""


class Facts:
    """Answers to questions about what is always so."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        fact, state = str(asked.ask.fact), asked.timeline.state
        texts: str | Mapping[str, Any] = self._sayings.words("facts", fact, "text")
        keys = ["text"]
        if not isinstance(texts, str):
            value = DEPENDS[texts["by"]](state)
            keys.append(value if value in texts else OTHERWISE)
        return plain(self._sayings, asked.ask, state, self._sayings.say("facts", fact, *keys)) | {
            "fact": fact
        }
