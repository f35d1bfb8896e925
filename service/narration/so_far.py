"""Answers about the drive so far with something otherwise: "would Dijkstra have driven the same so far?"."""

from __future__ import annotations

from typing import Final

from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.futures_told import yes_and_no
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.actions import Set
from sim.explain import QuestionError
from sim.explain.so_far import SoFar, so_far
from sim.planner_names import canonical
from sim.state import SimState
from sim.types import Outcome

SAME: Final = "same"
DIFFERS: Final = "differs"
CLEAR: Final = "clear"
"""What a question supposes: the same moves, other ones, or that nothing is hit."""
CRASHES: Final = "crashes"


class DrivesSoFar:
    """The drive driven again from its start, beside what it really was."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, timeline = asked.ask, asked.timeline
        state = timeline.state
        change = ask.change or ()
        varied: dict[str, str | float] = {}
        for each in change:
            if isinstance(each, Set):
                varied[each.parameter] = str(each.value) if isinstance(each.value, str) else 0.0
        if "planner" in varied:
            varied["planner"] = str(canonical(varied["planner"]))
        try:
            found = so_far(timeline, varied)
        except QuestionError as error:
            return plain(self._sayings, ask, state, self._not_so(error)) | {"what": ask.what}
        parts = [
            Part(0, self._first(found, asked)),
            Part(0, self._moves(found)),
            Part(0, self._led_to(found, state)),
            Part(1, self._really(state)),
            Part(2, self._say("by_hand") if found.by_hand else ""),
            Part(3, "" if state.config.certain else self._say("by_chance")),
        ]
        return plain(self._sayings, ask, state, within(parts)) | {"what": ask.what, "so_far": _json(found)}

    def _not_so(self, error: QuestionError) -> str:
        if error.code == "no_such_planner":
            name = self._sayings.quoted(str(error.facts["planner"]))
            return self._sayings.say("planners", "missing", names=name)
        return not_so(self._sayings, error.code, error.facts)

    def _first(self, found: SoFar, asked: Asked) -> str:
        """Yes or no, to what was supposed."""
        crashed = found.outcome is Outcome.CRASH
        agreed = {SAME: found.same, DIFFERS: not found.same, CLEAR: not crashed, CRASHES: crashed}
        supposes = str(asked.supposes)
        if supposes not in agreed:
            return ""
        word = yes_and_no(self._sayings, asked)["yes" if agreed[supposes] else "no"]
        return self._sayings.say("whatif", "yes_no", word=word)

    def _moves(self, found: SoFar) -> str:
        """Whether the moves are the same, and where the first is another one."""
        how = self._sayings.joined([self._with(name, value) for name, value in found.varied.items()])
        differs = found.differs
        if differs is None:
            key = "one" if found.compared == 1 else "many"
            return self._say("same" if found.same else "same_until", key, how=how, count=found.compared)
        return self._say(
            "differs",
            how=how,
            tick=differs.tick,
            would=self._sayings.move(differs.would, "name"),
            made=self._sayings.move(differs.made, "name"),
        )

    def _with(self, name: str, value: str | float) -> str:
        match name, value:
            case "planner", str():
                return self._say("with", "planner", planner=self._sayings.planner(value, "with"))
            case _, str():
                return self._say("with", name, value)
        return self._say("with", name)

    def _led_to(self, found: SoFar, state: SimState) -> str:
        """What it led to by then, or in the end."""
        if found.same and state.world.outcome is found.outcome:
            return ""
        rows = abs(found.rows)
        place = "level" if not rows else "ahead" if found.rows > 0 else "behind"
        form = "one" if rows == 1 else "many"
        told = self._say("place", place, form, count=rows)
        a = "" if found.hit is None else self._sayings.say("words", "a", found.hit)
        return self._say("led_to", str(found.outcome), tick=found.tick, place=told, a=a)

    def _really(self, state: SimState) -> str:
        """How the real drive ended, where it has."""
        world = state.world
        if world.outcome is Outcome.RUNNING:
            return ""
        return self._say("really", str(world.outcome), tick=world.ended)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("so_far", *keys, **parts)


def _json(found: SoFar) -> Json:
    differs = found.differs
    return {
        "settings": dict(found.varied),
        "same": found.same,
        "moves": found.moves,
        "differs": None
        if differs is None
        else {"tick": differs.tick, "made": differs.made, "would": differs.would},
        "outcome": found.outcome,
        "tick": found.tick,
        "rows_ahead": found.rows,
    }
