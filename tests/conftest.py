"""For all tests: nothing is timed, nothing is left out in silence, and what never changes is read once.

Machines differ and share, so speed is for the benchmarks.
"""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Generator, Iterator
from functools import cache
from operator import itemgetter
from typing import TypeVar

import fastapi.routing
import pytest
from hypothesis import HealthCheck, settings

from service.grammar import engine
from service.interpreter import languages
from service.interpreter.languages import Languages
from service.llm.claims import Claims
from service.narration import Narrator
from tests.support.postgres import Server, binaries, serving
from tests.support.skips import EVEN_IN_CI

pytest_plugins = ["tests.support.service"]

Report = TypeVar("Report", pytest.TestReport, pytest.CollectReport)

# The same examples each time, and as many seconds for them as a machine needs.
settings.register_profile(
    "untimed", derandomize=True, deadline=None, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("untimed")


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport() -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """In CI, a test that is skipped has failed."""
    report = yield
    return _not_in_ci(report)


@pytest.hookimpl(wrapper=True)
def pytest_make_collect_report() -> Generator[None, pytest.CollectReport, pytest.CollectReport]:
    """The same of a whole module."""
    report = yield
    return _not_in_ci(report)


def _not_in_ci(report: Report) -> Report:
    if os.environ.get("CI") and report.skipped and isinstance(report.longrepr, tuple):
        reason = report.longrepr[2].removeprefix("Skipped: ")
        if not reason.startswith(EVEN_IN_CI):
            report.outcome = "failed"
            report.longrepr = f"skipped, and in CI nothing may be: {reason}"
    return report


_UNCHANGING = pytest.MonkeyPatch()


def pytest_configure() -> None:
    """Before the first test is even imported, for many read grammars and documents then."""
    _words_read_once()
    _answers_described_once()
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        # A shell has what it starts in the background ignore Ctrl-C, and so would the programs under test.
        signal.signal(signal.SIGINT, signal.default_int_handler)


def pytest_unconfigure() -> None:
    """All as it was."""
    _UNCHANGING.undo()


def _words_read_once() -> None:
    """Grammars and sayings never change, and reading them is most of what making an application takes."""
    _UNCHANGING.setattr(engine, "load_language", cache(engine.load_language))
    for read in (Languages, Narrator, Claims):
        _UNCHANGING.setattr(read, "load", cache(read.load))
    _UNCHANGING.setattr(languages, "Guide", cache(languages.Guide))


def _answers_described_once() -> None:
    """Each application would make a schema of every answer anew with its first request: all alike."""
    make = getattr(fastapi.routing, "create_model_field", None)
    if make is not None:
        _UNCHANGING.setattr(fastapi.routing, "create_model_field", _kept(make))


def _kept(make: Callable[..., object]) -> Callable[..., object]:
    """The same field for the same name, type and whatever else it is made from."""
    kept: dict[object, object] = {}

    def field(**parts: object) -> object:
        try:
            key = tuple(sorted(parts.items(), key=itemgetter(0)))
            hash(key)
        except TypeError:
            return make(**parts)
        if key not in kept:
            kept[key] = make(**parts)
        return kept[key]

    return field


@pytest.fixture(scope="session")
def postgres() -> Iterator[Server]:
    """A PostgreSQL server for the tests that want one; on a machine without one they are skipped."""
    programs = binaries()
    if programs is None:
        pytest.skip("no PostgreSQL server is installed (Debian: apt-get install postgresql)")
    with serving(programs) as server:
        yield server
