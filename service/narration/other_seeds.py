"""Answers to "would it have gone better with another seed?": roads that are drawn alike, each driven once."""

from __future__ import annotations

from service.narration.answerer import Json, not_so, plain
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain.other_seeds import OtherSeeds as Found
from sim.explain.other_seeds import other_seeds
from sim.explain.question_error import QuestionError
from sim.types import Outcome


class OtherSeeds:
    """Answers about the roads of other seeds."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, timeline = asked.ask, asked.timeline
        try:
            found = other_seeds(timeline)
        except QuestionError as error:
            return plain(self._sayings, ask, timeline.state, not_so(self._sayings, error.code, error.facts))
        facts = {
            "what": ask.what,
            "seeds": list(range(found.first, found.last + 1)),
            "outcomes": [str(each) for each in found.outcomes],
        }
        return (
            plain(self._sayings, ask, timeline.state, self._text(found, timeline.state.world.outcome)) | facts
        )

    def _text(self, found: Found, here: Outcome) -> str:
        """How many ended in each way, then how this drive has ended."""
        parts = [
            self._say(str(outcome), count=found.counts[outcome])
            for outcome in (Outcome.SUCCESS, Outcome.CRASH, Outcome.STUCK, Outcome.RUNNING)
            if found.counts[outcome]
        ]
        told = self._say(
            "told",
            planner=self._sayings.planner(found.planner),
            count=len(found.outcomes),
            first=found.first,
            last=found.last,
            parts=self._sayings.joined(parts),
        )
        ended = "" if here is Outcome.RUNNING else self._say("here", str(here))
        return f"{told} {ended}".strip()

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("whatif", "other_seeds", *keys, **parts)
