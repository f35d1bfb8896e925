"""Answers about the simulator around a drive: pictures, files, stepping back, settings, what is forbidden."""

from __future__ import annotations

import json
from typing import Final

from service.narration.answer_length import Part, within
from service.narration.answerer import Json, plain
from service.narration.sayings import Sayings
from service.narration.values import value_of
from service.sessions.facts import Asked
from sim.explain import QuestionError
from sim.explain.plan_course import way_then
from sim.perceive.registry import sensor_named
from sim.rules.dynamics import DEFAULT_DYNAMICS
from sim.session.timeline import Timeline
from sim.statistics import tries_to_claim
from sim.types import Mode, Outcome

MOST_HITS: Final = 2
"""Crashes up to which the runs are told that a claim takes."""
LEAST_PERCENT: Final = 0.01
MOST_PERCENT: Final = 99.99
"""Rates and confidences, in percent, that runs are counted for."""


class SessionFacts:
    """Answers to "can I step back?", "can I export this?", "how many runs do I need?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        tell = {
            "picture": self._picture,
            "hand_sight": self._hand_sight,
            "holes": self._holes,
            "export": self._export,
            "switching": self._switching,
            "stepping": self._stepping,
            "emergency": self._emergency,
            "traffic_rules": self._traffic_rules,
            "runs_needed": self._runs_needed,
            "keys": self._keys,
            "counting": self._counting,
            "path_view": self._path_view,
        }[str(asked.ask.what)]
        text, facts = tell(asked)
        return plain(self._sayings, asked.ask, asked.timeline.state, text) | {"what": asked.ask.what} | facts

    def _picture(self, asked: Asked) -> tuple[str, Json]:
        """That pictures show the truth, and where what is seen is marked."""
        faithful = sensor_named(asked.timeline.state.config.sensor).faithful
        return self._say("picture", "perfect" if faithful else "errs"), {"faithful": faithful}

    def _hand_sight(self, asked: Asked) -> tuple[str, Json]:
        """That people see the truth, and their moves are checked against what the sensor shows."""
        config = asked.timeline.state.config
        faithful = sensor_named(config.sensor).faithful
        told = [Part(0, self._say("hand_sight", "picture"))]
        sensor = value_of(self._sayings, "sensor", config.sensor)
        told.append(Part(0, self._say("hand_sight", "perfect" if faithful else "errs", sensor=sensor)))
        return within(told), {"faithful": faithful}

    def _holes(self, asked: Asked) -> tuple[str, Json]:  # noqa: ARG002 -- it is the same of every session
        return self._say("holes"), {}

    def _export(self, asked: Asked) -> tuple[str, Json]:  # noqa: ARG002 -- it is the same of every session
        return self._say("export"), {}

    def _switching(self, asked: Asked) -> tuple[str, Json]:
        """Yes; what is in force now."""
        state = asked.timeline.state
        if state.world.outcome is not Outcome.RUNNING:
            return self._say("switching", "ended"), {"running": False}
        example = self._say("switching", "example")
        told = [Part(0, self._say("switching", "told", example=example))]
        if state.mode is Mode.MANUAL:
            told.append(Part(1, self._say("switching", "manual")))
        return within(told), {"running": True}

    def _stepping(self, asked: Asked) -> tuple[str, Json]:
        """Yes, to any tick that has been; a tick that was named is in the sentence to say."""
        now = asked.timeline.tick
        named = next((int(each) for each in (asked.supposes or "").split() if each.isdigit()), None)
        if named is not None and named > now:
            return self._say("stepping", "not_yet", tick=named, now=now), {"tick": named, "now": now}
        tick = max(0, now - 1) if named is None else named
        example = self._say("stepping", "example", tick=tick)
        return self._say("stepping", "told", example=example), {"tick": named, "now": now}

    def _emergency(self, asked: Asked) -> tuple[str, Json]:
        """That staying is one: it takes no room, where a move is a cell."""
        grid = asked.timeline.state.config.dynamics == DEFAULT_DYNAMICS
        told = [Part(0, self._say("emergency", "grid" if grid else "other"))]
        told.append(Part(0, self._say("emergency", "how")))
        return within(told), {}

    def _traffic_rules(self, asked: Asked) -> tuple[str, Json]:
        """That there are none to break, and whether this drive ended in a crash."""
        state = asked.timeline.state
        crashed = state.world.outcome is Outcome.CRASH
        crash = self._say("traffic_rules", "crashed" if crashed else "not_crashed")
        return f"{self._say('traffic_rules', 'none')} {crash}", {"crashed": crashed}

    def _runs_needed(self, asked: Asked) -> tuple[str, Json]:
        """The runs for none, one and two crashes, by the exact binomial test."""
        wanted = [json.loads(each) for each in (asked.supposes or "").split()]
        if len(wanted) != 2 or not all(LEAST_PERCENT <= each <= MOST_PERCENT for each in wanted):
            return self._say("runs_needed", "odd"), {"runs": None}
        confidence, rate = wanted
        runs = [tries_to_claim(rate / 100, confidence / 100, hits) for hits in range(MOST_HITS + 1)]
        told = self._say(
            "runs_needed",
            "told",
            none=runs[0],
            one=runs[1],
            two=runs[2],
            confidence=self._sayings.number(confidence),
            rate=self._sayings.number(rate),
            doubt=self._sayings.number(round(100 - confidence, 2)),
        )
        return told, {"runs": runs, "confidence": confidence / 100, "rate": rate / 100}

    def _keys(self, asked: Asked) -> tuple[str, Json]:
        """Which keys drive on the page, after the one that was asked about."""
        words = (asked.supposes or "").split()
        asked_for = next(
            (each for each in words if each in self._sayings.words("session_facts", "keys_of")), None
        )
        told = [self._say("keys_of", asked_for)] if asked_for is not None else []
        told.append(self._say("keys", "drive"))
        if asked.timeline.state.mode is not Mode.MANUAL:
            told.append(
                self._say(
                    "keys", "not_by_hand", example=self._sayings.say("world_rules", "by_hand", "example")
                )
            )
        return " ".join(told), {"key": asked_for}

    def _counting(self, asked: Asked) -> tuple[str, Json]:
        """How the ends of drives are counted, and that it does not matter who drives; yes or no first."""
        metrics = asked.timeline.state.metrics
        words = (asked.supposes or "").split()
        order = ["hand", "ends"] if "hand" in words else ["ends", "hand"]
        told = [Part(rank, self._say("counting", key)) for rank, key in enumerate(order)]
        if "hand" in words or "stuck" in words:
            told.insert(0, Part(0, self._say("counting", "yes")))
        if metrics.episodes:
            now = self._say(
                "counting",
                "now",
                successes=metrics.successes,
                crashes=metrics.crashes,
                stuck=metrics.stuck,
                episodes=metrics.episodes,
            )
            told.append(Part(2, now))
        counted = {"successes": metrics.successes, "crashes": metrics.crashes, "stuck": metrics.stuck}
        return within(told), counted

    def _path_view(self, asked: Asked) -> tuple[str, Json]:
        """What the path on the page is: while it drives, while a person does, once the drive has ended."""
        timeline = asked.timeline
        state, why_none = timeline.state, "none" in (asked.supposes or "").split()
        if state.world.outcome is not Outcome.RUNNING:
            told = [Part(0, self._say("path_view", "ended")), Part(2, self._say("path_view", "ended_rest"))]
            if state.world.outcome is Outcome.STUCK:
                told.append(Part(1, self._last_plan(timeline)))
            return within(told), {"drawn": False}
        if state.mode is Mode.MANUAL:
            return self._say("path_view", "by_hand"), {"drawn": False}
        switch = self._say("path_view", "off", example=self._say("path_view", "example"))
        told = [Part(0, self._say("path_view", "behind")), Part(1, self._say("path_view", "above"))]
        told.insert(0 if why_none else 2, Part(0 if why_none else 2, switch))
        return within(told), {"drawn": True}

    def _last_plan(self, timeline: Timeline) -> str:
        """Whether the planner had a way to the goal in its last decision; empty where that is unknown."""
        try:
            found = way_then(timeline)
        except QuestionError:
            return ""
        key = "last_way" if found.searching and found.way is not None else "last_none"
        if not found.searching:
            key = "last_move"
        return self._say("path_view", key, planner=self._sayings.planner(found.planner))

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("session_facts", *keys, **parts)
