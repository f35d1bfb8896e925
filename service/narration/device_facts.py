"""Answers about what holds of the sensors always: failures, looks, what they measure and tell apart."""

from __future__ import annotations

from typing import Any, Final

from service.narration.answer_length import Part, within
from service.narration.answerer import Json, plain
from service.narration.sayings import Sayings
from service.narration.values import value_of
from service.sessions.facts import Asked
from sim.config import Config
from sim.perceive.parameters import SUITES
from sim.perceive.registry import sensor_named
from sim.types import Kind

DEVICES: Final = SUITES["fusion"]
"""All devices there are."""
ALL_ROUND: Final = 360.0


class DeviceFacts:
    """Answers to "what if a sensor fails?", "does the radar measure speed?", "can you see behind?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        tell = {
            "failure": self._failure,
            "look_rate": self._look_rate,
            "speeds": self._speeds,
            "all_round": self._all_round,
            "own_place": self._own_place,
            "evenness": self._evenness,
            "kinds_apart": self._kinds_apart,
            "standing": self._standing,
        }[str(asked.ask.what)]
        text, facts = tell(asked)
        return plain(self._sayings, asked.ask, asked.timeline.state, text) | {"what": asked.ask.what} | facts

    def _failure(self, asked: Asked) -> tuple[str, Json]:
        """That devices miss and err, and never break down."""
        faithful = self._faithful(asked.timeline.state.config)
        told = [Part(0, self._say("failure", "never"))]
        told.append(Part(1, self._say("failure", "perfect" if faithful else "misses")))
        told.append(Part(1, self._say("failure", "without", example=self._say("failure", "example"))))
        return within(told), {"fails": False}

    def _look_rate(self, asked: Asked) -> tuple[str, Json]:
        """One look in every tick, and how many that were in this drive."""
        state = asked.timeline.state
        config, world = state.config, state.world
        last = asked.timeline.tick if world.ended is None else world.ended
        looks = last - world.episode_start + 1
        told = [
            Part(0, self._say("look_rate", "told", seconds=self._sayings.number(config.step_seconds))),
            Part(1, self._say("look_rate", "one" if looks == 1 else "so_far", count=looks)),
        ]
        if config.sensor_latency and not self._faithful(config):
            told.append(Part(0, self._say("look_rate", "late")))
        return within(told), {"looks": looks}

    def _speeds(self, asked: Asked) -> tuple[str, Json]:  # noqa: ARG002 -- it is the same of every session
        """That a report has a heading and no speed, and how often the heading is wrong."""
        listed = [
            self._say(
                "speeds", "one", sensor=self._sensor(spec.name), percent=self._percent(spec.wrong_heading)
            )
            for spec in DEVICES
        ]
        told = self._say("speeds", "told", listed=self._sayings.joined(listed))
        wrong = {spec.name: spec.wrong_heading for spec in DEVICES}
        return f"{told} {self._say('speeds', 'rule')}", {"measured": False, "wrong_heading": wrong}

    def _all_round(self, asked: Asked) -> tuple[str, Json]:
        """Fields of view; that rows behind are not looked at; how much less exact bearings are."""
        state = asked.timeline.state
        if self._faithful(state.config):
            return self._say("all_round", "perfect"), {"view_deg": None}
        ahead = [spec for spec in DEVICES if spec.view_deg < ALL_ROUND]
        told = [
            Part(0, self._say("all_round", "no")),
            Part(
                0,
                self._say(
                    "all_round",
                    "ahead",
                    listed=self._sayings.joined(
                        [
                            self._say(
                                "all_round",
                                "one",
                                sensor=self._sensor(spec.name),
                                degrees=self._sayings.number(spec.view_deg),
                            )
                            for spec in ahead
                        ]
                    ),
                ),
            ),
            Part(0, self._say("all_round", "lidar")),
            Part(0, self._say("all_round", "behind")),
        ]
        return within(told), {"view_deg": {spec.name: spec.view_deg for spec in DEVICES}}

    def _own_place(self, asked: Asked) -> tuple[str, Json]:
        """That the ego's own cell is known for certain, whatever it senses."""
        world = asked.timeline.state.world
        column, row = world.road.cell(world.av)
        told = self._say("own_place", "told", lane=column + 1, row=row)
        return told, {"cell": [column, row]}

    def _evenness(self, asked: Asked) -> tuple[str, Json]:
        """That weather and light are one setting for all of the road."""
        config = asked.timeline.state.config
        weather = self._say("weathers", config.weather)
        told = (
            f"{self._yes()} {self._say('evenness', 'told')} {self._say('evenness', 'now', weather=weather)}"
        )
        return told, {"weather": config.weather, "even": True}

    def _kinds_apart(self, asked: Asked) -> tuple[str, Json]:  # noqa: ARG002 -- as above
        return f"{self._yes()} {self._say('kinds_apart', 'told')}", {"mixed_up": False}

    def _standing(self, asked: Asked) -> tuple[str, Json]:  # noqa: ARG002 -- as above
        """That motion has no part in being detected; the kind has."""
        listed = [
            self._say(
                "standing",
                "one",
                sensor=self._sensor(spec.name),
                car=self._percent(spec.targets[Kind.VEHICLE].peak),
                barrier=self._percent(spec.targets[Kind.BARRIER].peak),
            )
            for spec in DEVICES
        ]
        told = self._say("standing", "told", listed=self._sayings.joined(listed))
        return f"{self._yes()} {told}", {"depends_on_motion": False}

    def _faithful(self, config: Config) -> bool:
        return sensor_named(config.sensor).faithful

    def _yes(self) -> str:
        return self._say("first_word", answer=self._sayings.say("ahead", "answer", "agree"))

    def _sensor(self, name: str) -> str:
        return value_of(self._sayings, "sensor", name)

    def _percent(self, share: float) -> str:
        return self._sayings.number(round(100 * share, 1))

    def _say(self, *keys: str, **parts: Any) -> str:
        return self._sayings.say("device_facts", *keys, **parts)
