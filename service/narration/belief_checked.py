"""Answers about the belief beside the truth: a cell entered, places, doubt, moves made for false alarms."""

from __future__ import annotations

from typing import Any, Final

from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.sayings import Sayings
from service.narration.values import value_of
from service.sessions.facts import Asked
from sim.explain import QuestionError
from sim.explain.alarm_moves import AlarmMoves, alarm_moves
from sim.explain.cell_belief import unknown_cells
from sim.explain.cell_entered import cell_entered
from sim.explain.placing import placing
from sim.perceive.parameters import SUITES
from sim.perceive.registry import sensor_named

MOST_LISTED: Final = 3
"""Moves, or things, that are told one by one."""
FEW_PERCENT, ALMOST_ALL = 0.1, 99.9
"""Percent between which shares are told that are neither nothing nor all."""


class BeliefChecked:
    """Answers to "how sure were you of the cell?", "how exactly do you place things?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, state = asked.ask, asked.timeline.state
        tell = {
            "cell_entered": self._entered,
            "placing": self._placing,
            "grid_doubt": self._doubt,
            "alarm_moves": self._alarms,
        }[str(ask.what)]
        try:
            text, facts = tell(asked)
        except QuestionError as error:
            return plain(self._sayings, ask, state, not_so(self._sayings, error.code, error.facts))
        return plain(self._sayings, ask, state, text) | {"what": ask.what} | facts

    def _entered(self, asked: Asked) -> tuple[str, Json]:
        """How likely the cell of a move was held to be free, and what really was there."""
        config = asked.timeline.state.config
        found = cell_entered(asked.timeline, asked.ask.tick)
        did = self._sayings.move(found.move, "did")
        facts: Json = {
            "at": found.tick,
            "move": found.move,
            "cell": None if found.cell is None else list(found.cell),
            "taken": found.taken,
            "expected_free": found.expected_free,
            "really": found.truth,
        }
        truth = self._say("entered", "was_free")
        if found.truth is not None:
            truth = self._say("entered", "was_taken", a=self._sayings.say("words", "a", found.truth))
        if found.faithful:
            key = "perfect" if found.expected_free else "perfect_taken"
            return f"{self._say('entered', key, tick=found.tick, did=did)} {truth}", facts
        if found.taken is None:
            return self._say("entered", "unknown", sensor=config.sensor, tick=found.tick, did=did), facts
        told = [
            Part(
                0,
                self._say(
                    "entered", "told", tick=found.tick, did=did, percent=self._percent(1.0 - found.taken)
                ),
            ),
            Part(0, truth),
            Part(
                1,
                self._say("entered", "threshold", percent=self._percent(1.0 - config.detection_sensitivity)),
            ),
        ]
        if not found.expected_free:
            told.insert(1, Part(0, self._say("entered", "expected_taken")))
        return within(told), facts

    def _placing(self, asked: Asked) -> tuple[str, Json]:
        """The reports of the drive that named the very cell; what is believed now; the devices' errors."""
        found, state = placing(asked.timeline), asked.timeline.state
        facts: Json = {
            "reports": found.reports,
            "exact": found.exact,
            "farthest_cells": found.farthest,
            "believed": found.believed,
            "misplaced": [{"id": id, "cells_off": off} for id, off in found.misplaced],
            "never_existed": found.never,
        }
        if found.faithful:
            return self._say("placing", "perfect"), facts
        if not found.devices:
            return self._say("unknown_sensor", sensor=state.config.sensor), facts
        told = [Part(0, self._say("placing", "no_reports"))]
        if found.reports:
            farthest = self._sayings.number(found.farthest * state.config.cell_m)
            key = "reports" if found.farthest else "all_exact"
            told = [
                Part(
                    0,
                    self._say(
                        "placing",
                        key,
                        percent=self._percent(found.exact / found.reports),
                        reports=found.reports,
                        metres=farthest,
                    ),
                )
            ]
        off = len(found.misplaced)
        if off:
            most = max(cells for _, cells in found.misplaced) * state.config.cell_m
            now = self._say(
                "placing",
                "now" if off > 1 else "now_one",
                off=off,
                believed=found.believed,
                metres=self._sayings.number(most),
            )
        else:
            now = self._say("placing", "now_exact", believed=found.believed)
        told.append(Part(1, now))
        errors = [
            self._say(
                "placing",
                "error",
                sensor=value_of(self._sayings, "sensor", spec.name),
                along=self._sayings.number(round(100 * (spec.along + state.config.sensor_noise), 2)),
                across=self._sayings.number(spec.across_deg),
            )
            for spec in found.devices
        ]
        told.append(Part(2, self._say("placing", "errors", listed=self._sayings.joined(errors))))
        return within(told), facts

    def _doubt(self, asked: Asked) -> tuple[str, Json]:
        """That the panel shows the truth, and what the belief is uncertain of."""
        state = asked.timeline.state
        found = unknown_cells(state)
        panel = self._say("doubt", "panel")
        if sensor_named(state.config.sensor).faithful:
            return f"{panel} {self._say('doubt', 'perfect')}", {"unseen": 0}
        if found is None or state.config.sensor not in SUITES:
            return f"{panel} {self._say('unknown_sensor', sensor=state.config.sensor)}", {"unseen": None}
        count = found.beyond + found.unseen
        told = [
            Part(0, panel),
            Part(0, self._say("doubt", "why")),
            Part(1, self._say("doubt", "unseen", count=count, cells=found.cells)),
        ]
        return within(told), {"unseen": count, "cells": found.cells}

    def _alarms(self, asked: Asked) -> tuple[str, Json]:
        """Yes or no; the moves that would have been others without what never existed."""
        found = alarm_moves(asked.timeline)
        facts: Json = {
            "decisions": found.decisions,
            "alarmed": found.alarmed,
            "changed": [
                {"tick": tick, "move": move, "otherwise": other} for tick, move, other in found.changed
            ],
            "otherwise_with_truth": found.otherwise,
        }
        if found.faithful:
            return f"{self._no()} {self._say('alarms', 'perfect')}", facts
        if not found.decisions:
            return self._say("alarms", "no_decisions"), facts
        if not found.changed:
            key = "none" if not found.alarmed else "same_one" if found.alarmed == 1 else "same"
            told = [Part(0, f"{self._no()} {self._say('alarms', key, count=found.alarmed)}")]
        else:
            told = [Part(0, self._changed(found))]
        none = "none_though" if found.changed else "none"
        key = none if not found.otherwise else "one" if found.otherwise == 1 else "many"
        told.append(Part(1, self._say("alarms", "truth", key, count=found.otherwise)))
        return within(told), facts

    def _changed(self, found: AlarmMoves) -> str:
        listed = [
            self._say(
                "alarms",
                "one",
                tick=tick,
                move=self._sayings.move(move, "name"),
                other=self._sayings.move(other, "name"),
            )
            for tick, move, other in found.changed[:MOST_LISTED]
        ]
        yes = self._say("first_word", answer=self._sayings.say("ahead", "answer", "agree"))
        told = self._say(
            "alarms",
            "changed_one" if len(found.changed) == 1 else "changed",
            count=len(found.changed),
            decisions=found.decisions,
            listed=self._sayings.listed(listed),
        )
        return f"{yes} {told}"

    def _no(self) -> str:
        return self._say("first_word", answer=self._sayings.say("ahead", "answer", "disagree"))

    def _percent(self, share: float) -> str:
        percent = 100.0 * share
        if 0.0 < share < 1.0:
            percent = min(max(percent, FEW_PERCENT), ALMOST_ALL)
        return self._sayings.number(round(percent, 1))

    def _say(self, *keys: str, **parts: Any) -> str:
        return self._sayings.say("belief_checked", *keys, **parts)
