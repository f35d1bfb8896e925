"""Answers about several moves in a row: "if I go left and then straight on twice, do I survive?"."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from service.contract.encode.ahead import foresight_json
from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.charges import in_seconds
from service.narration.futures_told import end_told, yes_and_no
from service.narration.inflection import capital
from service.narration.move_list import moves_told
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from service.narration.supposed_ends import ARRIVES, FAILS
from service.sessions.facts import Asked
from sim.explain import QuestionError
from sim.explain.moves_in_order import MovesInOrder, moves_in_order
from sim.types import Move


class MovesAsked:
    """Answers to "what if I go left and then stay?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked, moves: Sequence[Move], tick: int | None) -> Json:
        """What comes of the moves from now or from a tick on: where they fail, or how it ends after them."""
        ask, timeline = asked.ask, asked.timeline
        try:
            found = moves_in_order(timeline, moves, tick)
        except QuestionError as error:
            return plain(self._sayings, ask, timeline.state, not_so(self._sayings, error.code, error.facts))
        parts = [
            Part(0, self._agreed(found, asked)),
            Part(1, "" if tick is None else self._sayings.say("whatif", "from_tick", tick=tick)),
            Part(0, self._told(found)),
            Part(2, self._since(found, tick)),
        ]
        return plain(self._sayings, ask, found.state, within(parts)) | {"moves_in_order": _json(found)}

    def _agreed(self, found: MovesInOrder, asked: Asked) -> str:
        """Yes or no, where that was asked and does not hang on chance."""
        words = yes_and_no(self._sayings, asked)
        share = None
        if asked.supposes == ARRIVES:
            share = 0.0 if found.then is None else found.then.arrives
        elif asked.supposes == FAILS:
            share = 1.0 if found.then is None else found.then.crashes
        if share not in (0.0, 1.0) or found.off_road:
            return ""
        return self._sayings.say("whatif", "yes_no", word=words["yes" if share else "no"])

    def _told(self, found: MovesInOrder) -> str:
        state = found.state
        moves = capital(moves_told(self._sayings, found.moves))
        if found.then is None:
            number = found.made + 1 if found.off_road else found.made
            parts: dict[str, Any] = {
                "moves": moves,
                "number": number,
                "move": self._sayings.move(found.moves[number - 1], "name"),
                "seconds": in_seconds(self._sayings, number, state.config),
            }
            if found.off_road:
                return self._say("off_road", **parts)
            ids = () if found.hit is None else found.hit.ids
            naming = Naming(self._sayings, found.last, as_seen=False)
            who = naming.things([name for name in ids if name != found.last.ego().id])
            return self._say("hit", who=who, **parts)
        end = end_told(self._sayings, found.then, since=state.world.tick)
        return self._say("arrived" if found.arrived else "free", moves=moves, end=end)

    def _since(self, found: MovesInOrder, tick: int | None) -> str:
        return self._sayings.say("whatif", "said_since", tick=tick) if found.said_since else ""

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("whatif", "moves", *keys, **parts)


def _json(found: MovesInOrder) -> Json:
    return {
        "moves": list(found.moves),
        "made": found.made,
        "off_road": found.off_road,
        "hit": None if found.hit is None else list(found.hit.ids),
        "then": None if found.then is None else foresight_json(found.then),
    }
