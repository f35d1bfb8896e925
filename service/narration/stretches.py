"""Answers about ticks in a row: waits, moves that the planner would not have made, the end before a crash."""

from __future__ import annotations

from typing import Final

from service.contract.encode.soon import before_crash_json, differing_json, waits_json
from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.charges import in_seconds
from service.narration.inflection import capital
from service.narration.move_list import moves_told
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain import QuestionError
from sim.explain.before_crash import BeforeCrash, before_crash
from sim.explain.differing import ManualDrive, differing
from sim.explain.waits import Waits, waits

MOST_TOLD: Final = 4
"""Moves told one by one; the facts have all."""
COUNTED: Final = "number"
"""What a question supposes that asks for all the waits of the drive."""


class Stretches:
    """Answers to "how long have we been waiting?", "what did the other car do before the crash?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, state = asked.ask, asked.timeline.state
        try:
            text, facts = self._told(asked)
        except QuestionError as error:
            return plain(self._sayings, ask, state, not_so(self._sayings, error.code, error.facts))
        return plain(self._sayings, ask, state, text) | {"what": ask.what} | facts

    def _told(self, asked: Asked) -> tuple[str, Json]:
        timeline = asked.timeline
        match asked.ask.what:
            case "waited":
                waited = waits(timeline)
                return self._waited(waited, asked), waits_json(waited)
            case "differed":
                driven = differing(timeline)
                return self._differed(driven), differing_json(driven)
            case _:
                found = before_crash(timeline)
                return self._before(found), before_crash_json(found)

    def _waited(self, found: Waits, asked: Asked) -> str:
        """The present wait first, or all of them where they are counted."""
        config = asked.timeline.state.config
        if not found.driven:
            return self._say("waited", "not_begun")
        if not found.total:
            return self._say("waited", "never")
        now = self._say(
            "waited",
            "now" if found.now else "not_now",
            seconds=in_seconds(self._sayings, found.now, config),
            ticks=self._ticks(found.now),
            since=found.since,
        )
        total = self._say(
            "waited",
            "total",
            seconds=in_seconds(self._sayings, found.total, config),
            ticks=self._ticks(found.total),
            driven=in_seconds(self._sayings, found.driven, config),
        )
        if found.now == found.total and asked.supposes != COUNTED:
            return now
        return " ".join([total] if asked.supposes == COUNTED else [now, total])

    def _differed(self, found: ManualDrive) -> str:
        if not found.by_hand:
            return self._say("differed", "not_by_hand")
        told = [
            self._say(
                "differed",
                "one",
                tick=each.tick,
                made=self._sayings.move(each.made, "name"),
                would=self._sayings.move(each.would, "name"),
            )
            for each in found.found[:MOST_TOLD]
        ]
        if len(found.found) > MOST_TOLD:
            told.append(self._say("differed", "more", count=len(found.found) - MOST_TOLD))
        key = "none" if not told else "some"
        text = self._say(
            "differed",
            key,
            count=len(found.found),
            moves=self._say(
                "differed", "moves", "one" if found.by_hand == 1 else "many", count=found.by_hand
            ),
            listed=self._sayings.listed(told),
        )
        unknown = self._say("differed", "unknown", count=found.unknown) if found.unknown else ""
        return within([Part(0, text), Part(1, unknown)])

    def _before(self, found: BeforeCrash) -> str:
        """What was hit first, then the ego."""
        config = found.before.config
        seconds = in_seconds(self._sayings, len(found.own), config)
        own = self._say("before", "own", moves=moves_told(self._sayings, found.own))
        header = self._say("before", "header", seconds=seconds, tick=found.tick)
        if found.thing is None:
            return " ".join([header, self._say("before", "another_ego"), own])
        who = Naming(self._sayings, found.before, as_seen=False).thing(found.thing.id)
        if not found.theirs:
            theirs = self._say("before", "fixed", who=who)
        else:
            theirs = self._say("before", "moved", who=who, moves=moves_told(self._sayings, found.theirs))
        return within([Part(0, header), Part(0, capital(theirs)), Part(0, own)])

    def _ticks(self, count: int) -> str:
        return self._say("ticks", "one" if count == 1 else "many", count=count)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("stretches", *keys, **parts)
