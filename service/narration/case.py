"""Why a planner fails a case, in words: what happens, on what little road, and what would have saved it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

from service.actions import Ask
from service.narration.blame import Blames
from service.narration.crash import Crashes
from service.narration.episode_end import Ends
from service.narration.falsification import FalsificationWords
from service.narration.inflection import capital
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain.crash import why_crashed
from sim.falsify import Case
from sim.session.timeline import Timeline
from sim.types import Outcome

NAMED: Final = 6
"""Things up to which each is told with its place."""


class CaseWords:
    """Cases in one language."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings
        self._words = FalsificationWords(sayings)

    def why(self, case: Case, facts: Mapping[str, Any]) -> str:
        """A case in a few sentences; `facts`: as in the result of a search."""
        timeline = Timeline(case.config, case.start)
        while timeline.state.world.outcome is Outcome.RUNNING:
            timeline.advance()
        told = [
            self._say("planner", planner=self._sayings.planner(case.config.planner)),
            *(self._crash(timeline) if case.outcome is Outcome.CRASH else self._stuck(timeline, facts)),
            self._say("needed", "one" if len(case.things) == 1 else "many", things=self._things(case)),
            self._say("drivable", ticks=len(case.way)),
        ]
        if facts["arrive"]:
            names = self._sayings.joined([self._sayings.planner(name) for name in facts["arrive"]])
            told.append(self._say("others", planners=names))
        return " ".join(told)

    def _crash(self, timeline: Timeline) -> list[str]:
        """What was hit and what would have saved it, and whose fault it was."""
        fault = Blames(self._sayings).answer(Asked(Ask(about="blame", what="fault"), timeline))
        return [Crashes(self._sayings).text(why_crashed(timeline)), str(fault["text"])]

    def _stuck(self, timeline: Timeline, facts: Mapping[str, Any]) -> list[str]:
        told = [capital(Ends(self._sayings).text(timeline.state))]
        pattern, thing = facts["pattern"], facts["thing"]
        if pattern in ("swinging", "waiting"):
            behind = (
                "" if thing is None else self._say("behind", thing=self._sayings.say("words", "a", thing))
            )
            told.append(self._say("pattern", pattern, behind=behind))
        return told

    def _things(self, case: Case) -> str:
        if len(case.things) > NAMED:
            return self._words.things(list(case.things))
        found = [case.world.find(name) for name in case.things]
        return self._sayings.listed(
            [
                self._say(
                    "at", thing=self._sayings.things(thing.kind, 1), where=self._sayings.where(thing.cell)
                )
                for thing in found
                if thing is not None
            ]
        )

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("falsification", "why", *keys, **parts)
