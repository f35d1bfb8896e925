"""Answers that count over a drive: stops and what they were for, lanes, moments with one way out."""

from __future__ import annotations

from collections import Counter
from typing import Final

from service.contract.encode.course import lanes_used_json, stops_json, tight_json
from service.narration.answer_length import Part, within
from service.narration.answerer import Json, plain
from service.narration.charges import in_seconds
from service.narration.futures_told import yes_and_no
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain.lanes_used import LanesUsed, lanes_used
from sim.explain.stops import Stop, Stops, stops
from sim.explain.tight_moments import TightMoments, tight_moments
from sim.session.timeline import Timeline
from sim.types import PLACEABLE, Kind

MOST_TICKS_TOLD: Final = 6
"""Ticks that are told one by one; the facts have all."""


class DriveCounts:
    """Answers to "how many of your stops were because of people?", "which lane have we been in most?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, timeline = asked.ask, asked.timeline
        match ask.what:
            case "stops":
                found = stops(timeline)
                kind = None if ask.kind is None else Kind(ask.kind)
                text, facts = self._stops(found, kind, timeline), stops_json(found)
            case "lanes_used":
                lanes = lanes_used(timeline)
                text, facts = self._lanes(lanes, timeline), lanes_used_json(lanes)
            case _:
                tight = tight_moments(timeline)
                text, facts = self._tight(tight, yes_and_no(self._sayings, asked)), tight_json(tight)
        return plain(self._sayings, ask, timeline.state, text) | {"what": ask.what} | facts

    def _stops(self, found: Stops, kind: Kind | None, timeline: Timeline) -> str:
        """How often, for how long, for what, and when last; or how many of them for a kind of things."""
        if not found.driven:
            return self._say("not_begun")
        if not found.found:
            return self._say("stops", "none", seconds=self._seconds(found.driven, timeline))
        unknown = self._say("stops", "unknown", count=found.unknown) if found.unknown else ""
        if kind is not None:
            for_kind = found.of(kind)
            things = self._sayings.things(kind, 2)
            key = "of" if for_kind else "of_none"
            told = self._say("stops", key, count=len(for_kind), all=len(found.found), things=things)
            last = self._last(for_kind[-1], timeline) if for_kind else ""
            return within([Part(0, told), Part(1, last), Part(1, unknown)])
        one = len(found.found) == 1
        seconds = self._seconds(found.ticks, timeline)
        key = "one" if one else "many"
        head = self._say("stops", key, count=len(found.found), seconds=seconds)
        counts = Counter(each for stop in found.found for each in stop.kinds)
        named = [
            self._say("stops", "kind", count=counts[each], things=self._sayings.things(each, 2))
            for each in PLACEABLE
            if counts[each]
        ]
        kinds = self._say("stops", "kinds", kinds=self._sayings.joined(named)) if named else ""
        last = self._last(found.found[-1], timeline)
        bare = sum(stop.ids == () for stop in found.found)
        none = self._say("stops", "no_thing", count=bare) if bare else ""
        return within([Part(0, head), Part(0, kinds), Part(0, none), Part(1, last), Part(1, unknown)])

    def _last(self, stop: Stop, timeline: Timeline) -> str:
        seconds = self._seconds(stop.ticks, timeline)
        return self._say(
            "stops", "last", when=self._when(stop.tick, timeline), tick=stop.tick, seconds=seconds
        )

    def _lanes(self, found: LanesUsed, timeline: Timeline) -> str:
        """The lane of most ticks, then the others."""
        if not found.ticks:
            return self._say("not_begun")
        (lane, ticks), *others = found.ticks
        seconds = self._seconds(found.driven, timeline)
        if not others:
            return self._say("lanes", "only", lane=lane, seconds=seconds)
        alike = [each for each, count in found.ticks if count == ticks]
        if len(alike) > 1:
            names = self._sayings.joined([str(each) for each in alike])
            each_s = self._seconds(ticks, timeline)
            return self._say("lanes", "alike", lanes=names, each=each_s, seconds=seconds)
        named = [
            self._say("lanes", "other", lane=each, seconds=self._seconds(count, timeline))
            for each, count in others
        ]
        longest = self._say(
            "lanes", "most", lane=lane, longest=self._seconds(ticks, timeline), seconds=seconds
        )
        return within(
            [Part(0, longest), Part(1, self._say("lanes", "others", lanes=self._sayings.joined(named)))]
        )

    def _tight(self, found: TightMoments, first: dict[str, str]) -> str:
        """Whether there were such moments, and at which ticks."""
        if not found.judged:
            return self._say("not_begun")
        one, none = len(found.one), len(found.none)
        if not one and not none:
            return self._say("tight", "never", **first)
        told = []
        if one:
            ticks = self._ticks([each.tick for each in found.one])
            told.append(
                Part(0, self._say("tight", "one" if one == 1 else "some", count=one, ticks=ticks, **first))
            )
        if none:
            ticks = self._ticks([each.tick for each in found.none])
            key = ("none_too" if one else "none") + ("" if none > 1 else "_one")
            told.append(Part(0, self._say("tight", key, count=none, ticks=ticks, **first)))
        return within(told)

    def _ticks(self, ticks: list[int]) -> str:
        """Ticks, the first few one by one."""
        named = [str(tick) for tick in ticks[:MOST_TICKS_TOLD]]
        more = len(ticks) - len(named)
        return self._sayings.joined([*named, self._say("more", count=more)] if more else named)

    def _when(self, tick: int, timeline: Timeline) -> str:
        after = tick - timeline.state.world.episode_start
        return self._sayings.say(
            "history", "when", "later" if after else "start", after=self._seconds(after, timeline)
        )

    def _seconds(self, ticks: int, timeline: Timeline) -> str:
        return in_seconds(self._sayings, ticks, timeline.state.config)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("drive_counts", *keys, **parts)
