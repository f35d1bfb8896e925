"""Answers to "when will you stop next?" and "when will you change lanes next?"."""

from __future__ import annotations

from service.contract.encode.ahead import coming_turn_json
from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.charges import in_seconds
from service.narration.futures_told import end_told
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain import QuestionError
from sim.explain.coming_turn import LANE_CHANGES, STOPS, ComingTurn, coming_turn
from sim.explain.foresight import Foresight
from sim.types import Mode, Move, Outcome, kind_of


class ComingTurns:
    """Answers about the next stop and the next change of lanes, if the planner drives."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`. Where the episode has ended, that is the answer."""
        ask, state = asked.ask, asked.timeline.state
        stop = ask.what == "next_stop"
        try:
            found = coming_turn(asked.timeline, STOPS if stop else LANE_CHANGES)
        except QuestionError as error:
            return plain(self._sayings, ask, state, not_so(self._sayings, error.code, error.facts))
        text = self._text(found, "stop" if stop else "lane")
        if state.mode is Mode.MANUAL:
            text = f"{self._sayings.say('ahead', 'by_hand')} {text}"
        return plain(self._sayings, ask, state, text) | {"what": ask.what} | coming_turn_json(found)

    def _text(self, found: ComingTurn, table: str) -> str:
        """In how many seconds, and for whom; or that there is none, and how it ends."""
        chance = self._say("chance") if found.chance else ""
        if not found.known:
            return self._say(table, "unknown")
        if found.after is None or found.move is None:
            end = end_told(self._sayings, Foresight(found.state, found.story, None))
            return within([Part(0, self._say(table, "none", end=end)), Part(1, chance)])
        key = "later" if found.after else "now"
        seconds = in_seconds(self._sayings, found.after, found.state.config)
        tick = found.state.world.tick + found.after
        side = (
            ""
            if found.move is Move.STAY
            else self._say("sides", "left" if found.move.offset[0] < 0 else "right")
        )
        told = [Part(0, self._say(table, key, seconds=seconds, tick=tick, side=side))]
        if found.detour is not None and found.detour.ids:
            a = self._sayings.say("words", "a", kind_of(found.detour.ids[0]))
            told.append(Part(1, self._say("for", a=a)))
        if found.story.outcome is not Outcome.RUNNING:
            end = end_told(self._sayings, Foresight(found.state, found.story, None))
            form = "only" if found.count == 1 else "more"
            told.append(Part(2, self._say(table, form, count=found.count, end=end)))
        return within([*told, Part(1, chance)])

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("coming_turn", *keys, **parts)
