"""Answers to how, when and where a drive ended."""

from __future__ import annotations

from service.narration.answer_length import Part, within
from service.narration.answerer import Json, plain
from service.narration.charges import in_seconds
from service.narration.episode_end import Ends
from service.narration.inflection import capital
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Outcome


class DriveEnds:
    """Answers to "at which tick did we crash, and in which row?", "how did the drive end?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings
        self._ends = Ends(sayings)

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`. While a drive goes on, that is told, and how the one before it ended."""
        timeline = asked.timeline
        state, before = timeline.state, _drive_before(timeline)
        over = state.world.outcome is not Outcome.RUNNING
        told = [Part(0, self._over(state) if over else self._going_on(state))]
        if not over and before is not None:
            outcome = self._sayings.say("answers", "outcomes", before.world.outcome)
            told.append(Part(1, self._say("before", tick=before.world.ended, outcome=outcome)))
        shown = state if over or before is None else before
        return plain(self._sayings, asked.ask, state, within(told)) | {"what": "end"} | _json(shown)

    def _going_on(self, state: SimState) -> str:
        return self._say("going_on", tick=state.world.tick, where=self._where(state))

    def _over(self, state: SimState) -> str:
        """When, how and where."""
        world = state.world
        tick = world.tick if world.ended is None else world.ended
        ticks = tick - world.episode_start
        seconds = in_seconds(self._sayings, ticks, state.config)
        when = self._say("when", "one" if ticks == 1 else "many", tick=tick, ticks=ticks, seconds=seconds)
        how = capital(self._ends.text(state))
        return f"{when} {how} {self._say('there', where=self._where(state))}"

    def _where(self, state: SimState) -> str:
        world = state.world
        column, row = world.road.cell(world.av)
        if not row:
            return self._say("where", "goal", lane=column + 1)
        metres = self._sayings.number(row * state.config.cell_m)
        return self._say("where", "before", lane=column + 1, rows=row, metres=metres)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("drive_end", *keys, **parts)


def _drive_before(timeline: Timeline) -> SimState | None:
    """The last state of the drive before, where it ended by itself."""
    start = timeline.state.world.episode_start
    if timeline.state.world.episode <= 1 or start <= 0:
        return None
    state = timeline.at(start - 1)
    return None if state.world.outcome is Outcome.RUNNING else state


def _json(state: SimState) -> Json:
    world = state.world
    column, row = world.road.cell(world.av)
    return {"outcome": world.outcome, "ended": world.ended, "lane": column + 1, "rows_to_goal": row}
