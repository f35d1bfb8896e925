"""Loaded by schemathesis itself: tells what it does while it does it, and thins what repeats itself.

Its coverage phase makes every case that a schema defines, and an action may hold actions: what is taught,
what if. The four calls that take actions have 55,000 cases of 57,000, nearly all of them an action within an
action within an action, which one piece of code reads wherever it stands. All cases with one action are sent;
of those with actions inside actions one in `KEPT`, others for each seed. Fuzzing makes them too, unthinned.
"""

from __future__ import annotations

import json
import os
from hashlib import blake2b
from typing import Any

import schemathesis

from tests.contract.told import SEED, TOLD

KEPT = 50

_told = open(os.environ[TOLD], "ab", buffering=0)  # noqa: SIM115 -- as long as the process


def depth(value: Any) -> int:
    """How many actions stand inside one another."""
    if isinstance(value, dict):
        return ("do" in value) + max(map(depth, value.values()), default=0)
    return max(map(depth, value), default=0) if isinstance(value, list) else 0


@schemathesis.hook
def filter_case(context: Any, case: Any) -> bool:  # noqa: ARG001 -- its name and arguments are the tool's
    """Whether a case is sent."""
    if case.meta is None or case.meta.phase.name.value != "coverage" or depth(case.body) < 2:
        return True
    drawn = blake2b((os.environ[SEED] + repr(case.body)).encode(errors="replace"), digest_size=4)
    return int.from_bytes(drawn.digest(), "big") % KEPT == 0


@schemathesis.hook
def after_call(context: Any, case: Any, response: Any) -> None:  # noqa: ARG001
    """One answer."""
    _tell(case, response.status_code)


@schemathesis.hook
def filter_failure(context: Any, failure: Any, case: Any, response: Any) -> bool:  # noqa: ARG001
    """One thing that an answer is not as it should be; none is dropped."""
    _tell(case, response.status_code, failure.title)
    return True


def _tell(case: Any, *what: Any) -> None:
    line = [f"{case.operation.method.upper()} {case.operation.path}", *what]
    _told.write(json.dumps(line).encode() + b"\n")
