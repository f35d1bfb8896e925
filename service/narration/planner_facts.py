"""Answers about how a planner decides: how far ahead, among equals, in what order, at what cost."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from service.narration.answer_length import Part, within
from service.narration.answerer import Json, plain
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.config import Config
from sim.explain.planners import planner_of
from sim.perceive.registry import sensor_named
from sim.plan import traits_of
from sim.planner_names import canonical
from sim.search.costs import weights
from sim.state import SimState
from sim.types import Move

MANNERS: Final[Mapping[str, str]] = {
    "rules": "rules",
    "priority": "priority",
    "astar": "costs",
    "dijkstra": "costs",
    "bfs": "time",
}
"""By what the built-in planners decide; of any other it is not known."""


class PlannerFacts:
    """Answers to "how far do you look ahead?", "what costs what?", "do you replan every tick?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`. Without a planner's name the one that drives is meant."""
        ask, state = asked.ask, asked.timeline.state
        name = canonical(ask.planner or planner_of(state))
        if name not in MANNERS:
            text = self._say("unknown", planner=self._sayings.planner(name))
            return plain(self._sayings, ask, state, text) | {"what": ask.what, "planner": name}
        text, facts = self._told(str(ask.what), name, state)
        return plain(self._sayings, ask, state, text) | {"what": ask.what, "planner": name} | facts

    def _told(self, what: str, name: str, state: SimState) -> tuple[str, Json]:
        if what == "costs":
            return self._costs(name, state.config)
        if what == "prediction":
            return self._prediction(name, state)
        if what == "heuristic":
            return self._heuristic(name, state.config)
        parts = {
            "planner": self._sayings.planner(name),
            "moves": self._sayings.joined([self._sayings.move(move, "name") for move in Move]),
            "limit": state.config.max_ticks,
        }
        manner = MANNERS[name]
        return self._say(what, manner, **parts), {"manner": manner}

    def _costs(self, name: str, config: Config) -> tuple[str, Json]:
        """The charges of a step with the preferences of the session."""
        manner, planner = MANNERS[name], self._sayings.planner(name)
        if manner != "costs":
            return self._say("costs", manner, planner=planner), {"charges": None}
        found = weights(config)
        charges = {key: getattr(found, key) for key in ("sideways", "diagonal", "stay", "fixed")}
        said = {key: charge for key, charge in charges.items() if charge}
        if found.buffer and found.mover:
            said["mover" if found.buffer == 1 else "mover_far"] = found.mover
        if found.doubt and not sensor_named(config.sensor).faithful:
            said["doubt"] = found.doubt
        listed = [
            self._say("costs", "charged", key, charge=charge, buffer=found.buffer)
            for key, charge in said.items()
        ]
        text = self._say("costs", "costs", planner=planner, tick=found.tick)
        if listed:
            text = f"{text} {self._say('costs', 'extra', listed=self._sayings.joined(listed))}"
        return f"{text} {self._say('costs', 'cheapest')}", {"charges": {"tick": found.tick, **said}}

    def _heuristic(self, name: str, config: Config) -> tuple[str, Json]:
        """The lower bound by which A* searches; that the others have none."""
        if name != "astar":
            key = name if name == "dijkstra" else MANNERS[name]
            return self._say("heuristic", key, planner=self._sayings.planner(name)), {"least": None}
        found = weights(config)
        least = min(found.of(move) for move in Move if move.offset[1] < 0)
        told = self._say("heuristic", "astar", planner=self._sayings.planner(name), least=least)
        return told, {"least": least}

    def _prediction(self, name: str, state: SimState) -> tuple[str, Json]:
        """What is known of others for the coming tick, what is foretold beyond it, what cannot be known."""
        config = state.config
        faithful = sensor_named(config.sensor).faithful
        far = traits_of(name).plans_to_goal
        told = [
            Part(0, self._say("prediction", "known" if faithful else "believed")),
            Part(1, self._say("prediction", "further" if far else MANNERS[name])),
        ]
        if config.mover_behaviour.draws(config) and far:
            told.append(Part(2, self._say("prediction", "chance")))
        return within(told), {"faithful": faithful, "further": far}

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("planner_facts", *keys, **parts)
