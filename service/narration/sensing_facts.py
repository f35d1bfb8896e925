"""Answers about sensing in general: memory, cells out of sight, chances of detection."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Final

from service.narration.answer_length import Part, within
from service.narration.answerer import Json, plain
from service.narration.sayings import Sayings
from service.narration.sensing_compared import conditions_said
from service.narration.values import conditions_of, value_of
from service.sessions.facts import Asked
from sim.config import Config
from sim.explain.planners import planner_of
from sim.perceive.detection import detection_chance
from sim.perceive.parameters import SUITES
from sim.perceive.registry import sensor_named
from sim.plan import traits_of
from sim.state import SimState
from sim.types import Kind

NEAR_CELLS, FAR_CELLS = 3, 10
"""Distances that chances of detection are told for."""
ONE_BY_ONE: Final = (Kind.VEHICLE, Kind.PEDESTRIAN, Kind.POTHOLE)
"""Kinds that are told of where none is named."""
ALMOST_ALL = 99.9
"""Percent that less than all is never told to exceed."""


class SensingFacts:
    """Answers to "do you remember what you saw?", "does radar detect pedestrians?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, state = asked.ask, asked.timeline.state
        if ask.what == "detection":
            text, facts = self._detection(asked)
        else:
            tell = {"memory": self._memory, "unseen": self._unseen, "combining": self._combining}
            text, facts = tell[str(ask.what)](state)
        return plain(self._sayings, ask, state, text) | {"what": ask.what} | facts

    def _memory(self, state: SimState) -> tuple[str, Json]:
        sensor = state.config.sensor
        found = sensor_named(sensor)
        if not found.stateless and sensor not in SUITES:
            return self._say("unknown", sensor=sensor), {"sensor": sensor, "remembers": True}
        key = "perfect" if found.faithful else "none" if found.stateless else "belief"
        return self._say("memory", key), {"sensor": sensor, "remembers": not found.stateless}

    def _unseen(self, state: SimState) -> tuple[str, Json]:
        """From which likelihood on a thing is heeded, and whether a doubtful cell costs more."""
        config = state.config
        if sensor_named(config.sensor).faithful:
            return self._say("unseen", "perfect"), {"threshold": None}
        if config.sensor not in SUITES:
            return self._say("unknown", sensor=config.sensor), {"threshold": None}
        threshold = 1.0 - config.detection_sensitivity
        name = planner_of(state)
        key = "weighs" if traits_of(name).weighs_costs else "heedless"
        told = [
            Part(0, self._say("unseen", "threshold", percent=self._percent(threshold))),
            Part(1, self._say("unseen", "prior")),
            Part(2, self._say("unseen", key, planner=self._sayings.planner(name))),
        ]
        return within(told), {"threshold": threshold}

    def _detection(self, asked: Asked) -> tuple[str, Json]:
        """The chance that one look detects a kind of things near by and farther off, or at a distance.

        Of each sensor or of the one that is named; of one sensor and no kind, of the kinds one by one.
        """
        ask, words = asked.ask, (asked.supposes or "").split()
        config, supposed = conditions_said(asked.timeline.state.config, words)
        sensors = list(SUITES) if ask.value is None else [str(ask.value)]
        kinds = list(ONE_BY_ONE) if ask.kind is None else [Kind(ask.kind)]
        named = next((int(each) for each in words if each.isdigit()), None)
        cells = (NEAR_CELLS, FAR_CELLS) if named is None else (named,)
        metres = [each * config.cell_m for each in cells]
        told, chances = [], {}
        for kind in kinds:
            found = {
                name: [detection_chance(replace(config, sensor=name), kind, each) or 0.0 for each in metres]
                for name in sensors
            }
            chances[kind.value] = found
            told.append(self._told(kind, found, metres, config))
        told += [self._say("detection", "perfect"), self._say("detection", "each_tick")]
        text = within(Part(rank, each) for rank, each in enumerate(told))
        first = {"kind": kinds[0], "chances": chances[kinds[0].value]} if ask.kind is not None else {}
        return text, {"metres": metres, "chances_by_kind": chances} | first | supposed

    def _told(
        self, kind: Kind, found: Mapping[str, Sequence[float]], metres: Sequence[float], config: Config
    ) -> str:
        listed = [
            self._say(
                "detection",
                "one" if len(chances) > 1 else "at",
                sensor=value_of(self._sayings, "sensor", name),
                near=self._percent(chances[0]),
                far=self._percent(chances[-1]),
            )
            for name, chances in found.items()
        ]
        conditions = conditions_of(self._sayings, replace(config, sensor="perfect"))
        return self._say(
            "detection",
            "told" if len(metres) > 1 else "told_at",
            a=self._sayings.say("words", "a", kind),
            near=self._sayings.number(metres[0]),
            far=self._sayings.number(metres[-1]),
            conditions=conditions or self._sayings.say("sensing_compared", "plain"),
            listed=self._sayings.listed(listed),
        )

    def _combining(self, state: SimState) -> tuple[str, Json]:
        fused = state.config.sensor == "fusion"
        told = [self._say("combining", "how")]
        if not fused:
            sensor = value_of(self._sayings, "sensor", state.config.sensor)
            told.append(self._say("combining", "not_now", sensor=sensor))
        return " ".join(told), {"fused": fused}

    def _percent(self, share: float) -> str:
        return self._sayings.number(round(min(100 * share, ALMOST_ALL) if share < 1 else 100, 1))

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("sensing_facts", *keys, **parts)
