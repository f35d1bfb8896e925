"""What a line of the driving log means, by the example of the latest move's."""

from __future__ import annotations

from collections.abc import Callable

from service.narration.answer_length import Part, within
from service.narration.answerer import Json, plain
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.plan import Decision
from sim.state import SimState

Line = Callable[[Decision, SimState], str]
"""What the log says of a decision taken in a state."""


class LogLines:
    """Answers to "what does a line of the log mean?"."""

    def __init__(self, sayings: Sayings, line: Line | None = None) -> None:
        """`sayings`: the language's; `line`: the log's words for a decision; without, none is told."""
        self._sayings = sayings
        self._line = line

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        timeline = asked.timeline
        world = timeline.state.world
        tick = (timeline.tick if world.ended is None else world.ended) - 1
        line = None
        if self._line is not None and tick >= world.episode_start:
            state = timeline.at(tick)
            decision = timeline.decided(state)
            line = None if decision is None else self._line(decision, state)
        told = [Part(0, self._say("begins"))]
        if line is None:
            told.append(Part(1, self._say("no_move")))
        else:
            text = self._sayings.quoted(line)
            told.append(Part(1, self._say("latest", tick=tick, line=text)))
        told += [Part(2, self._say("others")), Part(1, self._say("no_warnings"))]
        facts: Json = {"what": asked.ask.what, "line": line, "line_tick": None if line is None else tick}
        return plain(self._sayings, asked.ask, timeline.state, within(told)) | facts

    def _say(self, key: str, **parts: object) -> str:
        return self._sayings.say("log_lines", key, **parts)
