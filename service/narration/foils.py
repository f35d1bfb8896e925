"""Answers about the foil that a person gives: one move instead of another, and where that would have led."""

from __future__ import annotations

from service.contract.encode.explanation import explanation_json
from service.contract.encode.past import move_json
from service.narration.answer_length import MOST_WORDS, Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.charges import in_seconds, likely
from service.narration.explanation import Explained
from service.narration.naming import Naming
from service.narration.options import Options
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain import QuestionError
from sim.explain.other_move import OtherMove, had_moved
from sim.explain.query import contrast


class Foils:
    """Answers to "why left instead of right?" and "what if you had gone straight?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings
        self._explained = Explained(sayings)
        self._options = Options(sayings)

    def contrasted(self, asked: Asked) -> Json:
        """Why one move was made and not the other."""
        ask, timeline = asked.ask, asked.timeline
        assert ask.instead is not None
        try:
            found = contrast(timeline, ask.move, ask.instead, ask.tick)
        except QuestionError as error:
            return plain(self._sayings, ask, timeline.state, not_so(self._sayings, error.code, error.facts))
        chosen = found.decision.chosen
        did = self._sayings.move(found.decision.move, "did")
        reason = self._sayings.met(chosen, "then", Naming(self._sayings, found.moment))
        blocked = found.decision.option(ask.instead).reason.blocks and not chosen.reason.blocks
        text = within(
            [
                Part(0, self._explained.text(found, now=timeline.tick if ask.tick is None else None)),
                Part(1, self._say("rather", did=did, reason=reason) if blocked else ""),
            ]
        )
        told = explanation_json(found, self._options.texts(found.decision))
        return plain(self._sayings, ask, timeline.state, text) | told

    def supposed(self, asked: Asked) -> Json:
        """What another move would have led to."""
        ask, timeline = asked.ask, asked.timeline
        assert ask.move is not None
        try:
            found = had_moved(timeline, ask.move, ask.tick)
        except QuestionError as error:
            text = not_so(self._sayings, "no_cell" if error.code == "off_road" else error.code, error.facts)
            return plain(self._sayings, ask, timeline.state, text)
        told = plain(self._sayings, ask, timeline.state, self.text(found, timeline.tick))
        return told | move_json(found)

    def text(self, found: OtherMove, now: int) -> str:
        """A move that was not made, and where it would have led."""
        explanation = found.explanation
        decision, stakes = explanation.decision, found.stakes
        suppose = self._say(
            "suppose",
            did=self._sayings.move(stakes.foil, "did"),
            doing=self._sayings.move(decision.move, "doing"),
            tick=decision.tick,
            seconds=in_seconds(self._sayings, now - decision.tick, explanation.moment.config),
        )
        would = self._explained.would(explanation) or self._say("would_unknown")
        since = self._say("said_since") if found.said_since else ""
        return within([Part(0, suppose), Part(0, would), Part(1, since)], MOST_WORDS)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("past", *keys, **parts)


def chance_told(sayings: Sayings, found: OtherMove) -> tuple[str, str]:
    """How likely it is to arrive by the move, and as it is."""
    stakes = found.stakes
    return likely(sayings, stakes.would_chances), likely(sayings, stakes.real_chances)
