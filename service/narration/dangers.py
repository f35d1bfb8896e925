"""Answers about danger: what is most dangerous now, and the worst that may come within some ticks."""

from __future__ import annotations

from collections.abc import Sequence

from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.charges import in_seconds
from service.narration.futures_told import counted_told
from service.narration.inflection import capital
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain import QuestionError
from sim.explain.dangers import HORIZON, Danger, Dangers, WorstCase, dangers, worst_case
from sim.types import Kind, Move

DEFAULT_TICKS = 1
"""Ticks of "what is the worst that could happen next?"."""


class DangersTold:
    """Answers to "what is the most dangerous thing now?" and "what is the worst that could happen?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`. Where the drive has ended, that is the answer."""
        ask, timeline = asked.ask, asked.timeline
        try:
            if ask.what == "worst":
                worst = worst_case(timeline, self._ticks(asked))
                text, facts = self._worst(worst), _worst_json(worst)
            else:
                found = dangers(timeline, None if ask.kind is None else Kind(ask.kind))
                text, facts = self._dangers(found, ask.kind), _json(found)
        except QuestionError as error:
            told = not_so(self._sayings, error.code, error.facts)
            return plain(self._sayings, ask, timeline.state, told)
        return plain(self._sayings, ask, timeline.state, text) | {"what": ask.what} | facts

    def _ticks(self, asked: Asked) -> int:
        if asked.ask.seconds is not None:
            return max(1, round(asked.ask.seconds / asked.timeline.state.config.step_seconds))
        return asked.ask.ticks or DEFAULT_TICKS

    def _dangers(self, found: Dangers, kind: str | None) -> str:
        """The first with its moves and its time, whether the next move meets it, then the second."""
        config = found.state.config
        seconds = in_seconds(self._sayings, HORIZON, config)
        if not found.found:
            noun = self._say("anything") if kind is None else self._sayings.things(kind, 2)
            return self._say("none", things=noun, seconds=seconds)
        first = found.found[0]
        naming = Naming(self._sayings, found.state, as_seen=False)
        told = [Part(0, capital(self._say("first", who=naming.thing(first.id), met=self._met(found, first))))]
        if found.next_move is not None and first.hit_after is None:
            meets = found.next_move in first.all_moves
            doing = self._sayings.move(found.next_move, "name")
            told.append(Part(1, self._say("next", "meets" if meets else "clear", move=doing)))
        if len(found.found) > 1:
            second = found.found[1]
            met = self._met(found, second)
            told.append(Part(2, self._say("second", who=naming.thing(second.id), met=met)))
        return within([*told, Part(3, self._say("measure", seconds=seconds))])

    def _met(self, found: Dangers, each: Danger) -> str:
        config = found.state.config
        if each.hit_after is not None:
            return self._say("hit", seconds=in_seconds(self._sayings, each.hit_after, config))
        seconds = in_seconds(self._sayings, each.ticks, config)
        return self._say("met", moves=self._moves(each.moves), seconds=seconds)

    def _moves(self, moves: Sequence[Move]) -> str:
        return self._sayings.joined([self._sayings.move(each, "name") for each in moves])

    def _worst(self, found: WorstCase) -> str:
        """A crash or none, whatever the others do; then what comes by their rules."""
        config = found.state.config
        seconds = in_seconds(self._sayings, found.ticks, config)
        naming = Naming(self._sayings, found.state, as_seen=False)
        if found.may_crash:
            sure = in_seconds(self._sayings, found.sure.ticks, config)
            key = "crash" if found.sure.ticks else "crash_at_once"
            told = [Part(0, self._say("worst", key, sure=sure, seconds=seconds))]
        else:
            told = [Part(0, self._say("worst", "clear", seconds=seconds))]
            risky = found.sure_after is not None and not found.sure_after.to_the_end
            if risky and found.sure_after is not None and found.sure_after.ticks < found.ticks:
                sure = in_seconds(self._sayings, found.sure_after.ticks, config)
                move = self._sayings.move(found.next_move or Move.STAY, "name")
                key = "not_by_mine" if found.sure_after.ticks else "not_mine"
                told.append(Part(1, self._say("worst", key, move=move, sure=sure)))
        if found.may_hit:
            who = naming.things(found.may_hit)
            told.append(Part(2, self._say("worst", "who", who=who)))
        return within([*told, Part(1, self._by_rules(found))])

    def _by_rules(self, found: WorstCase) -> str:
        coming = found.by_rules
        key = {0.0: "clear", 1.0: "crash"}.get(coming.crashes, "chance")
        share = counted_told(self._sayings, coming.crashes, coming.futures)
        return self._say("by_rules", key, share=share)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("dangers", *keys, **parts)


def _json(found: Dangers) -> Json:
    return {
        "horizon": HORIZON,
        "next_move": found.next_move,
        "dangers": [
            {
                "id": each.id,
                "kind": each.kind,
                "ticks": each.ticks,
                "moves": list(each.moves),
                "all_moves": list(each.all_moves),
                "hit_after": each.hit_after,
            }
            for each in found.found
        ],
    }


def _worst_json(found: WorstCase) -> Json:
    return {
        "ticks": found.ticks,
        "may_crash": found.may_crash,
        "sure_ticks": found.sure.ticks,
        "sure_to_the_end": found.sure.to_the_end,
        "next_move": found.next_move,
        "sure_ticks_after_it": None if found.sure_after is None else found.sure_after.ticks,
        "may_hit": list(found.may_hit),
        "crashes_by_rules": found.by_rules.crashes,
    }
