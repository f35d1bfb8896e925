"""Answers about this world beside the real one: real cars, safety in general, who made the rules."""

from __future__ import annotations

from service.narration.answer_length import Part, within
from service.narration.answerer import Json, plain
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain.planner_character import character_of
from sim.explain.planners import planner_of
from sim.perceive.registry import sensor_named
from sim.planner_names import BUILT_IN
from sim.state import SimState
from sim.types import Outcome


class WorldTruths:
    """Answers to "are self-driving cars safe?", "are there airbags?", "is the goal the whole row?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, state = asked.ask, asked.timeline.state
        text, facts = {
            "real_car": self._real_car,
            "general_safety": self._general_safety,
            "safety_gear": self._safety_gear,
            "car_talk": self._car_talk,
            "rule_makers": self._rule_makers,
            "all_lanes": self._all_lanes,
        }[str(ask.what)](state)
        return plain(self._sayings, ask, state, text) | {"what": ask.what} | facts

    def _real_car(self, state: SimState) -> tuple[str, Json]:
        """That no real car is simulated, and what this one leaves out."""
        told = [Part(0, self._say("real_car", "unknown")), Part(0, self._say("real_car", "without"))]
        if state.world.outcome is Outcome.STUCK:
            told.append(Part(1, self._say("real_car", "stuck")))
        return within(told), {}

    def _general_safety(self, state: SimState) -> tuple[str, Json]:
        """That only this simulation is known, with what was counted in it."""
        name, metrics = planner_of(state), state.metrics
        told, found = [Part(0, self._say("general_safety", "unknown"))], character_of(name)
        facts: Json = {"episodes": metrics.episodes, "crashes": metrics.crashes, "planner": name}
        if found is not None:
            share = self._sayings.number(100 * found.crashed / found.roads, ".2g")
            facts |= {"roads": found.roads, "crashed": found.crashed}
            roads = self._sayings.number(found.roads, ",d")
            planner = self._sayings.planner(name)
            told.append(
                Part(1, self._say("general_safety", "counted", roads=roads, planner=planner, share=share))
            )
        if metrics.episodes:
            key = "one" if metrics.episodes == 1 else "many"
            counts = {"episodes": metrics.episodes, "crashes": metrics.crashes}
            told.append(Part(2, self._say("general_safety", "session", key, **counts)))
        return within(told), facts

    def _safety_gear(self, state: SimState) -> tuple[str, Json]:  # noqa: ARG002 -- it is the same of every session
        return self._say("safety_gear"), {}

    def _car_talk(self, state: SimState) -> tuple[str, Json]:
        """That nobody tells anybody anything, but for several egos; and what the ego knows of the others."""
        several, faithful = len(state.world.avs) > 1, sensor_named(state.config.sensor).faithful
        told = [Part(0, self._say("car_talk", "never"))]
        if several:
            told.append(Part(0, self._say("car_talk", "several")))
        told.append(Part(1, self._say("car_talk", "perfect" if faithful else "errs")))
        return within(told), {"several": several}

    def _rule_makers(self, state: SimState) -> tuple[str, Json]:
        """Whose the rules are, and what can be changed of them."""
        name = planner_of(state)
        own = name in BUILT_IN
        told = [
            self._say(
                "rule_makers", "built_in" if own else "package", planner=self._sayings.planner(name, "id")
            )
        ]
        return (
            f"{told[0]} {self._say('rule_makers', 'change', example=self._say('rule_makers', 'example'))}",
            {"built_in": own},
        )

    def _all_lanes(self, state: SimState) -> tuple[str, Json]:
        columns = state.world.road.columns
        return self._say("all_lanes", columns=columns), {"columns": columns}

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("world_truths", *keys, **parts)
