"""Answers that count over a drive: stops and what they were for, lane changes, moves, ends, tight moments."""

from __future__ import annotations

from collections import Counter
from itertools import groupby
from typing import Final

from service.actions import Ask
from service.contract.encode.course import occurrences_json, tight_json
from service.narration.answer_length import Part, within
from service.narration.answerer import Json, plain
from service.narration.charges import in_seconds
from service.narration.futures_told import yes_and_no
from service.narration.inflection import capital
from service.narration.move_list import moves_told
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain.advance import Advance, advance
from sim.explain.facts import QuestionError
from sim.explain.occurrences import Event, Occurrence, Occurrences, Query, Stretch, occurrences
from sim.explain.tight_moments import TightMoments, tight_moments
from sim.session.timeline import Timeline
from sim.types import MOVES, PLACEABLE, Kind, Outcome

MOST_TICKS_TOLD: Final = 6
"""Ticks that are told one by one in a count; the facts have all."""
MOST_TICKS_LISTED: Final = 30
"""The same where a list is wanted."""
MOST_RUNS_LISTED: Final = 16
"""Runs of one move that are listed in their order; the facts have all."""

_EVENTS: Final = {
    "stopped": Event.STOP,
    "lane_changes": Event.LANE_CHANGE,
    "made": Event.MOVE,
    "ended": Event.END,
    "lanes_used": Event.DRIVE,
    "shares": Event.MOVE,
    "listed": Event.MOVE,
    "in_the_way": Event.MOVE,
    "moving": Event.GO,
}
_OUTCOMES: Final = {None: None, "crashes": Outcome.CRASH, "successes": Outcome.SUCCESS}


class DriveCounts:
    """Answers to "how often did you stop because of cars in the second half?" and all of that kind."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, timeline = asked.ask, asked.timeline
        if ask.what == "tight":
            tight = tight_moments(timeline)
            text, facts = self._tight(tight, yes_and_no(self._sayings, asked)), tight_json(tight)
        elif ask.ticks is not None and ask.ticks > timeline.tick:
            text, facts = self._sayings.say("history", "not_so_far_back", now=timeline.tick), Json()
        else:
            try:
                if ask.what == "advanced":
                    return self._advanced(ask, timeline)
                found = occurrences(timeline, _query(ask, timeline))
            except QuestionError as error:
                text, facts = self._sayings.say("history", error.code, **error.facts), Json()
            else:
                text, facts = self._text(asked, found), occurrences_json(found, str(ask.what))
        return plain(self._sayings, ask, timeline.state, text) | {"what": ask.what} | facts

    def _text(self, asked: Asked, found: Occurrences) -> str:
        ask, timeline = asked.ask, asked.timeline
        where = self._where(ask, found)
        if found.last < found.first:
            return self._say("no_half" if found.last >= 0 else "not_begun")
        if not found.driven:
            return self._say("none_driven", where=where) if where else self._say("not_begun")
        if ask.what == "lanes_used":
            return self._lanes(asked, found, where)
        if ask.what == "shares":
            return self._shares(found, where)
        if ask.what == "listed":
            return self._listed(found, where)
        narrowed = where or ask.want or ask.move or ask.what in ("made", "ended", "moving", "in_the_way")
        if ask.what == "stopped" and not narrowed:
            return self._stops(found, ask.kind, timeline)
        if ask.what == "lane_changes" and not narrowed and ask.kind is None:
            return self._changes(found, timeline)
        here = capital(where or self._say("where", "session" if ask.what == "ended" else "episode"))
        return within(self._composed(asked, found, here))

    def _shares(self, found: Occurrences, where: str) -> str:
        """How many moves of each kind; those that nobody counts as a diagonal are to a side."""
        counts = Counter(each.move for each in found.found if each.move is not None)
        total = sum(counts.values())
        told = [
            self._say(
                "made_of",
                count=counts[move],
                name=self._sayings.move(move, "name"),
                percent=self._sayings.number(round(100 * counts[move] / total)),
            )
            for move in MOVES
            if counts[move]
        ]
        here = capital(where or self._say("where", "episode"))
        key = "one" if total == 1 else "many"
        return self._say("shares", key, where=here, count=total, parts=self._sayings.joined(told))

    def _listed(self, found: Occurrences, where: str) -> str:
        """The moves in their order; those alike that follow each other are counted."""
        runs = [(move, len(list(alike))) for move, alike in groupby(each.move for each in found.found)]
        told = moves_told(
            self._sayings, [move for move, count in runs[:MOST_RUNS_LISTED] for _ in range(count) if move]
        )
        here = capital(where or self._say("where", "episode"))
        more = sum(count for _, count in runs[MOST_RUNS_LISTED:])
        rest = self._say("listed_more", count=more) if more else ""
        key = "one" if len(found.found) == 1 else "many"
        listed = self._say("listed", key, where=here, count=len(found.found), moves=told)
        return f"{listed} {rest}".strip()

    def _advanced(self, ask: Ask, timeline: Timeline) -> Json:
        """How many rows nearer to the goal it came."""
        found = advance(timeline, _query(ask, timeline))
        where = capital(self._where(ask, found) or self._say("where", "episode"))
        key = "none" if not found.rows else "one" if found.rows == 1 else "many"
        metres = self._sayings.number(found.rows * timeline.state.config.cell_m)
        seconds = self._seconds(found.ticks, timeline)
        parts = {"where": where, "rows": found.rows, "metres": metres}
        text = self._say("advanced", key, seconds=seconds, **parts) if found.ticks else self._say("not_begun")
        facts = {"first": found.first, "last": found.last, "driven": found.ticks, "rows": found.rows}
        return plain(self._sayings, ask, timeline.state, text) | {"what": ask.what} | facts

    def _composed(self, asked: Asked, found: Occurrences, where: str) -> list[Part]:
        """What is wanted of all that was found, with the conditions it was looked for under."""
        ask, timeline, each = asked.ask, asked.timeline, found.found
        unknown = Part(0, self._say("unknown", count=found.unknown) if ask.kind and found.unknown else "")
        first = ""
        if ask.want == "whether" and (each or not unknown.text):
            first = yes_and_no(self._sayings, asked)["yes" if each else "no"]
            first = self._say("whether", answer=first)
        if ask.want == "share":
            seconds = {
                "part": self._seconds(found.ticks, timeline),
                "all": self._seconds(found.driven, timeline),
            }
            percent = self._sayings.number(round(100 * found.ticks / found.driven))
            what = self._events(ask, 2)
            return [Part(0, self._say("share", where=where, what=what, percent=percent, **seconds)), unknown]
        if not each:
            return [Part(0, first + self._say("none", where=where, what=self._events(ask, 2))), unknown]
        if ask.want in ("first", "last", "longest"):
            one = (
                max(each, key=lambda one: one.ticks) if ask.want == "longest" else each[-(ask.want == "last")]
            )
            return [Part(0, self._one(ask, one, timeline, where)), *self._reason(ask, one), unknown]
        most = MOST_TICKS_LISTED if ask.want == "list" else MOST_TICKS_TOLD
        ticks = self._ticks([one.tick for one in each], most)
        key = "one" if len(each) == 1 else "many"
        what = self._events(ask, len(each))
        told = self._say("counted", key, where=where, count=len(each), what=what, ticks=ticks)
        return [Part(0, first + told), unknown]

    def _one(self, ask: Ask, one: Occurrence, timeline: Timeline, where: str) -> str:
        """The first, the last or the longest."""
        seconds = self._seconds(one.ticks, timeline)
        kind = "took" if ask.what in ("stopped", "moving") else "was"
        what = self._events(ask, 1, str(ask.want))
        return self._say("single", kind, where=where, what=what, tick=one.tick, seconds=seconds)

    def _reason(self, ask: Ask, one: Occurrence) -> list[Part]:
        """What a stop was for, where that is not what was asked."""
        if ask.what != "stopped" or ask.kind is not None or not one.kinds:
            return []
        counts = Counter(id.rpartition("-")[0] for id in one.ids or ())
        things = [self._sayings.things(kind, counts[kind]) for kind in one.kinds]
        return [Part(1, self._say("reason", things=self._sayings.joined(things)))]

    def _events(self, ask: Ask, count: int, which: str | None = None) -> str:
        """What is counted as a noun, with what it was for: "stops because of cars", "the first stop"."""
        key = str(ask.metric if ask.what == "ended" else ask.what)
        said = self._say("events", key, which or ("one" if count == 1 else "many"))
        if ask.move is not None:
            said = self._say("moved", what=said, move=self._sayings.move(ask.move, "name"))
        if ask.kind is not None:
            reason = "hit" if ask.what == "ended" else "because"
            said = self._say(reason, what=said, things=self._sayings.things(ask.kind, 2))
        return said

    def _where(self, ask: Ask, found: Occurrences | Advance) -> str:
        """The stretch and the conditions that were named; empty where none was."""
        told = []
        if ask.ticks is not None:
            told.append(self._say("where", "ticks" if ask.ticks > 1 else "tick", ticks=ask.ticks))
        elif ask.tick is not None:
            told.append(
                self._say(
                    "where", "since" if ask.until is None else "between", first=ask.tick, last=ask.until
                )
            )
        elif ask.part is not None:
            told.append(self._say("where", ask.part, first=found.first, last=found.last))
        if ask.lane is not None and ask.what != "lanes_used":
            told.append(self._say("where", "lane", lane=ask.lane))
        if ask.parameter is not None:
            told.append(self._sayings.say("evaluation", "conditions", ask.parameter, str(ask.value)))
        return self._say("where", "and").join(told)

    def _stops(self, found: Occurrences, kind: str | None, timeline: Timeline) -> str:
        """How often, for how long, for what, and when last; or how many of them for a kind of things."""
        stops, unknown = found.found, ""
        if found.unknown:
            unknown = self._say("unknown", count=found.unknown)
        if kind is not None:
            for_kind = tuple(stop for stop in stops if kind in stop.kinds)
        if not stops:
            return self._say("stops", "none", seconds=self._seconds(found.driven, timeline))
        if kind is not None:
            things = self._sayings.things(kind, 2)
            key = "of" if for_kind else "of_none"
            told = self._say("stops", key, count=len(for_kind), all=len(stops), things=things)
            last = self._last(for_kind[-1], timeline) if for_kind else ""
            return within([Part(0, told), Part(1, last), Part(1, unknown)])
        seconds = self._seconds(found.ticks, timeline)
        head = self._say("stops", "one" if len(stops) == 1 else "many", count=len(stops), seconds=seconds)
        counts = Counter(each for stop in stops for each in stop.kinds)
        named = [
            self._say("stops", "kind", count=counts[each], things=self._sayings.things(each, 2))
            for each in PLACEABLE
            if counts[each]
        ]
        kinds = self._say("stops", "kinds", kinds=self._sayings.joined(named)) if named else ""
        last = self._last(stops[-1], timeline)
        bare = sum(stop.ids == () for stop in stops)
        none = self._say("stops", "no_thing", count=bare) if bare else ""
        return within([Part(0, head), Part(0, kinds), Part(0, none), Part(1, last), Part(1, unknown)])

    def _last(self, stop: Occurrence, timeline: Timeline) -> str:
        seconds = self._seconds(stop.ticks, timeline)
        return self._say("stops", "last", when=self._when(stop, timeline), tick=stop.tick, seconds=seconds)

    def _changes(self, found: Occurrences, timeline: Timeline) -> str:
        """How often lanes were changed, to which sides, and when last."""
        seconds = self._seconds(found.driven, timeline)
        if not found.found:
            return self._say("changes", "none", seconds=seconds)
        last, count = found.found[-1], len(found.found)
        when = self._when(last, timeline)
        if count == 1:
            side = self._say("sides", "left" if last.left else "right")
            return self._say("changes", "one", seconds=seconds, side=side, when=when)
        left = sum(each.left for each in found.found)
        diagonal = sum(each.diagonal for each in found.found)
        told = [self._say("changes", "many", seconds=seconds, count=count, left=left, right=count - left)]
        if diagonal:
            key = "diagonal_one" if diagonal == 1 else "diagonal"
            told.append(self._say("changes", key, diagonal=diagonal))
        told.append(self._say("changes", "last", when=when))
        return " ".join(told)

    def _lanes(self, asked: Asked, found: Occurrences, where: str) -> str:
        """The lane of most ticks, then the others; or how long it was in the one that is named."""
        ask, timeline = asked.ask, asked.timeline
        seconds = self._seconds(found.driven, timeline)
        counted = Part(0, self._say("lanes", "counted", where=where) if where else "")
        if ask.lane is not None:
            ticks = dict(found.lanes).get(ask.lane, 0)
            percent = self._sayings.number(round(100 * ticks / found.driven))
            part = self._seconds(ticks, timeline)
            told = self._say("lanes", "of", lane=ask.lane, percent=percent, part=part, all=seconds)
            if ask.want == "whether":
                word = yes_and_no(self._sayings, asked)["yes" if ticks else "no"]
                told = self._say("whether", answer=word) + told
            return within([Part(0, told), counted])
        (lane, ticks), *others = found.lanes
        alike = [each for each, count in found.lanes if count == ticks]
        if not others:
            return within([Part(0, self._say("lanes", "only", lane=lane, seconds=seconds)), counted])
        if len(alike) > 1:
            names = self._sayings.joined([str(each) for each in alike])
            each_s = self._seconds(ticks, timeline)
            told = self._say("lanes", "alike", lanes=names, each=each_s, seconds=seconds)
            return within([Part(0, told), counted])
        named = [
            self._say("lanes", "other", lane=each, seconds=self._seconds(count, timeline))
            for each, count in others
        ]
        longest = self._seconds(ticks, timeline)
        told = self._say("lanes", "most", lane=lane, longest=longest, seconds=seconds)
        rest = self._say("lanes", "others", lanes=self._sayings.joined(named))
        return within([Part(0, told), Part(1, rest), counted])

    def _tight(self, found: TightMoments, first: dict[str, str]) -> str:
        """Whether there were such moments, and at which ticks."""
        if not found.judged:
            return self._say("not_begun")
        one, none = len(found.one), len(found.none)
        if not one and not none:
            return self._say("tight", "never", **first)
        told = []
        if one:
            ticks = self._ticks([each.tick for each in found.one], MOST_TICKS_TOLD)
            told.append(
                Part(0, self._say("tight", "one" if one == 1 else "some", count=one, ticks=ticks, **first))
            )
        if none:
            ticks = self._ticks([each.tick for each in found.none], MOST_TICKS_TOLD)
            key = ("none_too" if one else "none") + ("" if none > 1 else "_one")
            told.append(Part(0, self._say("tight", key, count=none, ticks=ticks, **first)))
        return within(told)

    def _ticks(self, ticks: list[int], most: int) -> str:
        """Ticks, the first few one by one."""
        named = [str(tick) for tick in ticks[:most]]
        more = len(ticks) - len(named)
        return self._sayings.joined([*named, self._say("more", count=more)] if more else named)

    def _when(self, one: Occurrence, timeline: Timeline) -> str:
        after = one.before.world.episode_tick
        seconds = self._seconds(after, timeline)
        return self._sayings.say("history", "when", "later" if after else "start", after=seconds)

    def _seconds(self, ticks: int, timeline: Timeline) -> str:
        return in_seconds(self._sayings, ticks, timeline.state.config)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("drive_counts", *keys, **parts)


def _query(ask: Ask, timeline: Timeline) -> Query:
    """What is looked for, in the terms of the simulator."""
    first = ask.tick if ask.ticks is None else timeline.tick - ask.ticks
    part = Stretch.EPISODE if ask.part is None else Stretch(ask.part)
    alone = ask.what == "lanes_used" or (ask.what == "stopped" and _only_of_a_kind(ask))
    return Query(
        event=_EVENTS.get(str(ask.what), Event.DRIVE),
        move=ask.move,
        straight=ask.what != "in_the_way",
        outcome=_OUTCOMES[ask.metric],
        cause=None if ask.kind is None or alone else Kind(ask.kind),
        first=first,
        last=ask.until,
        stretch=Stretch.SESSION if ask.what == "ended" else part,
        lane=None if ask.what == "lanes_used" else ask.lane,
        **({} if ask.parameter is None else {str(ask.parameter): str(ask.value)}),
    )


def _only_of_a_kind(ask: Ask) -> bool:
    """Whether stops of a kind of things are asked for under no other condition: told among all stops."""
    named = (ask.want, ask.part, ask.lane, ask.parameter, ask.tick, ask.ticks)
    return all(each is None for each in named)
