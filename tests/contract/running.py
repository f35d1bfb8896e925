"""The running service, schemathesis beside it, and what it tells while it runs.

A run can last minutes, so it is followed: `hooks` adds a line to a file for each answer, which is counted
here. Whatever stops a run (a signal, the time it was given), what was found until then is told.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import httpx

from tests.contract.told import SEED, TOLD

ROOT = Path(__file__).parents[2]
PHASES = ("examples", "coverage", "fuzzing", "stateful")
POLL_S = 0.5
LINE_S = 10.0
"""How often progress is told where it is kept, not looked at."""
GRACE_S = 15.0
"""For the tool to end by itself and write what it has found."""
FIRST_S = 120.0
"""For the first answer of a service that starts beside other work."""


@contextmanager
def serving(folder: Path, settings: Mapping[str, str], *, key: str | None = None) -> Iterator[str]:
    """The real service as a process of its own; answers its address."""
    environment = {**os.environ, **settings} | ({"ROADTALK_API_KEY": key} if key else {})
    command = [sys.executable, "-m", "service", "serve", "--port", "0"]
    process = subprocess.Popen(
        [*command, "--database", f"sqlite:///{folder / 'generated.db'}"],
        cwd=ROOT,
        env=environment,
        stdout=subprocess.PIPE,
        text=True,
        start_new_session=True,  # Ctrl-C stops the run, which then stops the service
    )
    assert process.stdout is not None
    try:
        url = process.stdout.readline().rsplit(" ", 1)[-1].strip().rstrip("/")
        # The tool waits no more than 10 s for the document, which is made at the first request.
        httpx.get(f"{url}/openapi.json", timeout=FIRST_S).raise_for_status()
        yield url
    finally:
        process.kill()
        process.wait()
        process.stdout.close()


@dataclass
class Tally:
    """What was answered so far."""

    calls: Counter[str] = field(default_factory=Counter)
    statuses: Counter[int] = field(default_factory=Counter)
    violations: Counter[str] = field(default_factory=Counter)
    """by call, status and check"""

    @property
    def answers(self) -> int:
        """All of them."""
        return self.statuses.total()

    def add(self, line: bytes) -> None:
        """A line of the hooks."""
        call, status, *failed = json.loads(line)
        if failed:
            self.violations[f"{call}, {status}: {failed[0]}"] += 1
        else:
            self.calls[call] += 1
            self.statuses[status] += 1

    def __iadd__(self, other: Tally) -> Tally:
        self.calls += other.calls
        self.statuses += other.statuses
        self.violations += other.violations
        return self


@dataclass(frozen=True)
class Report:
    """What came of one run of the tool."""

    tally: Tally
    cases: int
    failures: tuple[str, ...]
    errors: tuple[str, ...]
    operations: int
    phases: Mapping[str, str]
    seconds: float
    output: str
    complete: bool

    @property
    def clean(self) -> bool:
        """Whether nothing was found."""
        return not self.failures and not self.errors and not self.tally.violations


@dataclass
class Tool:
    """schemathesis, and the service it is let loose on."""

    url: str
    folder: Path
    configuration: str
    key: str | None = None

    def run(
        self,
        phases: Sequence[str],
        *,
        seed: int,
        examples: int,
        until: float = float("inf"),
        follow: Callable[[Tally], None] = lambda _: None,
    ) -> Report:
        """Some phases, `examples` for each call, or scenarios; stopped at a time by the monotonic clock.

        `follow` is given the tally from time to time. Raises `RuntimeError` where the tool did not run,
        `KeyboardInterrupt` never: that stops the tool, and the report says that it is not complete.
        """
        settings, found, told = (self.folder / name for name in ("schemathesis.toml", "report.json", "told"))
        settings.write_text(self.configuration, encoding="utf-8")
        found.unlink(missing_ok=True)
        told.write_bytes(b"")
        command = [sys.executable, "-m", "schemathesis.cli", "--config-file", str(settings), "run"]
        command += [f"{self.url}/openapi.json", "--seed", str(seed), "-n", str(examples)]
        command += ["--request-timeout", "60", "--phases", ",".join(phases)]
        command += ["--report", "json", "--report-json-path", str(found)]
        if self.key is not None:
            command += ["-H", f"Authorization: Bearer {self.key}"]
        began, tally, ended = time.monotonic(), Tally(), False
        with (self.folder / "output").open("wb") as output, told.open("rb") as lines:
            process = subprocess.Popen(
                command,
                cwd=self.folder,
                env=_environment(told, seed),
                stdout=output,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )
            try:
                while not ended and time.monotonic() < until:
                    ended = _ended(process, POLL_S)
                    _count(lines, tally)
                    follow(tally)
            except KeyboardInterrupt:
                pass
            finally:
                if not ended:
                    process.send_signal(signal.SIGINT)
                    if not _ended(process, GRACE_S):
                        process.kill()
                        process.wait()
            _count(lines, tally)
        said = (self.folder / "output").read_text(encoding="utf-8", errors="replace")
        told_at_end = json.loads(found.read_text(encoding="utf-8")) if found.exists() else None
        if told_at_end is None and ended:
            raise RuntimeError(f"schemathesis did not run:\n{said}")
        return _report(told_at_end or {}, tally, said, time.monotonic() - began, complete=ended)


def _report(told: Mapping[str, Any], tally: Tally, output: str, seconds: float, *, complete: bool) -> Report:
    operations = told.get("operations")
    if complete and operations is None:
        raise RuntimeError(f"schemathesis did not read the document:\n{output}")
    return Report(
        tally=tally,
        cases=told["test_cases"]["generated"] if told else tally.answers,
        failures=tuple(json.dumps(each)[:2_000] for each in told.get("failures", ())),
        errors=tuple(json.dumps(each)[:2_000] for each in told.get("errors", ())),
        operations=operations["tested"] if operations else 0,
        phases={name: each["status"] for name, each in told.get("phases", {}).items()},
        seconds=seconds,
        output=output,
        complete=complete,
    )


def _ended(process: subprocess.Popen[bytes], seconds: float) -> bool:
    try:
        process.wait(seconds)
    except subprocess.TimeoutExpired:
        return False
    return True


def _count(lines: Any, tally: Tally) -> None:
    """What was added since, up to the last whole line."""
    while line := lines.readline():
        if not line.endswith(b"\n"):
            lines.seek(-len(line), os.SEEK_CUR)
            return
        tally.add(line)


def _environment(told: Path, seed: int) -> dict[str, str]:
    """With the hooks, and without what would turn the tool's own warnings into errors."""
    kept = {name: value for name, value in os.environ.items() if name != "PYTHONWARNINGS"}
    hooks = Path(__file__).with_name("hooks.py")
    return {
        **kept,
        "SCHEMATHESIS_HOOKS": str(hooks),
        "PYTHONPATH": str(ROOT),
        TOLD: str(told),
        SEED: str(seed),
    }
