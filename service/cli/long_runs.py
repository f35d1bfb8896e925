"""What commands that run for minutes share: where the work is run, its bar, and its reports."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from shutil import disk_usage
from threading import Event
from typing import TYPE_CHECKING, Annotated, Any, Final, NoReturn, TypeAlias, TypeVar

import typer
from typer.core import TyperCommand

from service.cli.terminal import console, echo_json, fail, plain

if TYPE_CHECKING:
    from rich.progress import Progress

    from service.evaluations.view import JobView
    from sim.evaluate.executor import Executor
    from sim.evaluate.spec import EvaluationError

FORMATS: Final = {".html": "html", ".md": "markdown", ".json": "json", ".csv": "csv"}
"""The formats of reports, by the ending of the file."""
HERE: Final = "local"
"""What `--ray` without an address stands for."""
_REPORT_BYTES: Final = 4_000_000
"""Room for a report without its episodes."""
_LINE_BYTES: Final = 80
"""Room for a line of a CSV."""
_MB: Final = 1_000_000
_ADDRESS: Final = re.compile(r"auto|local|\S+:\d+")

Told: TypeAlias = Callable[[int], None]
"""Is told how much of the work is done."""
Result = TypeVar("Result")

Processes = Annotated[
    int | None, typer.Option(min=1, max=256, help="Processes on this machine. Default: one for each core.")
]
To = Annotated[
    list[Path] | None, typer.Option(help="File of the report: .html, .md, .json or .csv. Repeatable.")
]
Ray = Annotated[
    str | None,
    typer.Option(
        metavar="[ADDRESS]",
        help="Run on a Ray cluster: host:port, auto, or without an address one started here for this run.",
    ),
]


class RayCommand(TyperCommand):
    """A command whose option `--ray` may go without its value."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """The words of the command line, with the value that was left out."""
        return super().parse_args(ctx, with_address(args))


def with_address(args: Sequence[str]) -> list[str]:
    """The arguments with an address after each `--ray`: the next word is one only if it looks like one."""
    found: list[str] = []
    for place, word in enumerate(args):
        follows = args[place + 1] if place + 1 < len(args) else ""
        bare = word == "--ray" and not _ADDRESS.fullmatch(follows)
        found += ["--ray", HERE] if bare else [word]
    return found


def check_reports(to: Sequence[Path]) -> None:
    """Ends the command where a report cannot be written; before any work is done."""
    for path in to:
        if path.suffix not in FORMATS:
            fail(f"A report is written as {', '.join(FORMATS)}, and not as {path.suffix or path.name}.")
        if not path.parent.is_dir():
            fail(f"There is no folder {path.parent} to write {path.name} to.")
        if path.is_dir() or not os.access(path if path.exists() else path.parent, os.W_OK):
            fail(f"{path} cannot be written: it is a folder, or its permissions forbid it.")


def check_room(to: Sequence[Path], lines: int) -> None:
    """Ends the command where a disk has no room for a report. `lines`: how many a CSV has."""
    for path in to:
        needed = _REPORT_BYTES + (_LINE_BYTES * lines if path.suffix == ".csv" else 0)
        free = disk_usage(path.parent).free
        if free < needed:
            fail(
                f"{path.name} may take {-(-needed // _MB)} MB, and the disk of {path.parent} has "
                f"{free // _MB} MB left. Nothing was started."
            )


def write_report(path: Path, text: str) -> None:
    """Write a report; ends the command where that fails."""
    try:
        path.write_text(text, encoding="utf-8")
    except OSError as error:
        fail(plain(f"{path} cannot be written: {error.strerror or error}."))


def parsed_actions(text: str, language: str) -> tuple[Any, ...]:
    """The actions of a sentence; ends the command with why it has none."""
    from service.grammar import Language
    from service.grammar.parse_types import Understood

    try:
        parsed = Language.load(language).parse(text)
    except FileNotFoundError:
        fail(f"There is no language {language}.")
    if not isinstance(parsed, Understood):
        fail(plain(str(getattr(parsed, "message", "") or getattr(parsed, "question", ""))))
    return tuple(parsed.actions)


def fail_refused(error: EvaluationError, language: str, runs: str) -> NoReturn:
    """End the command with what cannot be run. `runs`: what their number is called."""
    from service.refusals import refusals

    words = refusals(language)
    problem = error.problems[0]
    if problem.code.endswith("_not_available"):
        fail(words.problem(problem))
    setting = runs if problem.field == "episodes" else problem.field
    fail(plain(words.session("evaluation_refused", problem=problem, setting=setting)))


def run_with_bar(
    title: str,
    total: int,
    processes: int | None,
    ray: str | None,
    run: Callable[[Executor, Told, Event], Result | None],
) -> Result:
    """What came of work that is run with a bar, on processes of this machine or a cluster; Ctrl-C ends it."""
    from sim.evaluate.executor import CancelledError, WorkersLostError
    from sim.evaluate.ray_executor import RayError

    cancelled = Event()
    try:
        executor = _executor(processes or os.cpu_count() or 1, ray)
        try:
            with bar() as shown:
                task = shown.add_task(plain(title), total=total)
                found = run(executor, lambda done: shown.update(task, completed=done), cancelled)
        finally:
            executor.close()
    except (KeyboardInterrupt, CancelledError):
        fail("")
    except (RayError, WorkersLostError) as error:
        fail(plain(f"{error}."))
    assert found is not None
    return found


def _executor(processes: int, ray: str | None) -> Executor:
    if ray is not None:
        from sim.evaluate.ray_executor import RayExecutor

        return RayExecutor(ray, processes)
    from sim.evaluate.executor import LocalProcesses

    return LocalProcesses(processes)


def bar() -> Progress:
    """A bar on the error stream, so that the report alone is the output."""
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    shown = console()
    shown.stderr = True
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    return Progress(*columns, console=shown, transient=True)


def tell(
    view: JobView,
    told: Mapping[str, Any],
    parts: Mapping[str, bytes],
    to: Sequence[Path],
    language: str,
    as_json: bool,
    url: str,
) -> None:
    """Print what came of it, and write its reports. `told`: what was run and its result, as in the JSON."""
    if as_json:
        echo_json(told)
    else:
        typer.echo(plain("\n\n".join(view.paragraphs(told["result"]))))
    for path in to:
        write_report(path, _written(FORMATS[path.suffix], view, told, parts, language, url))
        typer.echo(f"{path}", err=as_json)


def _written(
    format: str,
    view: JobView,
    told: Mapping[str, Any],
    parts: Mapping[str, bytes],
    language: str,
    base: str,
) -> str:
    """The report in a format; its links lead to the page of the service at `base`."""
    from service.evaluations.report.write import write_html, write_markdown
    from service.narration import evaluation_words

    if format == "json":
        return json.dumps(told, indent=1) + "\n"
    if format == "csv":
        return view.csv(parts)
    words = evaluation_words(language)
    document = view.document(told["result"], base.rstrip("/"))
    return write_html(document, words) if format == "html" else write_markdown(document, words)
