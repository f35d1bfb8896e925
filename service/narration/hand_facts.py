"""Answers about driving by hand: time, warnings, what the planner does meanwhile, whose a crash is."""

from __future__ import annotations

from service.narration.answer_length import Part, within
from service.narration.answerer import Json, plain
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.perceive.registry import sensor_named
from sim.plan.safe_planning import is_foreign
from sim.types import Mode, Outcome

MAX = "max"
"""The playback speed without a pace of its own."""
ORDERS = {"drawn": ("drawn", "plans", "sensor"), "sensor": ("sensor", "plans", "drawn")}
"""What is told first of the planner's work, by what the question supposes."""


class HandFacts:
    """Answers to "does time run on while I press nothing?", "do you warn me before a collision?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        tell = {
            "hand_time": self._time,
            "hand_warning": self._warning,
            "hand_plan": self._plan,
            "hand_blame": self._blame,
        }[str(asked.ask.what)]
        state = asked.timeline.state
        parts, facts = tell(asked)
        if state.mode is not Mode.MANUAL:
            example = self._sayings.say("world_rules", "by_hand", "example")
            parts.append(Part(3, self._say("not_by_hand", example=example)))
        return plain(self._sayings, asked.ask, state, within(parts)) | {"what": asked.ask.what} | facts

    def _time(self, asked: Asked) -> tuple[list[Part], Json]:
        """Time goes by the clock, and a tick without a key is a stay."""
        config, pace = asked.timeline.state.config, asked.playback_speed
        stands = asked.paused
        if stands:
            now = self._say("time", "stands")
        elif pace == MAX:
            now = self._say("time", "runs_fast")
        else:
            seconds = self._sayings.number(round(config.step_seconds / float(pace), 3))
            now = self._say("time", "runs", seconds=seconds)
        running = asked.timeline.state.world.outcome is Outcome.RUNNING
        last = Part(1, self._say("time", "keys" if running else "ended"))
        return [Part(0, now), Part(0, self._say("time", "stay")), last], {
            "paused": stands,
            "playback_speed": pace,
            "step_seconds": config.step_seconds,
        }

    def _warning(self, asked: Asked) -> tuple[list[Part], Json]:
        """What is held back and what is not; what a sensor misses is not."""
        faithful = sensor_named(asked.timeline.state.config.sensor).faithful
        told = [Part(0, self._say("warning", "held_back")), Part(0, self._say("warning", "not"))]
        told.append(Part(1, self._say("warning", "perfect" if faithful else "errs")))
        return told, {"faithful": faithful}

    def _plan(self, asked: Asked) -> tuple[list[Part], Json]:
        """What the planner and the sensor do while a person drives, and what is drawn."""
        foreign = is_foreign(asked.timeline.state.config.planner)
        order = ORDERS.get(str(asked.supposes), ("plans", "drawn", "sensor"))
        parts = {
            "plans": self._say("plan", "foreign" if foreign else "plans"),
            "drawn": self._say("plan", "drawn"),
            "sensor": self._say("plan", "sensor"),
        }
        return [Part(rank, parts[key]) for rank, key in enumerate(order)], {"asked": not foreign}

    def _blame(self, asked: Asked) -> tuple[list[Part], Json]:  # noqa: ARG002 -- it is the same of every session
        """A crash by a move that a person asked for, a stay included, is theirs."""
        return [Part(rank, self._say("blame", key)) for rank, key in enumerate(("yours", "stay", "held"))], {}

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("hand_facts", *keys, **parts)
