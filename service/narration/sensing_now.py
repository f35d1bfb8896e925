"""Answers about one sensor at work: what weather does to it, what it got wrong, single cells, another one."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Final, get_args

from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.inflection import capital
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from service.narration.values import conditions_of, value_of
from service.sessions.facts import Asked
from sim.actions import TimeOfDay, Weather
from sim.config import Config
from sim.explain import QuestionError
from sim.explain.cell_belief import cell_belief, unknown_cells
from sim.explain.condition_effect import ConditionEffect, condition_effect
from sim.explain.sensing_errors import SensingErrors, sensing_errors
from sim.explain.would_see import would_see
from sim.perceive.registry import sensor_named
from sim.types import Kind, Move

CLEAR, DAY = "clear", "day"
AGREE, ALARMS, MISSED = "agree", "alarms", "missed"
"""What of the errors of a drive is asked for first (`Asked.supposes`)."""
TAKEN: Final = "taken"
"""What of a cell is asked for, where it is not how likely it is free."""
FEW_PERCENT, ALMOST_ALL = 0.1, 99.9
"""Percent between which shares are told that are neither nothing nor all."""
SAYS: Final = 0.5
"""The chance of one look from which on a sensor is said to see a thing."""


class SensingNow:
    """Answers to "what does fog do to the camera?", "were there false alarms?", "what is unknown?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, state = asked.ask, asked.timeline.state
        tell = {
            "effect": self._effect,
            "errors": self._errors,
            "cell": self._cell,
            "unknown": self._unknown,
            "would_see": self._would_see,
        }[str(ask.what)]
        try:
            text, facts = tell(asked)
        except QuestionError as error:
            return plain(self._sayings, ask, state, not_so(self._sayings, error.code, error.facts))
        return plain(self._sayings, ask, state, text) | {"what": ask.what} | facts

    def _effect(self, asked: Asked) -> tuple[str, Json]:
        """How far and how surely things are detected with what is named, else what holds, and without."""
        config, words = self._with_sensor(asked), (asked.supposes or "").split()
        weather = next((each for each in get_args(Weather) if each in words and each != CLEAR), None)
        light = next((each for each in get_args(TimeOfDay) if each in words and each != DAY), None)
        if weather is None and light is None:
            weather = config.weather if config.weather != CLEAR else None
            light = config.time_of_day if config.time_of_day != DAY else None
        sensor = value_of(self._sayings, "sensor", config.sensor)
        if sensor_named(config.sensor).faithful:
            return self._say("effect", "perfect"), {"changes": False}
        if weather is None and light is None:
            return self._say("effect", "plain", sensor=sensor), {"changes": False}
        found = condition_effect(config, weather, light)
        if found is None:
            return self._say("unknown_sensor", sensor=config.sensor), {"changes": None}
        named = [self._say("conditions", each) for each in (weather, light) if each is not None]
        now = asked.timeline.state.config
        absent = [each for each in (weather, light) if each not in (None, now.weather, now.time_of_day)]
        told = [Part(0, self._say("effect", "not_now"))] if absent else []
        told += self._effect_parts(found, config, sensor=sensor, conditions=self._sayings.joined(named))
        half = {"with": dict(found.now.half), "without": dict(found.without.half)}
        return within(told), {
            "changes": found.changes,
            "sensor": config.sensor,
            "half_detected_cells": {
                key: {kind.value: n for kind, n in each.items()} for key, each in half.items()
            },
        }

    def _effect_parts(
        self, found: ConditionEffect, config: Config, *, sensor: str, conditions: str
    ) -> list[Part]:
        if not found.changes:
            told = [Part(0, self._say("effect", "nothing", sensor=sensor, conditions=conditions))]
        else:
            half = [
                self._say(
                    "effect",
                    "half" if found.now.half[kind] < found.without.half[kind] else "half_same",
                    a=self._sayings.say("words", "a", kind),
                    now=self._metres(found.now.half[kind] * config.cell_m),
                    without=self._metres(found.without.half[kind] * config.cell_m),
                )
                for kind in (Kind.VEHICLE, Kind.POTHOLE)
                if found.without.half[kind]
            ]
            listed = self._sayings.joined(half)
            told = [
                Part(0, self._say("effect", "told", sensor=sensor, conditions=conditions, listed=listed)),
                Part(
                    1,
                    self._say(
                        "effect",
                        "reach",
                        now=self._metres(found.now.metres),
                        without=self._metres(found.without.metres),
                    )
                    if found.now.metres < found.without.metres
                    else "",
                ),
                Part(2, self._near(found)),
            ]
        if found.more_alarms:
            told.append(Part(2, self._say("effect", "alarms")))
        return told

    def _near(self, found: ConditionEffect) -> str:
        now, without = found.chances[Kind.VEHICLE]
        if now == without:
            return ""
        return self._say(
            "effect",
            "near",
            metres=self._metres(found.near_m),
            now=self._percent(now),
            without=self._percent(without),
        )

    def _errors(self, asked: Asked) -> tuple[str, Json]:
        """What was wanted first: in how many ticks it was right, false alarms, or misses; then the rest."""
        found = sensing_errors(asked.timeline)
        facts = {
            "ticks": found.ticks,
            "right": found.right,
            "imagined": found.imagined,
            "missed": found.missed,
            "false_alarms": found.alarms,
            "things_in_reach": found.things,
            "seen_in_reach": found.seen,
        }
        if found.faithful:
            return self._say("errors", "perfect", ticks=found.ticks), facts
        words = (asked.supposes or "").split()
        right = self._say(
            "errors",
            "right",
            count=found.right,
            ticks=found.ticks,
            percent=self._percent(found.right / found.ticks),
        )
        missed = self._say("errors", "missed" if found.missed else "none_missed", count=found.missed)
        if found.missed:
            missed = (
                f"{missed} {self._say('errors', 'share', percent=self._percent(found.seen / found.things))}"
            )
        alarms = self._alarms(found)
        if ALARMS in words:
            told = [self._yes(found.alarms or found.imagined), alarms, right]
        elif MISSED in words:
            told = [self._yes(found.missed), missed, right]
        elif AGREE in words:
            told = [right, missed, alarms]
        else:
            told = [self._yes(found.right < found.ticks), missed, alarms, right]
        return within(Part(at, text) for at, text in enumerate(told)), facts

    def _alarms(self, found: SensingErrors) -> str:
        if not found.imagined:
            return self._say("errors", "none_imagined")
        if not found.alarms:
            return self._say("errors", "misplaced", count=found.imagined)
        listed = [
            self._say("errors", "counted", count=count, things=self._sayings.things(kind, count))
            for kind, count in found.kinds
        ]
        return self._say("errors", "imagined", count=found.imagined, listed=self._sayings.joined(listed))

    def _yes(self, so: object) -> str:
        return self._say("first", answer=self._sayings.say("ahead", "answer", "agree" if so else "disagree"))

    def _cell(self, asked: Asked) -> tuple[str, Json]:
        """How likely a cell is free as the sensor has it, and what is there in truth."""
        state, move = asked.timeline.state, Move(asked.ask.move or Move.FORWARD)
        found = cell_belief(state, move)
        where = self._say("cells", move)
        facts = {
            "cell": None if found.cell is None else list(found.cell),
            "taken": found.taken,
            "shown": found.shown,
            "really": found.truth,
        }
        if found.cell is None:
            return self._say("cell", "off_road", where=where), facts
        truth = self._say("cell", "really_free")
        if found.truth is not None:
            truth = self._say("cell", "really", a=self._sayings.say("words", "a", found.truth))
        if found.faithful:
            return self._say("cell", "perfect", where=where, truth=truth), facts
        if found.taken is None:
            return self._say("unknown_sensor", sensor=state.config.sensor), facts
        threshold = self._percent(1.0 - state.config.detection_sensitivity)
        if TAKEN in (asked.supposes or "").split():
            first = self._say("cell", "taken", where=where, percent=self._percent(found.taken))
        else:
            first = self._say("cell", "free", where=where, percent=self._percent(1.0 - found.taken))
        told = [Part(0, first)]
        if found.shown is not None:
            told.insert(
                0, Part(0, self._say("cell", "shown", a=self._sayings.say("words", "a", found.shown)))
            )
        else:
            told.append(Part(1, self._say("cell", "counts_free", percent=threshold)))
        told += [Part(0, truth), Part(2, self._say("cell", "now"))]
        return within(told), facts

    def _unknown(self, asked: Asked) -> tuple[str, Json]:
        """The cells that no device sees now: too far ahead, or hidden."""
        state = asked.timeline.state
        found = unknown_cells(state)
        if found is None:
            return self._say("unknown_sensor", sensor=state.config.sensor), {"cells": None}
        facts = {"cells": found.cells, "beyond": found.beyond, "unseen": found.unseen, "rows": found.rows}
        if found.faithful:
            return self._say("unknown", "perfect"), facts
        told = [
            self._say(
                "unknown",
                "told",
                count=found.beyond + found.unseen,
                cells=found.cells,
                beyond=found.beyond,
                metres=self._metres(found.metres),
                unseen=found.unseen,
            ),
            self._say("unknown", "memory"),
        ]
        return " ".join(told), facts

    def _would_see(self, asked: Asked) -> tuple[str, Json]:
        """The chance that one look of a sensor detects the nearest thing of a kind that is really there."""
        state, config = asked.timeline.state, self._with_sensor(asked)
        kind = None if asked.ask.kind is None else Kind(asked.ask.kind)
        found = would_see(state, config.sensor, kind)
        facts: Json = {"sensor": config.sensor, "nearest": None, "chance": None}
        if found is None:
            noun = self._say("things") if kind is None else self._sayings.things(kind, 2)
            return self._say("would_see", "none", things=noun), facts
        who = Naming(self._sayings, state, as_seen=False).thing(found.thing.id)
        facts |= {"nearest": found.thing.id, "chance": found.chance}
        if sensor_named(config.sensor).faithful:
            return self._say("would_see", "perfect", who=who), facts
        if found.chance is None:
            return self._say("unknown_sensor", sensor=config.sensor), facts
        conditions = conditions_of(self._sayings, replace(config, sensor="perfect"))
        told = self._say(
            "would_see",
            "told" if found.in_view else "hidden",
            sensor=value_of(self._sayings, "sensor", config.sensor),
            who=who,
            percent=self._percent(found.chance),
            conditions=conditions or self._sayings.say("sensing_compared", "plain"),
        )
        return f"{self._yes(found.chance >= SAYS)} {capital(told)}", facts

    def _with_sensor(self, asked: Asked) -> Config:
        """The configuration with the sensor that is asked about, by default the session's."""
        config, value = asked.timeline.state.config, asked.ask.value
        return config if value is None else replace(config, sensor=str(value))

    def _metres(self, metres: float) -> str:
        return self._sayings.number(round(metres, 1))

    def _percent(self, share: float) -> str:
        percent = 100.0 * share
        if 0.0 < share < 1.0:
            percent = min(max(percent, FEW_PERCENT), ALMOST_ALL)
        return self._sayings.number(round(percent, 1))

    def _say(self, *keys: str, **parts: Any) -> str:
        return self._sayings.say("sensing_now", *keys, **parts)
