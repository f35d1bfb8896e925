"""For all tests: nothing is timed, and nothing is skipped in CI.

Machines differ and share, so speed is for the benchmarks.
"""

from __future__ import annotations

import os
import signal
from collections.abc import Generator, Iterator
from typing import TypeVar

import pytest
from hypothesis import HealthCheck, settings

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


@pytest.hookimpl(tryfirst=True)  # before pytest-xdist reads the groups, and after the hooks of folders
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """A file's tests run in one worker, unless it is in a larger group.

    What they share (fixtures of the module, drives and answers that are kept) would otherwise be made in
    every worker.
    """
    for item in items:
        if item.get_closest_marker("xdist_group") is None:
            item.add_marker(pytest.mark.xdist_group(item.nodeid.partition("::")[0]))


def _not_in_ci(report: Report) -> Report:
    if os.environ.get("CI") and report.skipped and isinstance(report.longrepr, tuple):
        reason = report.longrepr[2].removeprefix("Skipped: ")
        if not reason.startswith(EVEN_IN_CI):
            report.outcome = "failed"
            report.longrepr = f"skipped, and in CI nothing may be: {reason}"
    return report


def pytest_configure() -> None:
    """Programs under test are stopped by Ctrl-C, also where these tests run in the background."""
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        # A shell has what it starts in the background ignore Ctrl-C, and so would the programs under test.
        signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(scope="session")
def postgres() -> Iterator[Server]:
    """A PostgreSQL server for the tests that want one; on a machine without one they are skipped."""
    programs = binaries()
    if programs is None:
        pytest.skip("no PostgreSQL server is installed (Debian: apt-get install postgresql)")
    with serving(programs) as server:
        yield server
