"""Answers to questions: the facts as JSON values, and the same facts as a sentence or two."""

from __future__ import annotations

from typing import Any

from service.actions import Ask
from service.narrate.explained import Explained
from service.narrate.sayings import Sayings
from service.sessions.facts import Asked
from service.wire.explanation import explanation_json
from sim.explain import QuestionError, why, why_not
from sim.kinds import Mode, Move, Outcome
from sim.run import Run

Json = dict[str, Any]


class Answers:
    """Answers in one language."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings
        self._explained = Explained(sayings)

    def answer(self, asked: Asked) -> Json:
        """The `Answer` of the interface.

        A question about what is not so (a tick that never was) is answered too, without causes.
        """
        ask, timeline = asked.ask, asked.timeline
        run = timeline.run
        match ask.about:
            case "why" | "why_not":
                return self._explanation(asked)
            case "status":
                return self._plain(ask, run, self._status(run))
            case "help":
                examples = self._sayings.joined([f"“{example}”" for example in self._sayings.examples()])
                return self._plain(ask, run, self._say("help", examples=examples))
            case _:
                raise AssertionError(f"{ask.about} is offered but nobody answers it")

    def _explanation(self, asked: Asked) -> Json:
        ask, timeline = asked.ask, asked.timeline
        try:
            if ask.move is not None and ask.about == "why_not":
                explanation = why_not(timeline, ask.move, ask.tick)
            else:
                explanation = why(timeline, ask.tick, ask.move)
        except QuestionError as error:
            return self._plain(ask, timeline.run, self._not_so(error))
        text = self._explained.text(explanation)
        return self._plain(ask, timeline.run, text) | explanation_json(explanation)

    def _plain(self, ask: Ask, run: Run, text: str) -> Json:
        return {
            "question": self._question(ask),
            "about": ask.about,
            "tick": run.world.tick,
            "text": text,
            "causes": [],
            "alternatives": [],
            "verified": None,
            "counterfactual": None,
            "evidence": None,
        }

    def _question(self, ask: Ask) -> str:
        key = str(ask.about)
        if key == "why" and ask.move is None:
            key = "why_any"
        if ask.tick is not None:
            key += "_at"
        do = "" if ask.move is None else self._sayings.move(ask.move, "do")
        return self._sayings.say("answers", "questions", key, do=do, tick=ask.tick)

    def _not_so(self, error: QuestionError) -> str:
        parts = dict(error.facts)
        if isinstance(move := parts.get("move"), Move):
            parts["do"], parts["did"] = self._sayings.move(move, "do"), self._sayings.move(move, "did")
        if isinstance(made := parts.get("made"), Move):
            parts["did"] = self._sayings.move(made, "did")
        if isinstance(wanted := parts.get("asked"), Move):
            parts["asked"] = self._sayings.move(wanted, "do")
        if isinstance(outcome := parts.get("outcome"), Outcome):
            parts["outcome"] = self._sayings.say("answers", "outcomes", outcome)
        return self._say(error.code, **parts)

    def _status(self, run: Run) -> str:
        world = run.world
        if world.outcome is not Outcome.RUNNING:
            outcome = self._sayings.say("answers", "outcomes", world.outcome)
            return self._say("status_ended", episode=world.episode, outcome=outcome, tick=world.tick)
        column, row = world.road.cell(world.av)
        rows = self._sayings.say("answers", "rows", "one" if row == 1 else "many", count=row)
        told = self._say(
            "status",
            lane=column + 1,
            row=row,
            rows=rows,
            metres=f"{row * run.config.cell_m:g}",
            tick=world.tick,
            episode=world.episode,
        )
        return f"{told} {self._say('status_manual')}" if run.mode is Mode.MANUAL else told

    def _say(self, key: str, **parts: object) -> str:
        return self._sayings.say("answers", key, **parts)
