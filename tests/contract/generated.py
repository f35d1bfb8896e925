"""Requests generated from the OpenAPI document, many of them, sent to the running service by schemathesis.

All its checks and phases are on: examples, coverage, fuzzing, and the stateful phase, which walks by
the document's links. `python -m tests.contract.generated --cases 3000` is the long run; the suite has a
short one.

A schema cannot say everything. `REFUSED` lists, call by call, the statuses that a request may be answered
with though it is well formed, each with its reason; anything else is a failure.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[2]
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
    ("GET", f"{OWN}/regret"): ((422,), (PAST,)),
    ("GET", f"{OWN}/film"): ((422,), (PAST, "422: more frames than are made; no video library")),
    ("POST", "/api/v1/parse"): ((409, 422), (WORDS,)),
    ("POST", "/api/v1/advice"): ((409, 422), (WORDS, "422: said in the text and in figures")),
}
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
}
"""Small films and roads: what is looked at here is the contract, not the work."""


@dataclass(frozen=True)
class Report:
    """What came of it."""

    cases: int
    failures: tuple[str, ...]
    errors: tuple[str, ...]
    operations: int
    phases: Mapping[str, str]
    seconds: float
    output: str

    @property
    def clean(self) -> bool:
        """Whether nothing was found."""
        return not self.failures and not self.errors


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
    lines += ["[[operations]]", f'include-path = "{ENDLESS}"', "max-stream-events = 1", "request-timeout = 1"]
    return "\n".join([*lines, ""])


def _listed(statuses: tuple[int | str, ...]) -> str:
    return json.dumps([str(status) for status in statuses])


@contextmanager
def serving(folder: Path, *, key: str | None = None) -> Iterator[str]:
    """The real service as a process of its own; answers its address."""
    environment = {**os.environ, **SMALL} | ({"ROADTALK_API_KEY": key} if key else {})
    command = [sys.executable, "-m", "service", "serve", "--port", "0"]
    process = subprocess.Popen(
        [*command, "--database", f"sqlite:///{folder / 'generated.db'}"],
        cwd=ROOT,
        env=environment,
        stdout=subprocess.PIPE,
        text=True,
    )
    assert process.stdout is not None
    try:
        yield process.stdout.readline().rsplit(" ", 1)[-1].strip().rstrip("/")
    finally:
        process.kill()
        process.wait()
        process.stdout.close()


def generated(
    url: str,
    folder: Path,
    document: Mapping[str, Any],
    *options: str,
    seed: int,
    examples: int,
    key: str | None = None,
    timeout_s: float = 3_600,
) -> Report:
    """Let schemathesis loose on a service; `examples` for each call and phase."""
    settings, found = folder / "schemathesis.toml", folder / "report.json"
    settings.write_text(configuration(document), encoding="utf-8")
    command = [sys.executable, "-m", "schemathesis.cli", "--config-file", str(settings), "run"]
    command += [f"{url}/openapi.json", "--seed", str(seed), "-n", str(examples), "--request-timeout", "60"]
    command += ["--report", "json", "--report-json-path", str(found), *options]
    if key is not None:
        command += ["-H", f"Authorization: Bearer {key}"]
    done = subprocess.run(
        command, cwd=folder, capture_output=True, text=True, timeout=timeout_s, check=False, env=_plain()
    )
    if not found.exists():
        raise RuntimeError(f"schemathesis did not run:\n{done.stdout}\n{done.stderr}")
    told = json.loads(found.read_text(encoding="utf-8"))
    if told["operations"] is None:
        raise RuntimeError(f"schemathesis did not read the document:\n{done.stdout}\n{done.stderr}")
    return Report(
        cases=told["test_cases"]["generated"],
        failures=tuple(json.dumps(each)[:2_000] for each in told["failures"]),
        errors=tuple(json.dumps(each)[:2_000] for each in told["errors"]),
        operations=told["operations"]["tested"],
        phases={name: each["status"] for name, each in told["phases"].items()},
        seconds=told["running_time"],
        output=done.stdout,
    )


def _plain() -> dict[str, str]:
    """The environment without what would turn the tool's own warnings into errors."""
    return {name: value for name, value in os.environ.items() if name != "PYTHONWARNINGS"}


def openapi() -> dict[str, Any]:
    """The document of the service as it is."""
    from service.app import create_app
    from service.settings import Settings

    return create_app(Settings(database="memory:")).openapi()


def main() -> int:
    """The long run; prints totals. 1 where something was found."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cases", type=int, default=3_000, help="at least so many requests")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keyed", action="store_true", help="with a key configured")
    asked = parser.parse_args()
    document = openapi()
    calls = sum(len(item) for item in document["paths"].values())
    key = KEY if asked.keyed else None
    total, seconds, round_, found = 0, 0.0, 0, 0
    with tempfile.TemporaryDirectory() as name, serving(Path(name), key=key) as url:
        while total < asked.cases:
            examples = max(10, min(50, (asked.cases - total) // calls))
            report = generated(
                url, Path(name), document, seed=asked.seed + round_, examples=examples, key=key
            )
            total, seconds, round_ = total + report.cases, seconds + report.seconds, round_ + 1
            found += len(report.failures) + len(report.errors)
            print(f"seed {asked.seed + round_ - 1}: {report.cases} cases, {dict(report.phases)}")
            if not report.clean:
                print(report.output)
    print(f"{total} cases on {calls} calls in {seconds:.0f} s: {found} failures")
    return int(found > 0)


if __name__ == "__main__":
    sys.exit(main())
