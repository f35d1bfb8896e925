"""Where the vehicle is, and what can be said: answers that need nothing run again."""

from __future__ import annotations

from typing import Final

from service.narration.answerer import Json, plain
from service.narration.next import Next
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.state import SimState
from sim.types import Mode, Outcome

_AFTER: Final = ("arrived",)
"""What stands before where the ego is, rather than in its place."""


class Status:
    """Answers to "where are you?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        run = asked.timeline.state
        told = self._status(run)
        if asked.supposes in _AFTER:
            told = f"{self._aspect(asked, asked.supposes)} {told}"
        elif asked.supposes is not None:
            told = self._aspect(asked, asked.supposes)
        return plain(self._sayings, asked.ask, run, told)

    def _aspect(self, asked: Asked, aspect: str) -> str:
        """One thing alone that was asked for: the tick, the time, the lanes, whether it has arrived."""
        run = asked.timeline.state
        world, columns = run.world, run.world.road.columns
        lane = world.road.cell(world.av)[0] + 1
        ticks = (world.tick if world.ended is None else world.ended) - world.episode_start
        facts = {
            "tick": world.tick,
            "ticks": ticks,
            "seconds": self._sayings.number(ticks * run.config.step_seconds),
            "episode": world.episode,
            "lane": lane,
            "columns": columns,
            "left": lane - 1,
            "right": columns - lane,
        }
        if aspect == "arrived":
            agreed = world.outcome is Outcome.SUCCESS
            return self._sayings.say("ahead", "answer", "agree" if agreed else "disagree") + "."
        form = {
            "paused": ("yes" if asked.paused else "no",),
            "running": ("no" if asked.paused else "yes",),
            "time": ("now" if world.outcome is Outcome.RUNNING else "ended",),
        }.get(aspect, ())
        return self._sayings.say("answers", f"status_{aspect}", *form, **facts)

    def _status(self, run: SimState) -> str:
        world = run.world
        column, row = world.road.cell(world.av)
        rows = self._sayings.say("answers", "rows", "one" if row == 1 else "many", count=row)
        place = {"lane": column + 1, "rows": rows, "metres": self._sayings.number(row * run.config.cell_m)}
        if world.outcome is not Outcome.RUNNING:
            outcome = self._sayings.say("answers", "outcomes", world.outcome)
            return self._say("status_ended" if row else "status_arrived", outcome=outcome, **place)
        told = self._say("status", **place)
        return f"{told} {self._say('status_manual')}" if run.mode is Mode.MANUAL else told

    def _say(self, key: str, **parts: object) -> str:
        return self._sayings.say("answers", key, **parts)


class Help:
    """Answers to "what can I say?"; to a person who drives, with what to do next."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings
        self._next = Next(sayings)

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        way = self._next.advice(asked.timeline.state)
        if way:
            text = self._sayings.say("answers", "help_driving", way=way)
            return plain(self._sayings, asked.ask, asked.timeline.state, text)
        examples = self._sayings.joined(
            [self._sayings.quoted(example) for example in self._sayings.examples()]
        )
        text = self._sayings.say("answers", "help", examples=examples)
        return plain(self._sayings, asked.ask, asked.timeline.state, text)
