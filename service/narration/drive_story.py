"""Answers that tell a drive in order: its main events, and what went wrong."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby
from typing import Final

from service.narration.answer_length import MOST_WORDS, Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.charges import in_seconds
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain.drive_story import DriveStory, Happened, StoryEvent, drive_story, what_went_wrong
from sim.explain.question_error import QuestionError
from sim.types import Outcome

ENDS: Final = (Happened.SUCCESS, Happened.CRASH, Happened.STUCK)
ROOM: Final = MOST_WORDS - 8
"""Words of the events; the rest is for how many are left out."""
MOST_TICKS: Final = 4
"""Ticks of alike events in a row that are told one by one."""


class DriveStories:
    """Answers to "what was the story of the trip?" and "list everything that went wrong, in order"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, timeline = asked.ask, asked.timeline
        try:
            if ask.what == "story":
                found = drive_story(timeline)
                text = self._story(found)
            else:
                found = what_went_wrong(timeline)
                text = self._wrong(found)
        except QuestionError as error:
            if error.code == "too_long":
                told = self._sayings.say("history", "too_long", **error.facts)
            else:
                told = not_so(self._sayings, error.code, error.facts)
            return plain(self._sayings, ask, timeline.state, told) | {"what": ask.what}
        return plain(self._sayings, ask, timeline.state, text) | {"what": ask.what} | _json(found)

    def _story(self, found: DriveStory) -> str:
        """Start, main events and end; what matters least is counted where there is no room."""
        near = sum(each.what is Happened.NEAR_MISS for each in found.events)
        events = [each for each in found.events if each.what not in (Happened.NEAR_MISS, *ENDS)]
        told = [(each, self._event(each, found)) for each in events]
        start, end = self._start(found), self._end(found)
        misses = self._say("near", "one" if near == 1 else "many", count=near) if near else ""
        fixed = sum(len(each.split()) for each in (start, end, misses))
        left_out = 0
        while told and fixed + sum(len(text.split()) for _, text in told) > ROOM:
            told.remove(min(told, key=lambda each: (_weight(each[0]), -each[0].tick)))
            left_out += 1
        more = self._say("left_out", "one" if left_out == 1 else "many", count=left_out) if left_out else ""
        course = self._say("course", parts="; ".join([start, *(text for _, text in told), end]))
        return " ".join(each for each in (course, misses, more) if each)

    def _start(self, found: DriveStory) -> str:
        lane = found.start.world.road.cell(found.start.world.av)[0] + 1
        return self._say("start", tick=found.first, lane=lane)

    def _end(self, found: DriveStory) -> str:
        world = found.end.world
        if world.outcome is Outcome.RUNNING:
            column, row = world.road.cell(world.av)
            return self._say("now", tick=found.last, lane=column + 1, row=row)
        return self._event(found.events[-1], found)

    def _event(self, each: StoryEvent, found: DriveStory) -> str:
        what = each.what
        a = "" if each.kind is None else self._sayings.say("words", "a", each.kind)
        form = "bare" if each.kind is None else "for"
        seconds = in_seconds(self._sayings, each.ticks, found.end.config)
        if what in (Happened.LEFT, Happened.RIGHT, Happened.STOP, Happened.CRASH):
            return self._say(str(what), form, tick=each.tick, a=a, seconds=seconds)
        return self._say(str(what), tick=each.tick, seconds=seconds)

    def _wrong(self, found: DriveStory) -> str:
        """Each that went wrong, alike ones in a row together; then what is not known."""
        unknown = "" if found.losses_known else self._say("losses_unknown")
        if not found.events:
            return within([Part(0, self._say("nothing_wrong")), Part(1, unknown)])
        groups = [list(alike) for _, alike in groupby(found.events, key=lambda each: each.what)]
        told = [self._group(group, found) for group in groups]
        left_out, count = 0, len(found.events)
        while len(told) > 1 and sum(len(text.split()) for text in told) > ROOM - 6:
            least = min(range(len(groups)), key=lambda at: (_weight(groups[at][0]), -at))
            left_out += len(groups[least])
            del groups[least], told[least]
        more = self._say("left_out", "one" if left_out == 1 else "many", count=left_out) if left_out else ""
        key = "one" if count == 1 else "many"
        listed = self._say("wrong", key, count=count, parts="; ".join(told))
        return within([Part(0, listed), Part(0, more), Part(1, unknown)])

    def _group(self, group: Sequence[StoryEvent], found: DriveStory) -> str:
        first = group[0]
        if first.what in ENDS:
            return self._event(first, found)
        ticks = [str(each) for each in dict.fromkeys(event.tick for event in group)]
        more = [self._say("more", count=len(ticks) - MOST_TICKS)] if len(ticks) > MOST_TICKS else []
        gap = min((each.gap_m for each in group if each.gap_m is not None), default=0)
        lost = sum(each.ticks for each in group)
        return self._say(
            "went_wrong",
            str(first.what),
            "one" if len(ticks) == 1 else "many",
            ticks=self._sayings.joined([*ticks[:MOST_TICKS], *more]),
            metres=self._sayings.number(round(gap, 2)),
            seconds=in_seconds(self._sayings, lost, found.end.config),
        )

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("drive_story", *keys, **parts)


def _weight(each: StoryEvent) -> int:
    """How much an event matters; of stops the longer."""
    if each.what in ENDS or each.what is Happened.GAVE_AWAY:
        return 10_000
    if each.what in (Happened.CHANGED, Happened.SILENT):
        return 1_000
    return each.ticks + (1 if each.what is Happened.NEAR_MISS else 0)


def _json(found: DriveStory) -> Json:
    return {
        "first": found.first,
        "last": found.last,
        "events": [
            {
                "tick": each.tick,
                "what": each.what,
                "ticks": each.ticks,
                "kind": each.kind,
                "gap_m": each.gap_m,
                "move": each.move,
            }
            for each in found.events
        ],
        "losses_known": found.losses_known,
    }
