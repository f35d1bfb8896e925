"""How planners differ in general: by what each chooses, and how often each arrived on the same roads."""

from __future__ import annotations

from service.contract.encode.planners import character_json
from service.narration.answer_length import Part, within
from service.narration.answerer import Json, plain
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain.planner_character import Character, character_of
from sim.explain.planners import planner_of
from sim.planner_names import canonical


class PlannerDifferences:
    """Answers to "what is the difference between A* and Dijkstra?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`. One planner alone is compared with the one that drives."""
        ask, state = asked.ask, asked.timeline.state
        names = list(dict.fromkeys(canonical(name) for name in ask.planners or ()))
        if len(names) == 1 and (own := planner_of(state)) not in names:
            names.append(own)
        told = [Part(0 if at < 2 else 2, self._method(name)) for at, name in enumerate(names)]
        found = {name: character_of(name) for name in names}
        counted = {name: each for name, each in found.items() if each is not None}
        if len(names) == 1:
            told.insert(0, Part(0, self._say("same", planner=self._sayings.planner(names[0]))))
        elif len(counted) == len(names):
            told.append(Part(1, self._arrivals(counted)))
        facts = {name: character_json(each) for name, each in found.items()}
        return plain(self._sayings, ask, state, within(told)) | {"what": ask.what, "planners": facts}

    def _method(self, name: str) -> str:
        """By what a planner chooses, as the glossary has it."""
        text = self._sayings.value("glossary", "terms", name, "text")
        if text is None:
            return self._sayings.say("planners", "no_method", planner=self._sayings.planner(name))
        return str(text)

    def _arrivals(self, counted: dict[str, Character]) -> str:
        """On how many of the same roads each arrived."""
        shares = [
            self._say("one", planner=self._sayings.planner(name), arrived=self._percent(each))
            for name, each in counted.items()
        ]
        roads = next(iter(counted.values())).roads
        told = self._sayings.joined(shares)
        return self._say("arrived", roads=self._sayings.number(roads, ",d"), told=told)

    def _percent(self, found: Character) -> str:
        return self._sayings.number(100 * found.arrived / found.roads, ".1f")

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("planners_differ", *keys, **parts)
