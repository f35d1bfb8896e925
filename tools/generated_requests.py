"""Requests generated from the OpenAPI document, many of them, sent to the running service by schemathesis.

All its checks and phases are on: examples, coverage, fuzzing, and the stateful phase, which walks by
the document's links. `python -m tools.generated_requests --cases 3000` is the long run; the suite has a
short one.

A schema cannot say everything. `REFUSED` lists, call by call, the statuses that a request may be answered
with though it is well formed, each with its reason; anything else is a failure.
"""

from __future__ import annotations

import argparse
import json
import sys
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from tests.contract.running import PHASES, Tool, serving
from tests.contract.whole import Part, Whole

SESSIONS = "/api/v1/sessions"
OWN = f"{SESSIONS}/{{session_id}}"
ENDLESS = f"{OWN}/events/stream"
"""Has no end: its first event is looked at, or that none comes."""

TAG = "412: If-Match names another version; 422: the tool takes the number 0 for such a header's text"
ROAD = "422: there is no room on this road, no such thing, nothing to undo, or it is not offered"
WORDS = "409: could mean several things; 422: the words mean nothing here"
PAST = "422: a tick that has not come yet, which only the session knows"
REFUSED: dict[tuple[str, str], tuple[tuple[int, ...], tuple[str, ...]]] = {
    ("POST", SESSIONS): (
        (409, 413, 422, 429),
        (
            WORDS,
            "422: parts that cannot stand beside one another",
            "413: a long recording is more bytes than are read",
            "429: quota",
        ),
    ),
    ("DELETE", OWN): ((412, 422), (TAG,)),
    ("PATCH", OWN): ((422,), ("422: what is no name",)),
    ("PATCH", f"{OWN}/config"): ((412, 422), (TAG, ROAD, "422: a part that needs another road")),
    ("POST", f"{OWN}/commands"): ((409, 412, 422), (TAG, WORDS, ROAD)),
    ("POST", f"{OWN}/actions"): ((412, 422), (TAG, ROAD)),
    ("POST", f"{OWN}/step"): ((412, 422), (TAG,)),
    ("POST", f"{OWN}/ask"): ((409, 412, 422), (TAG, WORDS)),
    ("POST", f"{OWN}/forks"): ((412, 422, 429), (TAG, ROAD, PAST, "429: quota")),
    ("POST", f"{OWN}/rewind"): ((412, 422), (TAG, PAST)),
    ("POST", f"{OWN}/counterfactual"): ((412, 422), (TAG, ROAD, PAST)),
    ("GET", f"{OWN}/state"): ((422,), (PAST,)),
    ("GET", f"{OWN}/link"): ((422,), (PAST,)),
    ("GET", f"{OWN}/timeline"): ((422,), (PAST,)),
    ("GET", f"{OWN}/moments"): ((422,), (PAST,)),
    ("GET", f"{OWN}/forecast"): ((422,), (PAST,)),
    ("GET", f"{OWN}/percept"): ((422,), (PAST,)),
    ("GET", f"{OWN}/regret"): ((422,), (PAST,)),
    ("GET", f"{OWN}/film"): ((422,), (PAST, "422: more frames than are made; no video library")),
    ("POST", "/api/v1/evaluations"): (
        (409, 422, 429),
        (WORDS, "422: roads that cannot be, or parts that cannot stand beside one another", "429: quota"),
    ),
    ("GET", "/api/v1/evaluations/{evaluation_id}/report"): ((409,), ("409: there is no result yet",)),
    ("POST", "/api/v1/parse"): ((409, 422), (WORDS,)),
    ("POST", "/api/v1/advice"): ((409, 422), (WORDS, "422: said in the text and in figures")),
}
CANCELLED = "DELETE cancels an evaluation that runs, which stays to be looked at; the next DELETE forgets it"
UNCHECKED: dict[tuple[str, str], tuple[str, str]] = {
    ("GET", "/api/v1/evaluations/{evaluation_id}"): ("use_after_free", CANCELLED),
    ("GET", "/api/v1/evaluations/{evaluation_id}/report"): ("use_after_free", CANCELLED),
    ("DELETE", "/api/v1/evaluations/{evaluation_id}"): ("ensure_resource_availability", CANCELLED),
}
"""Checks that do not hold for a call, each with its reason."""
ALWAYS_REFUSED = (404,)
"""An id, a tick or a name that was never given out."""
REJECTED = (400, 401, 404, 405, 406, 409, 413, 415, 422, 428, 429)
"""How a request may be refused that is not well formed; 413: more items than allowed are more bytes too."""

KEY = "a-key-that-is-only-for-this"
SMALL = {
    "ROADTALK_MAX_FILM_FRAMES": "12",
    "ROADTALK_MAX_ROAD_CELLS": "600",
    "ROADTALK_MAX_STEP_TICKS": "200",
    "ROADTALK_MAX_RECORDING_BYTES": "131072",
    "ROADTALK_CHANGES_PER_MINUTE": "1000000",
}
"""Small films and roads, and no haste too great: what is looked at here is the contract, not the work."""


def configuration(document: Mapping[str, Any]) -> str:
    """schemathesis' own configuration, for the calls there are."""
    lines = [
        "[checks.negative_data_rejection]",
        f"expected-statuses = {_listed(REJECTED)}",
        "[checks.positive_data_acceptance]",
        f"expected-statuses = {_listed(('2xx', '3xx', *ALWAYS_REFUSED))}",
    ]
    for (method, path), (statuses, reasons) in REFUSED.items():
        if method.lower() not in document["paths"].get(path, {}):
            continue
        lines += [
            "[[operations]]",
            *(f"# {reason}" for reason in reasons),
            f'include-name = "{method} {path}"',
            "[operations.checks.positive_data_acceptance]",
            f"expected-statuses = {_listed(('2xx', '3xx', *ALWAYS_REFUSED, *statuses))}",
        ]
    for (method, path), (check, reason) in UNCHECKED.items():
        lines += ["[[operations]]", f"# {reason}", f'include-name = "{method} {path}"']
        lines += [f"[operations.checks.{check}]", "enabled = false"]
    lines += ["[[operations]]", f'include-path = "{ENDLESS}"']
    lines += ["max-stream-events = 1", "request-timeout = 20"]
    return "\n".join([*lines, ""])


def _listed(statuses: tuple[int | str, ...]) -> str:
    return json.dumps([str(status) for status in statuses])


def openapi() -> dict[str, Any]:
    """The document of the service as it is."""
    from service.app import create_app
    from service.settings import Settings

    return create_app(Settings(database="memory:")).openapi()


def plan(cases: int) -> list[Part]:
    """The phases of a whole run: at least so many cases by chance, two thirds of them stateful.

    What examples and coverage make is fixed by the document and comes on top.
    """
    stateful = cases * 2 // 3
    return [
        Part("examples", examples=1),
        Part("coverage", examples=1),
        Part("fuzzing", cases - stateful, examples=20),
        Part("stateful", stateful, examples=60),
    ]


def main() -> int:
    """The whole run; prints totals, also of a run that was stopped.

    1 where something was found, 2 where nothing was and it was stopped before its end.
    """
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "--cases", type=int, default=3_000, help="at least so many by chance, two thirds of them stateful"
    )
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keyed", action="store_true", help="with a key configured")
    parser.add_argument("--phase", action="append", choices=PHASES, help="this phase only; may be repeated")
    parser.add_argument("--seconds", type=float, help="stop after so long")
    asked = parser.parse_args()
    parts = [part for part in plan(asked.cases) if not asked.phase or part.phase in asked.phase]
    document = openapi()
    key = KEY if asked.keyed else None
    with tempfile.TemporaryDirectory() as name, serving(Path(name), SMALL, key=key) as url:
        tool = Tool(url, Path(name), configuration(document), key=key)
        run = Whole(tool, parts, seed=asked.seed, seconds=asked.seconds)
        run.go()
    calls = {f"{method.upper()} {path}" for path, item in document["paths"].items() for method in item}
    run.tell(calls)
    return 1 if run.violations else 0 if run.complete else 2


if __name__ == "__main__":
    sys.exit(main())
