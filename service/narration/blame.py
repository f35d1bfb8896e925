"""Answers about blame and duty: whose fault, when too late, seen coming, avoidable; yes or no first."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeAlias

from service.contract.encode.blame import blame_json, foreseen_json
from service.narration.answer_length import Part, within
from service.narration.answerer import Json, plain
from service.narration.charges import in_seconds
from service.narration.crash import Crashes
from service.narration.futures_told import yes_and_no
from service.narration.inflection import capital
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain import QuestionError
from sim.explain.attribution import Attribution, attribute
from sim.explain.blame import LOOK_BACK, RERUN_TICKS, Blame, Fault, Foreseen, blame, foreseen
from sim.explain.crash import SAVED_WITHIN, Crash
from sim.plan import traits_of
from sim.session.timeline import Timeline
from sim.state import SimState

Words: TypeAlias = Mapping[str, str]


def _attribution(timeline: Timeline, found: Blame) -> Attribution | None:
    """What would have avoided a crash that was the sensor's fault; not looked for where it takes long."""
    if found.fault is not Fault.SENSOR or not traits_of(found.decision.planner).quick:
        return None
    return attribute(timeline, found.crash.end)


class Blames:
    """Answers to "whose fault was it?", "when was it too late?", "could you have avoided it?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings
        self._crashes = Crashes(sayings)

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`. Where there was no crash, that is the answer."""
        ask, timeline, first = asked.ask, asked.timeline, yes_and_no(self._sayings, asked)
        try:
            if ask.what in ("foreseen", "first_seen"):
                seen = foreseen(timeline, ask.tick)
                text = self._foreseen(seen, first) if ask.what == "foreseen" else self._first_seen(seen)
                facts = foreseen_json(seen)
            else:
                found = blame(timeline, ask.tick)
                spared = _attribution(timeline, found) if ask.what == "fault" else None
                text, facts = self._text(str(ask.what), found, first, spared), blame_json(found)
                if spared is not None:
                    facts["avoided_by"] = [[each.setting, each.value] for each in spared.avoided_by]
        except QuestionError as error:
            return plain(self._sayings, ask, timeline.state, self._crashes.not_so(error))
        return plain(self._sayings, ask, timeline.state, text) | {"what": ask.what} | facts

    def _text(self, what: str, found: Blame, first: Words, spared: Attribution | None) -> str:
        if what == "fault":
            *told, measure = self._fault(found)
            return within([*told, *self._spared(spared), measure])
        if what == "too_late":
            return self._too_late(found)
        return within(self._avoidable(found, first))

    def _fault(self, found: Blame) -> list[Part]:
        decision = found.decision
        parts: dict[str, object] = {"who": self._hit(found.crash, found.state)}
        parts["did"] = self._sayings.move(decision.move, "did")
        if decision.fault is not None:
            parts["fault"] = self._sayings.fault(decision.fault)
        parts["planner"] = self._sayings.planner(decision.planner, "id")
        told = [Part(0, self._say("fault", found.fault, **parts))]
        if found.fault in (Fault.EGO, Fault.SHARED):
            told.append(Part(1, self._how(found)))
        elif found.avoidable.last is not None and found.fault in (Fault.OTHER, Fault.NOBODY):
            told.append(Part(3, self._say("hindsight", **self._last(found))))
        return [*told, Part(2, self._say("measure"))]

    def _spared(self, spared: Attribution | None) -> list[Part]:
        """Which other sensor or conditions would have avoided it, where that was looked for."""
        if spared is None:
            return []
        if not spared.avoided_by:
            return [Part(1, self._say("spared_none"))]
        named = [self._say("changes", each.value) for each in spared.avoided_by]
        return [Part(1, self._say("spared", changes=self._sayings.joined(named)))]

    def _how(self, found: Blame) -> str:
        """How the ego could have kept clear."""
        if found.free and found.knew:
            return self._say("free", doing=self._sayings.move(found.free[0], "doing"))
        if found.avoidable.last is None:
            return ""
        when = "now" if found.ticks_before == 1 else "before"
        return capital(self._say("kept", when, **self._last(found)))

    def _too_late(self, found: Blame) -> str:
        if found.avoidable.last is None:
            return self._none(found, "too_late", "always", {})
        key = "after" if found.exact else "found"
        return self._say("too_late", key, **self._last(found))

    def _avoidable(self, found: Blame, first: Words) -> list[Part]:
        """Yes or no, `first` as words, and how."""
        last = found.avoidable.last
        if last is None:
            return [Part(0, self._none(found, "avoidable", "none", first))]
        when = "now" if found.ticks_before == 1 else "before"
        key = "stays" if last.stays else "moves"
        told = [Part(0, self._say("avoidable", key, when, **self._last(found), **first))]
        if not found.knowable:
            told.append(Part(1, self._say("avoidable", "hindsight")))
        saving = found.crash.saving
        if saving is not None:
            told.append(Part(2, self._say("avoidable", "way", tick=saving.tick)))
        return told

    def _none(self, found: Blame, table: str, proved: str, first: Words) -> str:
        """That there was no way out, or that none was found."""
        if found.avoidable.proved:
            return self._say(table, proved, **first)
        most = SAVED_WITHIN if found.state.config.free_ways_hold else RERUN_TICKS
        looked = min(most, found.crash.end - found.state.world.episode_start)
        return self._say(table, "unknown", seconds=self._seconds(looked, found.state))

    def _last(self, found: Blame) -> dict[str, object]:
        """The facts of the last way out."""
        last = found.avoidable.last
        assert last is not None
        return {
            "tick": last.tick,
            "did": self._sayings.move(last.made, "did"),
            "doing": self._sayings.move(last.instead, "doing"),
            "seconds": self._seconds(found.crash.end - last.tick, found.state),
        }

    def _foreseen(self, found: Foreseen, first: Words) -> str:
        who = self._hit(found.crash, found.state)
        since = found.expected_since
        if since is None:
            if found.seen_since is None:
                return self._say("foreseen", "unseen", who=who, **first)
            ticks = found.crash.end - found.seen_since
            key = "elsewhere_longer" if ticks > LOOK_BACK else "elsewhere"
            seconds = self._seconds(min(ticks, LOOK_BACK), found.state)
            return self._say("foreseen", key, who=who, seconds=seconds, **first)
        before = found.crash.end - since
        seconds = self._seconds(before, found.state)
        key = "late" if before == 1 else "expected"
        told = self._say("foreseen", key, who=who, tick=since, seconds=seconds, **first)
        return told if found.crash.free else f"{told} {self._say('foreseen', 'no_way')}"

    def _first_seen(self, found: Foreseen) -> str:
        """Since when it was seen without a break, and since when it was expected there."""
        who = self._hit(found.crash, found.state)
        since, end = found.seen_since, found.crash.end
        if since is None:
            return self._say("first_seen", "never", who=who)
        key = "longer" if end - since > LOOK_BACK else "since"
        seen = self._say(
            "first_seen", key, who=who, tick=since, seconds=self._seconds(end - since, found.state)
        )
        expected = found.expected_since
        if expected is None:
            return within([Part(0, seen), Part(1, self._say("first_seen", "not_expected"))])
        before = self._seconds(end - expected, found.state)
        return within(
            [Part(0, seen), Part(1, self._say("first_seen", "expected", tick=expected, seconds=before))]
        )

    def _hit(self, crash: Crash, state: SimState) -> str:
        ids = [name for name in crash.cause.ids if name != crash.explanation.decision.av]
        return Naming(self._sayings, state, as_seen=False).things(ids)

    def _seconds(self, ticks: int, state: SimState) -> str:
        return in_seconds(self._sayings, ticks, state.config)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("blame", *keys, **parts)
