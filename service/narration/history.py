"""Answers about the past: the closest call, a stretch of ticks, this episode, what was seen at a tick."""

from __future__ import annotations

from typing import Any, Final

from service.narration.answer_length import Part, within
from service.narration.answerer import Json, plain
from service.narration.charges import in_seconds
from service.narration.metrics import Figures
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from service.narration.scene import Scenes
from service.sessions.facts import Asked
from sim.decide import sense
from sim.explain.closest_call import ClosestCall, closest_calls
from sim.explain.past import MOST_TICKS, Past, past
from sim.explain.scene import describe_percept
from sim.session.timeline import Timeline
from sim.types import Kind, Outcome

MAX_ENDS: Final = 3
"""Ends of episodes that are told one by one."""
TOLD_TTC_S: Final = 3.0
"""A time to collision above this, in seconds, is not told."""


class History:
    """Answers that are read off the timeline."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings
        self._figures = Figures(sayings)
        self._scenes = Scenes(sayings)

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        timeline, ask = asked.timeline, asked.ask
        facts: dict[str, Any] = {"what": ask.what}
        first, last = _stretch(asked)
        now = timeline.tick
        if first < 0:
            text = self._say("not_so_far_back", now=now)
        elif max(first, last) > now:
            text = self._say("no_such_tick", tick=max(first, last), now=now)
        elif last - first > MOST_TICKS:
            text = self._say("too_long", ticks=last - first, most=MOST_TICKS)
        elif ask.what == "seen":
            text = self._seen(timeline, first)
            facts |= {"first": first, "last": first}
        elif ask.what == "closest_call" and (ask.kind, ask.count) != (None, None):
            text, call = self._of_several(asked, first, last)
            facts |= {"closest_call": _call_json(call)}
        else:
            found = past(timeline, first, last)
            text = self._text(str(ask.what), found)
            if ask.what == "closest_call" and (ask.tick, ask.ticks) != (None, None):
                text = f"{self._header(found)} {text}"
            facts |= _json(found)
        return plain(self._sayings, ask, timeline.state, text) | facts

    def _seen(self, timeline: Timeline, tick: int) -> str:
        run = timeline.at(tick)
        scene = self._scenes.text(describe_percept(sense(run)[0], run.config), run, None)
        return self._say("seen", tick=tick, scene=scene)

    def _text(self, what: str, found: Past) -> str:
        """A stretch in sentences."""
        if what == "closest_call":
            if found.closest is None:
                return self._say("no_call" if found.ticks else "no_call_yet")
            return self._closest(found.closest)
        if not found.ticks:
            return self._say("nothing", tick=found.last.world.tick)
        told = [Part(0, self._episode(found) if what == "summary" else self._header(found))]
        if found.counted.steps:
            moves, way = self._figures.moves(found.counted), self._figures.distance(found.counted)
            told += [Part(0, moves), Part(3, way)]
        else:
            told.append(Part(0, self._say("still")))
        if what != "summary":
            told += [Part(0, each) for each in self._ends(found)]
        if found.changes:
            told.append(Part(2, self._many("changes", found.changes)))
        if found.closest is not None:
            told.append(Part(1, self._closest(found.closest)))
        return within(told)

    def _of_several(self, asked: Asked, first: int, last: int) -> tuple[str, ClosestCall | None]:
        """The closest call with a kind of things, or the second, the third … with another one each."""
        ask, number = asked.ask, asked.ask.count or 1
        kind = None if ask.kind is None else Kind(ask.kind)
        if kind is not None and not kind.moves:
            return self._say("not_moving", things=self._sayings.things(kind, 2)), None
        calls = closest_calls(asked.timeline.between(first, last + 1), kind)
        if number > len(calls):
            if kind is not None:
                return self._say("no_call_with", things=self._sayings.things(kind, 2)), None
            return self._say("no_such_call", "one" if len(calls) == 1 else "many", count=len(calls)), None
        return self._closest(calls[number - 1], "as_near"), calls[number - 1]

    def _header(self, found: Past) -> str:
        first, last = found.first.world.tick, found.last.world.tick
        return self._say("stretch", first=first, last=last, seconds=self._seconds(found))

    def _episode(self, found: Past) -> str:
        world = found.last.world
        facts = {"episode": world.episode, "ticks": found.ticks, "seconds": self._seconds(found)}
        if world.outcome is Outcome.RUNNING:
            return self._say("running_one" if found.ticks == 1 else "running", **facts)
        return self._say("ended", outcome=self._sayings.say("answers", "outcomes", world.outcome), **facts)

    def _ends(self, found: Past) -> list[str]:
        """How the episodes of a stretch ended, the first few one by one."""
        shown = found.ends[:MAX_ENDS]
        told = [self._say("ends", outcome, tick=tick) for tick, outcome in shown]
        more = len(found.ends) - len(shown)
        if more:
            told.append(self._say("one_more_end" if more == 1 else "more_ends", count=more))
        return told

    def _closest(self, call: ClosestCall, key: str | None = None) -> str:
        after = call.before.world.episode_tick
        seconds = in_seconds(self._sayings, after, call.before.config)
        soon = call.ttc_s is not None and call.ttc_s <= TOLD_TTC_S
        return self._say(
            key or ("closest_soon" if soon else "closest"),
            when=self._say("when", "later" if after else "start", after=seconds),
            who=Naming(self._sayings, call.before).thing(call.id),
            metres=self._sayings.number(round(call.gap_m, 1 if call.gap_m >= 1 else 2)),
            seconds=self._sayings.number(round(call.ttc_s or 0, 1)),
        )

    def _seconds(self, found: Past) -> str:
        return self._sayings.number(round(found.ticks * found.last.config.step_seconds, 2), ".10g")

    def _many(self, key: str, count: int) -> str:
        return self._say(key, "one" if count == 1 else "many", count=count)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("history", *keys, **parts)


def _stretch(asked: Asked) -> tuple[int, int]:
    """The first and the last tick that a question is about; they may not exist."""
    ask, now = asked.ask, asked.timeline.tick
    world = asked.timeline.state.world
    first = world.episode_start if ask.tick is None else ask.tick
    if ask.ticks is not None:
        first = now - ask.ticks
    match ask.what:
        case "closest_call" if ask.until is None and (ask.tick is not None or ask.ticks is not None):
            return first, now
        case "between" | "closest_call" if ask.until is not None:
            return first, ask.until
        case "seen":
            return first, first
        case "since":
            return first, now
    last = now if world.ended is None else world.ended
    middle = (first + last) // 2
    match ask.what:
        case "first_half":
            return first, middle
        case "second_half":
            return middle, last
        case _:
            return first, last


def _json(found: Past) -> Json:
    """The facts of a stretch as JSON values."""
    call, counted = found.closest, found.counted
    kinds = ("forward", "lateral", "diagonal", "stay")
    return {
        "first": found.first.world.tick,
        "last": found.last.world.tick,
        "moves": {kind: getattr(counted, kind) for kind in kinds},
        "distance_m": round(counted.distance_m, 3),
        "ends": [{"tick": tick, "outcome": outcome} for tick, outcome in found.ends],
        "roads": found.roads,
        "changes_said": found.changes,
        "closest_call": _call_json(call),
    }


def _call_json(call: ClosestCall | None) -> Json | None:
    if call is None:
        return None
    return {"tick": call.tick, "id": call.id, "gap_m": call.gap_m, "ttc_s": call.ttc_s}
