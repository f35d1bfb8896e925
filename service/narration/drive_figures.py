"""Answers in figures of this drive: its average speed, its share of the way, its least time, its detours."""

from __future__ import annotations

from service.contract.encode.drive_figures import best_time_json, drive_so_far_json
from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.charges import in_seconds
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.config import Config
from sim.explain.drive_figures import BestTime, DriveSoFar, best_time, drive_so_far
from sim.explain.question_error import QuestionError
from sim.types import Outcome

KMH = 3.6
"""km/h in a metre a second."""
HALF = "half"
"""What a question about the way supposes that asks when half of it was done."""


class DriveFigures:
    """Answers to "what was the average speed?", "what is the shortest possible time on this road?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, timeline = asked.ask, asked.timeline
        state = timeline.state
        try:
            if ask.what == "best_time":
                best = best_time(timeline)
                text, facts = self._best(best, state.config), best_time_json(best)
            else:
                drive = drive_so_far(timeline, begun=ask.what not in ("way_share", "started"))
                tell = {
                    "average_speed": self._speed,
                    "straight_line": self._straight,
                    "started": self._started,
                }.get(str(ask.what))
                told = self._share(drive, state.config, asked) if tell is None else tell(drive, state.config)
                text, facts = told, drive_so_far_json(drive)
        except QuestionError as error:
            told = not_so(self._sayings, error.code, error.facts)
            return plain(self._sayings, ask, state, told) | {"what": ask.what}
        return plain(self._sayings, ask, state, text) | {"what": ask.what} | facts

    def _speed(self, drive: DriveSoFar, config: Config) -> str:
        """With the stops, then without them where there were any."""
        counted, seconds = drive.counted, drive.ticks * config.step_seconds
        told = self._say(
            "speed",
            kmh=self._kmh(counted.distance_m, seconds),
            metres=self._sayings.number(round(counted.distance_m)),
            seconds=in_seconds(self._sayings, drive.ticks, config),
        )
        moving = drive.ticks - counted.stay
        if not counted.stay or not moving:
            return told
        kmh = self._kmh(counted.distance_m, moving * config.step_seconds)
        stood = in_seconds(self._sayings, counted.stay, config)
        return f"{told} {self._say('moving', kmh=kmh, seconds=stood)}"

    def _share(self, drive: DriveSoFar, config: Config, asked: Asked) -> str:
        """The share of the rows that are done, and when half of them were; that first where it is asked."""
        percent = round(100 * drive.done / drive.rows) if drive.rows else 100
        share = self._say(
            "share",
            percent=self._sayings.number(percent),
            done=drive.done,
            rows=drive.rows,
            left=drive.left,
            metres=self._sayings.number(drive.left * config.cell_m),
        )
        if drive.half is None:
            half = self._say("half", "not_yet")
        else:
            after = in_seconds(self._sayings, drive.half - drive.first, config)
            half = self._say("half", "at", tick=drive.half, seconds=after)
        return f"{half} {share}" if asked.supposes == HALF else f"{share} {half}"

    def _started(self, drive: DriveSoFar, config: Config) -> str:
        """Lane and row where it began, then where it is now, or ended."""
        metres = self._sayings.number(drive.rows * config.cell_m)
        start, now = drive.lanes[0] + 1, drive.lanes[-1] + 1
        told = self._say("started", "at", lane=start, rows=drive.rows, metres=metres, tick=drive.first)
        key = "now" if drive.outcome is Outcome.RUNNING else "ended"
        return f"{told} {self._say('started', key, lane=now, rows=drive.left)}"

    def _straight(self, drive: DriveSoFar, config: Config) -> str:
        """How much further it drove than straight ahead as far as it came."""
        driven, ahead = drive.counted.distance_m, drive.done * config.cell_m
        parts = {
            "driven": self._sayings.number(round(driven)),
            "ahead": self._sayings.number(round(ahead)),
            "more": self._sayings.number(round(driven - ahead)),
        }
        if round(driven - ahead) <= 0:
            return self._say("straight", "none", **parts)
        if not ahead:
            return self._say("straight", "nowhere", **parts)
        percent = self._sayings.number(round(100 * (driven - ahead) / ahead))
        return self._say("straight", "more", percent=percent, **parts)

    def _best(self, found: BestTime, config: Config) -> str:
        """The least time, what this drive took or takes at the least, and what it rests on."""
        drive = found.drive
        least = in_seconds(self._sayings, drive.rows, config)
        if not found.known:
            return self._say("best", "unknown", seconds=least)
        if found.ticks is None:
            return self._say("best", "no_way")
        told = [Part(0, self._say("best", "least", seconds=in_seconds(self._sayings, found.ticks, config)))]
        told.append(Part(2, self._say("best", "bound", seconds=least)))
        took = in_seconds(self._sayings, drive.ticks, config)
        if drive.outcome is Outcome.SUCCESS and not found.changed:
            lost = drive.ticks - found.ticks
            key = "took_more" if lost > 0 else "took_least"
            more = in_seconds(self._sayings, lost, config)
            told.append(Part(0, self._say("best", key, seconds=took, more=more)))
        elif found.from_here is not None and drive.ticks:
            here = in_seconds(self._sayings, found.from_here, config)
            total = in_seconds(self._sayings, drive.ticks + found.from_here, config)
            told.append(Part(0, self._say("best", "goes_on", seconds=took, here=here, total=total)))
        if found.changed:
            told.append(Part(1, self._say("best", "changed")))
        return within(told)

    def _kmh(self, metres: float, seconds: float) -> str:
        return self._sayings.number(round(KMH * metres / seconds, 1), ".10g")

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("drive_figures", *keys, **parts)
