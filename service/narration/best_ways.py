"""Answers to "what would have been the best way from the start?": the quickest way, as a course in words."""

from __future__ import annotations

from typing import Final

from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.charges import in_seconds
from service.narration.move_list import MOST_RUNS, way_told
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain.best_way import BestWay, best_way
from sim.explain.question_error import QuestionError
from sim.types import Outcome

LANE: Final = "lane"
"""What a question supposes that asks for the lane."""


class BestWays:
    """Answers about the quickest way that meets nothing."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, state = asked.ask, asked.timeline.state
        try:
            found = best_way(asked.timeline, here=ask.about == "outlook")
        except QuestionError as error:
            told = not_so(self._sayings, error.code, error.facts)
            return plain(self._sayings, ask, state, told) | {"what": ask.what}
        text = within(self._told(found, lane_first=asked.supposes == LANE))
        return plain(self._sayings, ask, state, text) | {"what": ask.what} | _json(found)

    def _told(self, found: BestWay, *, lane_first: bool) -> list[Part]:
        """The moves, or the lanes first where they are asked for; then how this drive went."""
        where = "here" if found.here else "start"
        changed = Part(1, self._say("changed") if found.changed else "")
        if found.plan is None:
            key = "no_way" if found.known else "unknown"
            return [Part(0, self._say(key, where)), changed]
        if not found.plan:
            return [Part(0, self._say("at_goal"))]
        way = self._say(
            "way",
            where,
            "one" if len(found.plan) == 1 else "many",
            moves=way_told(self._sayings, found.plan),
            count=len(found.plan),
            seconds=in_seconds(self._sayings, len(found.plan), found.start.config),
        )
        lanes = self._lanes(found)
        parts = [Part(0, lanes), Part(0, way)] if lane_first else [Part(0, way), Part(1, lanes)]
        return [*parts, Part(1, self._really(found)), changed, Part(2, self._say("measure"))]

    def _lanes(self, found: BestWay) -> str:
        """The lanes that it goes through, in their order."""
        lanes = [str(column + 1) for column in found.columns]
        if len(lanes) == 1:
            return self._say("lanes", "one", lane=lanes[0])
        if len(lanes) > MOST_RUNS:
            return self._say("lanes", "most", first=", ".join(lanes[:MOST_RUNS]), last=lanes[-1])
        return self._say("lanes", "many", lanes=", ".join(lanes))

    def _really(self, found: BestWay) -> str:
        """How the drive itself went, where it has ended."""
        drive = found.drive
        if found.here or drive.outcome is Outcome.RUNNING:
            return ""
        seconds = in_seconds(self._sayings, drive.ticks, found.start.config)
        return self._say("really", str(drive.outcome), seconds=seconds)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("best_way", *keys, **parts)


def _json(found: BestWay) -> Json:
    return {
        "from": found.start.world.tick,
        "known": found.known,
        "plan": None if found.plan is None else list(found.plan),
        "lanes": [column + 1 for column in found.columns],
        "changed": found.changed,
    }
