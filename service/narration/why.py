"""Answers to why and why not: the explanation's facts as JSON values, and in words."""

from __future__ import annotations

from service.contract.encode.explanation import explanation_json
from service.narration.answer_length import most_words
from service.narration.answerer import Json, not_so, plain
from service.narration.crash import Crashes
from service.narration.explanation import Explained
from service.narration.foils import Foils
from service.narration.options import Options
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain import QuestionError, why, why_not
from sim.explain.crash import led_to_crash
from sim.explain.effort import Effort
from sim.types import Move, Outcome


class Whys:
    """Answers to "why did you …?" and "why didn't you …?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings
        self._explained = Explained(sayings)
        self._crashes = Crashes(sayings)
        self._options = Options(sayings)
        self._foils = Foils(sayings)

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`. A question about what is not so is answered too, without causes.

        "Why did you do that?" of what ended in a crash is about the crash.
        """
        ask, timeline = asked.ask, asked.timeline
        if ask.instead is not None:
            return self._foils.contrasted(asked)
        if ask.about == "why" and ask.move is None and self._about_a_crash(asked):
            return self._crashes.answer(asked)
        effort = Effort.MORE if asked.length == "longer" else Effort.USUAL
        try:
            if ask.move is not None and ask.about == "why_not":
                explanation = why_not(timeline, ask.move, ask.tick, effort=effort)
            else:
                explanation = why(timeline, ask.tick, ask.move, effort=effort)
        except QuestionError as error:
            text = not_so(self._sayings, error.code, error.facts)
            return plain(self._sayings, ask, timeline.state, f"{text}{self._paused(asked)}")
        end = self._end(asked, explanation.decision.move)
        text = self._explained.text(
            explanation,
            detailed=asked.length == "longer",
            most=most_words(asked.length) - len(end.split()),
            now=timeline.tick if ask.tick is None else None,
        )
        text = f"{text} {end}" if end else text
        return plain(self._sayings, ask, timeline.state, text) | explanation_json(
            explanation, self._options.texts(explanation.decision)
        )

    def _end(self, asked: Asked, move: Move) -> str:
        """What a move led to, where the drive ended by it."""
        ask, world = asked.ask, asked.timeline.state.world
        if ask.about == "why_not" and led_to_crash(asked.timeline, ask.tick):
            return self._sayings.say("why", "ended_in_crash")
        if ask.tick is None and move is Move.STAY and world.outcome is Outcome.STUCK:
            return self._sayings.say("why", "ended_stuck")
        return ""

    def _paused(self, asked: Asked) -> str:
        """That the clock stands, where it is asked why it stopped and no stop of the drive is the reason."""
        if not asked.paused or asked.ask.about != "why" or asked.ask.move is not Move.STAY:
            return ""
        return "" if asked.ask.tick is not None else f" {self._sayings.say('answers', 'paused')}"

    def _about_a_crash(self, asked: Asked) -> bool:
        return asked.supposes == "crash" or led_to_crash(asked.timeline, asked.ask.tick)
