"""Whose fault a crash was and since when it was expected, as JSON values."""

from __future__ import annotations

from typing import Any

from service.contract.encode.ahead import avoidable_json
from sim.explain.blame import Blame, Foreseen
from sim.explain.crash import Crash

Json = dict[str, Any]


def blame_json(found: Blame) -> Json:
    """The fault, and all that it was judged by."""
    return {
        "crash": _crash_json(found.crash),
        "fault": found.fault,
        "entered": found.entered,
        "knew": found.knew,
        "free": [str(move) for move in found.free],
        "avoidable": avoidable_json(found.avoidable),
        "exact": found.exact,
        "knowable": found.knowable,
    }


def foreseen_json(found: Foreseen) -> Json:
    """Since which ticks what was hit was seen and expected."""
    return {
        "crash": _crash_json(found.crash),
        "seen_since": found.seen_since,
        "expected_since": found.expected_since,
    }


def _crash_json(crash: Crash) -> Json:
    cause = crash.cause
    return {"tick": crash.end, "ids": list(cause.ids), "how": cause.how, "cell": list(cause.cell)}
