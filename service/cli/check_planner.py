"""`check-planner`: does a planner keep its promises? Whatever it does, this ends and says what it found."""

from __future__ import annotations

import sys
import time
from pathlib import Path
from typing import Annotated

import typer

from service.cli.terminal import plain
from sim import planner_names
from sim.evaluate.metamorphic import RELATIONS, ROADS, check_relations
from sim.plan.conformance import MAX_TOLD, Defect, Report, check, check_apart, find_planner, name_conflicts

DEFECTS, UNTRIED = 1, 2
"""Exit statuses."""

TOLD_EVERY_S = 5.0
"""Where progress is no line that is written anew."""


def check_planner(
    name: Annotated[str, typer.Argument(help="The planner's name, for instance: astar")],
    seconds: Annotated[float, typer.Option(min=1.0, help="How long it is tried at most.")] = 60.0,
    relations: Annotated[
        bool, typer.Option("--relations", help="Compare drives on roads that differ in a known way, too.")
    ] = False,
    roads: Annotated[int, typer.Option(min=1, max=100_000, help="For --relations: roads.")] = ROADS,
    worlds: Annotated[
        Path | None, typer.Option(help="For --relations: folder to write both roads of each finding to.")
    ] = None,
) -> None:
    """Try a planner's promises on many roads.

    One of another package runs in a process of its own, with limits, as it
    does in a session. Exits with 1 when a promise is broken, and with 2 when
    it could not be tried. With --relations it drives roads and their mirror
    images, with a pothole more away from its way, with a barrier behind it
    that it never reaches, and with longer sight. What does not hold is told
    with a counterexample; it is a finding, and leaves the exit status alone.

    Example: roadtalk check-planner astar
    """
    if worlds is not None and not worlds.is_dir():
        typer.echo(f"There is no folder {plain(str(worlds))}.", err=True)
        raise typer.Exit(UNTRIED)
    wrong = name_conflicts(name)
    planner = find_planner(name)
    if planner is None and name not in planner_names.installed():
        _tell(wrong)
        if not wrong:
            there = ", ".join(planner_names.names())
            typer.echo(f"There is no planner called {plain(name)}. There are: {there}.", err=True)
        raise typer.Exit(DEFECTS if wrong else UNTRIED)
    progress = _Progress()
    if planner is None:
        report = check_apart(name, seconds, tell=progress.tell)
    else:
        report = check(planner, tell=progress.tell)
    progress.done()
    _tell([*wrong, *report.defects])
    if relations and report.decisions and report.untried is None:
        _tell_relations(name, roads, seconds, worlds)
    _conclude(report, wrong)


def _tell_relations(name: str, roads: int, seconds: float, worlds: Path | None) -> None:
    """Each relation: how often it was tried, and the first road on which it does not hold."""
    progress = _Progress()
    found = check_relations(name, roads, seconds, progress.tell)
    progress.done()
    for relation in found:
        broken = len(relation.findings)
        kept = f"held on {relation.tried - broken} of {relation.tried} roads"
        typer.echo(f"{relation.name:<14} {RELATIONS[relation.name]} It {kept}.")
        for finding in relation.findings[:1]:
            typer.echo(f"{'':<14} seed {finding.seed}, tick {finding.tick}: {plain(finding.what)}")
        if worlds is not None:
            for finding in relation.findings:
                path = worlds / f"{relation.name}-{finding.seed}.txt"
                path.write_text(f"{finding.road}\n{finding.other}", encoding="utf-8")


def _tell(defects: list[Defect]) -> None:
    """The first few of each promise that is broken."""
    by_promise: dict[str, list[Defect]] = {}
    for defect in defects:
        by_promise.setdefault(defect.promise, []).append(defect)
    for promise, broken in by_promise.items():
        told = broken[: max(1, MAX_TOLD // len(by_promise))]
        for defect in told:
            where = f"seed {defect.seed}, tick {defect.tick}"
            typer.echo(f"{promise:<14} {where}: {plain(defect.what)}")
        if len(broken) > len(told):
            typer.echo(f"{promise:<14} ... and {len(broken) - len(told)} more")


def _conclude(report: Report, wrong: list[Defect]) -> None:
    broken = len({defect.promise for defect in (*wrong, *report.defects)})
    ended = f"; ended early: {report.untried}" if report.untried else ""
    typer.echo(f"{report.planner}: {report.decisions} decisions, {broken} promises broken{ended}")
    if report.decisions == 0 or (report.untried is not None and report.untried.startswith("it could not")):
        raise typer.Exit(UNTRIED)
    if broken:
        raise typer.Exit(DEFECTS)


class _Progress:
    """What is being done now, on standard error: a line written anew, or one every few seconds."""

    def __init__(self) -> None:
        self._anew = sys.stderr.isatty()
        self._told_s = 0.0
        self._wrote = False

    def tell(self, doing: str) -> None:
        """Say it, if it is time to."""
        now_s = time.monotonic()
        if now_s - self._told_s >= (0.1 if self._anew else TOLD_EVERY_S):
            self._told_s = now_s
            self._wrote = True
            typer.echo(f"\r{doing:<78}" if self._anew else doing, err=True, nl=not self._anew)

    def done(self) -> None:
        """Go on below."""
        if self._anew and self._wrote:
            typer.echo(f"\r{'':<78}\r", err=True, nl=False)
