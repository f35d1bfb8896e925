"""Answers about a drive as a whole: what was left behind, how well it went."""

from __future__ import annotations

from contextlib import suppress

from service.contract.encode.course import passed_json, verdict_json
from service.narration.answer_length import Part, within
from service.narration.answerer import Json, plain
from service.narration.charges import in_seconds
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain import QuestionError
from sim.explain.losses import Losses, losses
from sim.explain.passed import Passed, passed
from sim.explain.riskiest import MOST_TICKS, Risk, riskiest
from sim.explain.waits import waits
from sim.session.timeline import Timeline
from sim.types import PLACEABLE, Kind, Outcome


class Courses:
    """Answers to "how many cars did we pass?", "how well did it go?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, timeline = asked.ask, asked.timeline
        if ask.what == "passed":
            found = passed(timeline)
            kind = None if ask.kind is None else Kind(ask.kind)
            text, facts = self._passed(found, kind), passed_json(found)
        else:
            text, facts = self._verdict(timeline)
        return plain(self._sayings, ask, timeline.state, text) | {"what": ask.what} | facts

    def _passed(self, found: Passed, kind: Kind | None) -> str:
        """How many of a kind, or of every kind that there was."""
        if not found.driven:
            return self._say("passed", "not_begun")
        if kind is not None:
            count = len(found.ids[kind])
            things = self._sayings.things(kind, count or 2)
            key = "of" if count else "none"
            return self._say("passed", key, count=count, things=things)
        told = [
            self._say("passed", "one", count=len(ids), things=self._sayings.things(each, len(ids)))
            for each in PLACEABLE
            if (ids := found.ids.get(each))
        ]
        if not told:
            return self._say("passed", "nothing")
        return self._say("passed", "all", things=self._sayings.joined(told))

    def _verdict(self, timeline: Timeline) -> tuple[str, Json]:
        """How it ended, what it lost, how long it waited, how tight it was: facts, and no marks."""
        state, world = timeline.state, timeline.state.world
        waited = waits(timeline)
        if not waited.driven:
            return self._say("verdict", "not_begun"), verdict_json(state, waited, None, None)
        lost: Losses | None = None
        with suppress(QuestionError):
            lost = losses(timeline)
        last = timeline.tick if world.ended is None else world.ended
        first = max(world.episode_start, last - MOST_TICKS)
        risk = riskiest(timeline.between(first, last + 1))
        seconds = in_seconds(self._sayings, waited.driven, state.config)
        told = [Part(0, self._say("verdict", str(world.outcome), seconds=seconds))]
        told += self._lost(lost, timeline)
        key = "waited" if waited.total else "not_waited"
        wait_s = in_seconds(self._sayings, waited.total, state.config)
        told.append(Part(1, self._say("verdict", key, seconds=wait_s)))
        told += self._tight(risk, timeline)
        if world.outcome is not Outcome.RUNNING:
            told.append(Part(2, self._say("verdict", "certain" if state.config.certain else "by_chance")))
        return within(told), verdict_json(state, waited, lost, risk)

    def _lost(self, lost: Losses | None, timeline: Timeline) -> list[Part]:
        """What the moves have cost, where that is known of all of them."""
        if lost is None or not lost.judged:
            return []
        given = next((loss for loss in lost.found if loss.ticks is None), None)
        if given is not None:
            return [Part(0, self._say("verdict", "gave_away", when=self._when(given.tick, timeline)))]
        if lost.unknown:
            return []
        seconds = in_seconds(self._sayings, lost.ticks, timeline.state.config)
        return [Part(0, self._say("verdict", "lost" if lost.ticks else "no_loss", seconds=seconds))]

    def _tight(self, risk: Risk | None, timeline: Timeline) -> list[Part]:
        if risk is None or risk.crashed or len(risk.free) == len(risk.tried):
            return []
        counts = {"free": len(risk.free), "tried": len(risk.tried)}
        return [Part(1, self._say("verdict", "tight", when=self._when(risk.tick, timeline), **counts))]

    def _when(self, tick: int, timeline: Timeline) -> str:
        """A moment of the drive, on the clock that tells how long it has lasted."""
        after = tick - timeline.state.world.episode_start
        seconds = in_seconds(self._sayings, after, timeline.state.config)
        return self._sayings.say("history", "when", "later" if after else "start", after=seconds)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("course", *keys, **parts)
