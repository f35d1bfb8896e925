"""Answers about past detection: "since when have you known about that car?", "what did you overlook?"."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import Any, Final

from service.contract.encode.sightings import noticed_json, sightings_json
from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.charges import in_seconds
from service.narration.futures_told import yes_and_no
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.actions import Where
from sim.explain import QuestionError
from sim.explain.sightings import Noticed, Sighting, Sightings, noticed, sightings
from sim.perceive import sensor_named
from sim.session.errors import EditError
from sim.session.pick import pick_things
from sim.session.timeline import Timeline
from sim.types import Kind, kind_of

MOST_TOLD: Final = 4
"""Things that are named; more are counted."""


class PastSightings:
    """Answers that are read off what the sensor showed at each tick of the drive."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, timeline = asked.ask, asked.timeline
        try:
            if ask.what == "noticed":
                change = noticed(timeline, ask.tick)
                text, facts = self._noticed(change), noticed_json(change)
            else:
                found = sightings(timeline)
                text, facts = self._told(asked, found), sightings_json(found)
        except EditError:
            return plain(self._sayings, ask, timeline.state, self._sayings.say("past", "none_to_ask"))
        except QuestionError as error:
            if error.code == "nothing_before":
                told = self._say("nothing_before", **error.facts)
            elif error.code in ("too_long", "no_such_tick"):
                told = self._sayings.say("history", error.code, **error.facts)
            else:
                told = not_so(self._sayings, error.code, error.facts)
            return plain(self._sayings, ask, timeline.state, told)
        return plain(self._sayings, ask, timeline.state, text) | {"what": ask.what} | facts

    def _told(self, asked: Asked, found: Sightings) -> str:
        ask, timeline = asked.ask, asked.timeline
        if found.last == found.first:
            return self._say("not_begun")
        if ask.what == "overlooked":
            return self._overlooked(asked, found)
        if ask.what == "lost_sight":
            return self._lost(asked, found)
        if ask.which is not None:
            return self._one(asked, found)
        kind = None if ask.kind is None else Kind(ask.kind)
        things = found.of(kind)
        seen = [each for each in things if each.first is not None]
        plural = self._things(kind, len(things))
        if not things:
            return self._say("none_there", things=self._things(kind, 2))
        first = ""
        if ask.want == "whether":
            first = self._say("whether", answer=yes_and_no(self._sayings, asked)["yes" if seen else "no"])
        if not seen:
            were = self._say("were", "one" if len(things) == 1 else "many")
            return first + self._say("none", total=len(things), were=were)
        percent = self._sayings.number(round(100 * len(seen) / len(things)))
        rate = self._say("rate", total=len(things), things=plural, count=len(seen), percent=percent)
        end = self._single("last", seen[-1], timeline)
        begun = self._single("first", seen[0], timeline)
        if ask.want == "last":
            return within([Part(0, end), Part(1, rate)])
        if ask.want in ("first", "whether"):
            return within([Part(0, first + begun), Part(1, rate)])
        far = self._average(seen, timeline)
        told = [rate, far] if ask.want == "share" else [far, rate]
        return within([Part(0, told[0]), Part(0, told[1]), Part(1, self._faithful(timeline))])

    def _average(self, seen: Sequence[Sighting], timeline: Timeline) -> str:
        ahead = [each.rows for each in seen if each.rows > 0]
        if not ahead:
            return ""
        metres = sum(ahead) / len(ahead) * timeline.state.config.cell_m
        said = self._sayings.number(round(metres))
        if len(ahead) < len(seen):  # what was beside or behind when it was first detected had no way ahead
            return self._say("average_ahead", metres=said, count=len(ahead), all=len(seen))
        return self._say("average", metres=said)

    def _one(self, asked: Asked, found: Sightings) -> str:
        """Since when a thing is detected, where it was then, and whether it was lost in between."""
        timeline = asked.timeline
        id = thing_meant(asked)
        each = found.find(id)
        if each is None:
            return self._say("one", "gone", id=id)
        first = ""
        if asked.ask.want == "whether":
            known = each.first is not None
            first = self._say("whether", answer=yes_and_no(self._sayings, asked)["yes" if known else "no"])
        if each.first is None:
            return first + self._say("one", "never")
        over = timeline.state.world.ended is not None
        key = "ended" if over else "start" if each.first == found.first else "since"
        since = self._say(
            "one",
            key,
            tick=each.first,
            ago=self._seconds(timeline.tick - each.first, timeline),
            place=self._place(each, timeline),
        )
        lost = sum(last - begun + 1 for begun, last in each.lost)
        gap = self._say("one", "lost", seconds=self._seconds(lost, timeline)) if lost else ""
        return within([Part(0, first + since), Part(1, gap), Part(2, self._faithful(timeline))])

    def _overlooked(self, asked: Asked, found: Sightings) -> str:
        """What was driven past and never detected."""
        kind = None if asked.ask.kind is None else Kind(asked.ask.kind)
        passed = [each for each in found.of(kind) if each.passed is not None]
        words = yes_and_no(self._sayings, asked)
        never = [each for each in passed if each.first is None]
        if not passed:
            return self._say("overlooked", "none_passed", **words)
        if not never:
            text = self._say("overlooked", "none", count=len(passed), **words)
            return within([Part(0, text), Part(1, self._faithful(asked.timeline))])
        kinds = Counter(each.kind for each in never)
        counted = [
            self._say("counted", count=count, things=self._sayings.things(kind, count))
            for kind, count in kinds.most_common()
        ]
        things = self._sayings.joined(counted)
        return self._say("overlooked", "some", count=len(never), total=len(passed), things=things, **words)

    def _lost(self, asked: Asked, found: Sightings) -> str:
        """What was detected ahead and then was not."""
        words = yes_and_no(self._sayings, asked)
        gone = [(each.kind, stretch) for each in found.things for stretch in each.lost]
        if not gone:
            return within(
                [Part(0, self._say("lost", "none", **words)), Part(1, self._faithful(asked.timeline))]
            )
        told = [
            self._say(
                "lost",
                "tick" if begun == last else "one",
                a=self._sayings.say("words", "a", kind),
                first=begun,
                last=last,
            )
            for kind, (begun, last) in sorted(gone, key=lambda each: each[1])
        ]
        return self._say("lost", "some", count=len(told), things=self._joined(told), **words)

    def _noticed(self, found: Noticed) -> str:
        tick = found.state.world.tick
        new = self._say("noticed", "nothing", tick=tick)
        if found.new:
            new = self._say("noticed", "new", tick=tick, things=self._named(found.new, found))
        gone = self._say("noticed", "gone", things=self._named(found.gone, found)) if found.gone else ""
        return within([Part(0, new), Part(1, gone)])

    def _named(self, ids: Sequence[str], found: Noticed) -> str:
        naming, world = Naming(self._sayings, found.state, as_seen=False), found.state.world
        told = []
        for id in ids:
            thing = world.find(id)
            place = "" if thing is None else naming.place(thing.cell)
            told.append(self._say("thing", a=self._sayings.say("words", "a", kind_of(id)), place=place))
        return self._joined(told)

    def _joined(self, told: list[str]) -> str:
        more = len(told) - MOST_TOLD
        return self._sayings.joined([*told[:MOST_TOLD], self._say("more", count=more)] if more > 0 else told)

    def _single(self, key: str, each: Sighting, timeline: Timeline) -> str:
        a = self._sayings.say("words", "a", each.kind)
        return self._say(key, a=a, tick=each.first, place=self._place(each, timeline))

    def _place(self, each: Sighting, timeline: Timeline) -> str:
        assert each.first is not None
        return Naming(self._sayings, timeline.at(each.first), as_seen=False).place(each.cell)

    def _things(self, kind: Kind | None, count: int) -> str:
        return self._say("things") if kind is None else self._sayings.things(kind, count)

    def _faithful(self, timeline: Timeline) -> str:
        return self._say("faithful") if sensor_named(timeline.state.config.sensor).faithful else ""

    def _seconds(self, ticks: int, timeline: Timeline) -> str:
        return in_seconds(self._sayings, ticks, timeline.state.config)

    def _say(self, *keys: str, **parts: Any) -> str:
        return self._sayings.say("sightings", *keys, **parts)


def thing_meant(asked: Asked) -> str:
    """The id of the thing that is meant, where it is now. Raises `EditError`."""
    which = asked.ask.which
    assert which is not None
    if which.id is not None:
        return which.id
    parts = {name: getattr(which, name) for name in Where.__dataclass_fields__}
    return pick_things(asked.timeline.state, str(which.kind), 1, Where(**parts))[0].id
