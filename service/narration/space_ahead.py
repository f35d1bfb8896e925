"""Answers about the space to come: whether it stays free beside or ahead, and where the vehicle will be."""

from __future__ import annotations

from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.charges import in_seconds
from service.narration.futures_told import CONTRARY, counted_told, end_told, yes_and_no
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain.foresight import Foresight
from sim.explain.place_then import PlaceThen, place_then
from sim.explain.question_error import QuestionError
from sim.explain.stays_free import StaysFree, stays_free
from sim.types import Mode, Move

OWN_REFUSALS = ("no_lane_there", "too_far_ahead")
"""Refusals whose words stand among those of the space ahead."""


class SpaceAhead:
    """Answers to "does the lane to my left stay free?" and "where will we be in two seconds?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`. Where the drive has ended, that is the answer."""
        ask, timeline = asked.ask, asked.timeline
        try:
            if ask.what == "stays_free":
                free = stays_free(timeline, Move(ask.move or Move.FORWARD), self._ticks(asked))
                text, facts = self._free(free, asked), _free_json(free)
            else:
                tick = timeline.tick + (self._ticks(asked) or 1) if ask.tick is None else ask.tick
                place = place_then(timeline, tick)
                text, facts = self._place(place, asked), _place_json(place)
                if not place.past and timeline.state.mode is Mode.MANUAL:
                    text = f"{self._sayings.say('ahead', 'by_hand')} {text}"
        except QuestionError as error:
            if error.code in OWN_REFUSALS:
                side = str(error.facts.get("move", "forward"))
                parts = {key: value for key, value in error.facts.items() if key != "move"}
                if isinstance(ticks := parts.get("ticks"), int):
                    parts["ticks"] = self._counted(ticks)
                told = self._say(error.code, side=self._say("sides", side), **parts)
            else:
                told = not_so(self._sayings, error.code, error.facts)
            return plain(self._sayings, ask, timeline.state, told) | {"what": ask.what}
        return plain(self._sayings, ask, timeline.state, text) | {"what": ask.what} | facts

    def _ticks(self, asked: Asked) -> int | None:
        if asked.ask.seconds is not None:
            return max(1, round(asked.ask.seconds / asked.timeline.state.config.step_seconds))
        return asked.ask.ticks

    def _free(self, found: StaysFree, asked: Asked) -> str:
        """Yes or no, for how long, what comes, and the share of futures in which nothing does."""
        words = yes_and_no(self._sayings, asked)
        config, naming = found.state.config, Naming(self._sayings, found.state, as_seen=False)

        def seconds(ticks: int) -> str:
            return in_seconds(self._sayings, ticks, config)

        where = self._say("cells", str(found.move))
        if found.taken_now is not None:
            key = "no_gap" if asked.supposes == CONTRARY else "taken"
            told = self._say("free", key, where=where, who=naming.thing(found.taken_now), **words)
            after = found.frees_after
            key = "never" if after is None else "frees"
            more = self._say(
                "free", key, seconds=seconds(after or found.ticks), ticks=self._counted(after or found.ticks)
            )
            return within([Part(0, told), Part(0, more)])
        facts = {"where": where, "seconds": seconds(found.free_for), "ticks": self._counted(found.free_for)}
        if found.stays:
            told = self._say("free", "stays", **facts, **words)
        elif found.hit is not None:
            told = self._say("free", "hit", **facts, **words)
        else:
            key = "one" if found.free_for == 1 else "comes" if found.free_for else "at_once"
            told = self._say("free", key, who=naming.thing(found.comes or ""), **facts, **words)
        parts = [Part(0, told)]
        if found.futures is not None:
            share = counted_told(self._sayings, found.share, found.futures)
            parts.append(Part(1, self._say("free", "share", share=share)))
        return within([*parts, Part(2, self._say("free", "measure"))])

    def _counted(self, ticks: int) -> str:
        return self._say("ticks", "one" if ticks == 1 else "many", count=ticks)

    def _place(self, found: PlaceThen, asked: Asked) -> str:
        """Lane and row, or that it is over by then; and how likely that is."""
        config = asked.timeline.state.config
        ahead = found.tick - asked.timeline.tick
        facts = {"tick": found.tick, "seconds": in_seconds(self._sayings, max(0, ahead), config)}
        if found.cell is not None:
            key = "was" if found.past else "will_be"
            told = self._say("place", key, lane=found.cell[0] + 1, row=found.cell[1], **facts)
        else:
            assert found.story is not None
            told = self._say(
                "place",
                "over",
                end=end_told(self._sayings, Foresight(found.state, found.story, None)),
                **facts,
            )
        parts = [Part(0, told)]
        if not found.past and not found.state.config.certain:
            share = counted_told(self._sayings, found.share, found.futures)
            parts.append(Part(1, self._say("place", "share", share=share)))
        return within(parts)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("space_ahead", *keys, **parts)


def _free_json(found: StaysFree) -> Json:
    return {
        "move": found.move,
        "ticks": found.ticks,
        "taken_now": found.taken_now,
        "free_for": found.free_for,
        "comes": found.comes,
        "hit_by": found.hit,
        "frees_after": found.frees_after,
        "share": found.share,
        "futures": found.futures,
    }


def _place_json(found: PlaceThen) -> Json:
    return {
        "of": found.tick,
        "lane": None if found.cell is None else found.cell[0] + 1,
        "row": None if found.cell is None else found.cell[1],
        "share": found.share,
        "futures": found.futures,
    }
