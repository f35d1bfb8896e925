"""Figures of a drive as JSON values."""

from __future__ import annotations

from typing import Any

from sim.explain.drive_figures import BestTime, DriveSoFar

Json = dict[str, Any]


def drive_so_far_json(drive: DriveSoFar) -> Json:
    """Ticks, rows and metres of the drive up to now, or to its end."""
    return {
        "first": drive.first,
        "last": drive.last,
        "rows": drive.rows,
        "rows_left": drive.left,
        "half_at": drive.half,
        "lanes": [column + 1 for column in drive.lanes],
        "distance_m": round(drive.counted.distance_m, 3),
        "stays": drive.counted.stay,
    }


def best_time_json(found: BestTime) -> Json:
    """The least ticks from where the drive began, and from now; null where they are not known."""
    return {
        "least_ticks": found.ticks,
        "known": found.known,
        "changed": found.changed,
        "least_from_here": found.from_here,
        "driven": found.drive.ticks,
        "rows": found.drive.rows,
    }
