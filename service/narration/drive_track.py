"""Answers about the course of a drive: how smooth it was, to and fro, since when it is here, least TTC."""

from __future__ import annotations

from typing import Final

from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.charges import in_seconds
from service.narration.futures_told import yes_and_no
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.config import Config
from sim.explain.drive_track import DriveTrack, drive_track
from sim.explain.least_ttc import LeastTtc, least_ttc
from sim.explain.question_error import QuestionError
from sim.types import Outcome

MOST_TOLD: Final = 12
"""Ticks that are told one by one; the facts have all."""
LANE: Final = "lane"
"""What a question about here supposes that asks since when it is in this lane."""


class DriveTracks:
    """Answers to "how smooth was the ride?", "how long have we been in this lane?" and the like."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, timeline = asked.ask, asked.timeline
        try:
            if ask.what == "least_ttc":
                least = least_ttc(timeline)
                text, facts = self._ttc(least), _ttc_json(least)
            else:
                track = drive_track(timeline)
                text, facts = self._told(track, asked), _json(track)
        except QuestionError as error:
            if error.code == "too_long":
                told = self._sayings.say("history", "too_long", **error.facts)
            else:
                told = not_so(self._sayings, error.code, error.facts)
            return plain(self._sayings, ask, timeline.state, told) | {"what": ask.what}
        return plain(self._sayings, ask, timeline.state, text) | {"what": ask.what} | facts

    def _told(self, track: DriveTrack, asked: Asked) -> str:
        config = asked.timeline.state.config
        words = yes_and_no(self._sayings, asked)
        match asked.ask.what:
            case "smoothness":
                return self._smooth(track)
            case "reversals":
                turns = track.reversals
                key = "none" if not turns else "one" if len(turns) == 1 else "many"
                changes = len(track.across)
                ticks = self._ticks(turns)
                return self._say("reversals", key, count=len(turns), changes=changes, ticks=ticks, **words)
            case "nearest_goal":
                at = track.nearest
                row, now = track.cells[at - track.first][1], track.cells[-1][1]
                key = "now" if row == now else "earlier"
                return self._say("nearest", key, row=row, tick=at, now=now, **words)
            case "not_advanced":
                told = track.unadvanced
                key = "none" if not told else "one" if len(told) == 1 else "many"
                ticks = self._ticks(told)
                return self._say("unadvanced", key, count=len(told), total=track.ticks, ticks=ticks)
            case _:
                return self._here(track, config, lane_first=asked.supposes == LANE)

    def _smooth(self, track: DriveTrack) -> str:
        counts = {
            "changes": len(track.across),
            "stops": len(track.stops),
            "turns": len(track.reversals),
        }
        metres = self._sayings.number(round(track.distance_m))
        told = [Part(0, self._say("smooth", "counts", metres=metres, **counts))]
        each = {key: track.per_100_m(count) for key, count in counts.items()}
        if any(counts.values()) and None not in each.values():
            rates = {key: self._sayings.number(round(value or 0, 1)) for key, value in each.items()}
            told.append(Part(0, self._say("smooth", "rates", **rates)))
        return within([*told, Part(1, self._say("smooth", "measure"))])

    def _here(self, track: DriveTrack, config: Config, *, lane_first: bool) -> str:
        lane, row = track.cells[-1][0] + 1, track.cells[-1][1]
        key = "now" if track.outcome is Outcome.RUNNING else "ended"

        def since(what: str, tick: int) -> str:
            seconds = in_seconds(self._sayings, track.last - tick, config)
            begun = "start" if tick == track.first else "since"
            return self._say(key, what, begun, lane=lane, row=row, tick=tick, seconds=seconds)

        cell, in_lane = since("cell", track.here_since), since("lane", track.lane_since)
        return f"{in_lane} {cell}" if lane_first else f"{cell} {in_lane}"

    def _ttc(self, found: LeastTtc) -> str:
        told = []
        if found.crashed:
            told.append(Part(0, self._say("ttc", "crashed")))
        if found.before is None or found.ttc_s is None or found.id is None:
            told.append(Part(0, self._say("ttc", "none")))
        else:
            told.append(
                Part(
                    0,
                    self._say(
                        "ttc",
                        "least",
                        seconds=self._sayings.number(round(found.ttc_s, 2)),
                        tick=found.before.world.tick,
                        who=Naming(self._sayings, found.before, as_seen=False).thing(found.id),
                        ticks=found.ticks,
                        driven=found.driven,
                    ),
                )
            )
        return within([*told, Part(1, self._say("ttc", "measure"))])

    def _ticks(self, ticks: tuple[int, ...]) -> str:
        told = [str(tick) for tick in ticks[:MOST_TOLD]]
        if more := len(ticks) - len(told):
            told.append(self._say("more", count=more))
        return self._sayings.joined(told)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("drive_track", *keys, **parts)


def _json(track: DriveTrack) -> Json:
    return {
        "first": track.first,
        "last": track.last,
        "distance_m": round(track.distance_m, 3),
        "lane_changes": [tick for tick, _ in track.across],
        "stops": [{"tick": tick, "ticks": ticks} for tick, ticks in track.stops],
        "reversals": list(track.reversals),
        "not_advanced": list(track.unadvanced),
        "nearest_at": track.nearest,
        "here_since": track.here_since,
        "lane_since": track.lane_since,
    }


def _ttc_json(found: LeastTtc) -> Json:
    return {
        "ttc_s": found.ttc_s,
        "id": found.id,
        "at": None if found.before is None else found.before.world.tick,
        "rows": found.rows,
        "ticks": found.ticks,
        "driven": found.driven,
        "crashed": found.crashed,
    }
