"""The last answer once more: shorter, in full, its reason, what was before or after it, how sure it is."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace

from service import actions as contract
from service.actions import Ask
from service.narration.answerer import Json, plain
from service.narration.foils import chance_told
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain import QuestionError
from sim.explain.other_move import had_moved
from sim.types import Move

_WITH_LENGTHS = ("why", "why_not", "other")
_OF_A_TICK = ("why", "why_not", "what_if", "other", "history")
_END = re.compile(r"(?<=[^\W\d][.!?])\s+|(?<=[)”“][.!?])\s+")

Answered = Callable[[Asked], Json]
"""Answers a question."""


class Details:
    """Answers to "shorter", "in detail", "why is that?", "and before that?"."""

    def __init__(self, sayings: Sayings, answer: Answered) -> None:
        """`answer`: of the questions themselves."""
        self._sayings = sayings
        self._answer = answer

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`; `asked` is the question that was answered again, with its tick."""
        how, before = asked.ask.how, asked.talk.explained
        if before is None and how == "why":
            return self._again(asked, Ask(about="why"))
        if before is None:
            return plain(self._sayings, asked.ask, asked.timeline.state, self._say("nothing_told"))
        match how:
            case "shorter":
                return self._shorter(asked, before)
            case "longer":
                return self._longer(asked, before)
            case "why":
                return self._reason(asked, before)
            case _:
                return self._next_to(asked, before, -1 if how == "before" else 1)

    def _again(self, asked: Asked, ask: Ask, length: str | None = None) -> Json:
        told = self._answer(replace(asked, ask=ask, length=length))
        return told | {"about": "detail", "asked": contract.dump((ask,))[0]}

    def _shorter(self, asked: Asked, before: Ask) -> Json:
        told = self._again(asked, before, "shorter")
        first = _END.split(told["text"], maxsplit=1)[0]
        return told if before.about in _WITH_LENGTHS else told | {"text": first}

    def _longer(self, asked: Asked, before: Ask) -> Json:
        told, short = self._again(asked, before, "longer"), self._again(asked, before)
        return (
            told
            if told["text"] != short["text"]
            else told | {"text": f"{told['text']} {self._say('no_more')}"}
        )

    def _reason(self, asked: Asked, before: Ask) -> Json:
        """Why that is so: of a decision in full, of a move not made why it was not, else why one was."""
        if before.about in _WITH_LENGTHS or before.about in ("pattern", "detail"):
            return self._longer(asked, before)
        if before.about == "what_if" and before.move is not None:
            return self._again(asked, Ask(about="why_not", move=before.move, tick=before.tick))
        return self._again(asked, Ask(about="why", tick=before.tick))

    def _next_to(self, asked: Asked, before: Ask, ticks: int) -> Json:
        """The same of the tick before or after; why a move was made is asked of whatever was made there."""
        now = asked.timeline.tick
        if before.tick is None or before.about not in _OF_A_TICK:
            before = Ask(about="why", tick=max(0, now - 1) if ticks < 0 else now)
            if ticks < 0:
                ticks = 0
        assert before.tick is not None
        tick = before.tick + ticks
        if tick < 0:
            return plain(self._sayings, asked.ask, asked.timeline.state, self._say("nothing_before"))
        if before.about == "why":
            return self._again(asked, Ask(about="why", tick=tick))
        if before.about == "history" and before.what != "seen":
            return self._again(asked, Ask(about="why", tick=tick))
        move = None if before.about == "other" else before.move
        return self._again(asked, replace(before, tick=tick, move=move))

    def sure(self, asked: Asked) -> Json | None:
        """How sure the last answer is; None where there is none, or it is no claim about the past."""
        before = asked.talk.explained
        if before is None or before.about not in (*_WITH_LENGTHS, "what_if", "pattern", "history"):
            return None
        told = plain(self._sayings, asked.ask, asked.timeline.state, "")
        if before.about == "history":
            return told | {"text": self._say("sure", "read")}
        if before.about == "what_if":
            return (
                None
                if before.move is None
                else told | {"text": self._sure_of_move(asked, before.move, before.tick)}
            )
        evidence = self._answer(replace(asked, ask=before, supposes=None)).get("evidence") or {}
        count = evidence.get("reruns", 0)
        if not count:
            return None
        times = self._say("times", {1: "one", 2: "two"}.get(count, "many"), count=count)
        return told | {"text": self._say("sure", "runs", times=times), "evidence": evidence}

    def _sure_of_move(self, asked: Asked, move: Move, tick: int | None) -> str:
        try:
            found = had_moved(asked.timeline, move, tick)
        except QuestionError:
            return self._say("sure", "read")
        if not found.stakes.by_chance:
            return self._say("sure", "certain")
        would, real = chance_told(self._sayings, found)
        return self._say("sure", "chance", would=would, real=real)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("past", *keys, **parts)
