"""`worst`: search for worlds that a planner fails although they can be driven, and replay those found."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from threading import Event
from typing import Annotated, Any, Final

import typer
import yaml
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

from service.cli.terminal import URL, console, echo_json, fail, plain
from service.evaluations.request import falsification_of
from service.narration import evaluation_words, falsification_words
from service.refusals import refusals
from service.resources import DEFAULT_LANGUAGE
from sim.config import Config
from sim.evaluate.spec import EvaluationError
from sim.falsify import Case, CaseError, Falsification
from sim.falsify.case import replay
from sim.falsify.stages import pieces, run_piece, total
from sim.types import Outcome

FORMATS: Final = {".html": "html", ".md": "markdown", ".json": "json", ".csv": "csv"}


def worst(
    text: Annotated[
        str, typer.Argument(help="What to look for, for instance: find a road where A* fails")
    ] = "",
    check: Annotated[
        list[Path] | None,
        typer.Option(help="Replay cases instead: files, JSON reports or folders of them. Repeatable."),
    ] = None,
    planner: Annotated[str | None, typer.Option(help="The planner, instead of the one said.")] = None,
    worlds: Annotated[int | None, typer.Option(help="Worlds to look at. Default: 1,000.")] = None,
    seed: Annotated[int, typer.Option(min=0, help="Of the first world.")] = 0,
    random: Annotated[bool, typer.Option("--random", help="Draw all worlds at random.")] = False,
    processes: Annotated[
        int | None,
        typer.Option(min=1, max=256, help="Processes on this machine. Default: one for each core."),
    ] = None,
    cases: Annotated[
        Path | None,
        typer.Option(help="Folder to write each case to: for --check, and as a scenario file."),
    ] = None,
    to: Annotated[
        list[Path] | None, typer.Option(help="File of the report: .html, .md, .json or .csv. Repeatable.")
    ] = None,
    language: Annotated[str, typer.Option(help="The language's code.")] = DEFAULT_LANGUAGE,
    as_json: Annotated[bool, typer.Option("--json", help="Print the result as one JSON object.")] = False,
    url: Annotated[str, typer.Option(help="Of the service whose page the report's links open.")] = URL,
) -> None:
    """Search for worlds that a planner fails although they can be driven.

    Each is proved to be drivable, and made small: without any one thing the
    planner arrives. With --check, cases that were found before are driven
    again, and it exits with 1 unless the planner arrives in all of them.

    Example: roadtalk worst "find a road where A* fails" --cases cases
    """
    if check:
        _check(check, planner)
        return
    for path in to or ():
        if path.suffix not in FORMATS:
            fail(f"A report is written as {', '.join(FORMATS)}, and not as {path.suffix or path.name}.")
        if not path.parent.is_dir():
            fail(f"There is no folder {path.parent} to write {path.name} to.")
    spec = _spec(text, planner, worlds, seed, language, directed=not random)
    if cases is not None:
        cases.mkdir(parents=True, exist_ok=True)
    parts: dict[str, bytes] = {}
    result = _search(spec, processes or os.cpu_count() or 1, parts, language)
    if as_json:
        echo_json({"spec": spec.to_json(), "result": result})
    else:
        typer.echo(plain("\n\n".join(falsification_words(language).paragraphs(spec, result))))
    for path in to or ():
        path.write_text(_written(path.suffix, spec, result, parts, language, url), encoding="utf-8")
        typer.echo(f"{path}", err=as_json)
    if cases is not None:
        for each in result["cases"]:
            path = cases / f"{each['case']['name']}.json"
            path.write_text(json.dumps(each["case"], indent=1) + "\n", encoding="utf-8")
            typer.echo(f"{path}", err=as_json)
            if each["scenario"] is not None:
                named = path.with_suffix(".yaml")
                named.write_text(yaml.safe_dump(each["scenario"], sort_keys=False), encoding="utf-8")
                typer.echo(f"{named}", err=as_json)


def _spec(
    text: str, planner: str | None, worlds: int | None, seed: int, language: str, *, directed: bool
) -> Falsification:
    """The search that is asked for; ends the command with why there is none."""
    from service.actions import FindWorst

    words = refusals(language)
    action = _read(text, language) if text else FindWorst()
    try:
        spec = falsification_of(action, Config(), seed)
        return Falsification(
            planner=planner or spec.planner,
            worlds=spec.worlds if worlds is None else worlds,
            config=spec.config,
            seed=seed,
            directed=directed,
        )
    except EvaluationError as error:
        problem = error.problems[0]
        if problem.code.endswith("_not_available"):
            fail(words.problem(problem))
        setting = "worlds" if problem.field == "episodes" else problem.field
        fail(words.session("evaluation_refused", problem=problem, setting=setting))


def _read(text: str, language: str) -> Any:
    """The one action of a sentence, which must ask for a search."""
    from service.actions import FindWorst
    from service.grammar import Language
    from service.grammar.parse_types import Understood

    try:
        parsed = Language.load(language).parse(text)
    except FileNotFoundError:
        fail(f"There is no language {language}.")
    if not isinstance(parsed, Understood):
        fail(plain(str(getattr(parsed, "message", "") or getattr(parsed, "question", ""))))
    match parsed.actions:
        case (FindWorst() as action,):
            return action
    fail(refusals(language).said("no_evaluation"))


def _search(spec: Falsification, processes: int, parts: dict[str, bytes], language: str) -> dict[str, Any]:
    """The whole search with a bar; Ctrl-C ends it."""
    from functools import partial

    from service.evaluations.cases import explain_cases
    from sim.evaluate.executor import LocalProcesses
    from sim.falsify.summary import summarize

    cancelled = Event()
    executor = LocalProcesses(processes)
    title = falsification_words(language).title(spec)
    try:
        with _bar() as bar:
            task = bar.add_task(plain(title), total=total(spec))
            while left := pieces(spec, parts):
                for piece, body in executor.run(partial(run_piece, spec.to_json()), left, cancelled):
                    parts[piece.key] = body
                    bar.update(task, advance=piece.weight)
            return explain_cases(summarize(spec, parts), language, cancelled.is_set)
    except KeyboardInterrupt:
        fail("")
    finally:
        executor.close()


def _bar() -> Progress:
    """A bar on the error stream, so that the report alone is the output."""
    shown = console()
    shown.stderr = True
    columns = (TextColumn("{task.description}"), BarColumn(), TaskProgressColumn(), TimeRemainingColumn())
    return Progress(*columns, console=shown, transient=True)


def _written(
    suffix: str,
    spec: Falsification,
    result: Mapping[str, Any],
    parts: Mapping[str, bytes],
    language: str,
    base: str,
) -> str:
    """The report in a format; its links lead to the page of the service at `base`."""
    from service.evaluations.report.failures import make_failure_document, write_worlds
    from service.evaluations.report.write import write_html, write_markdown

    if suffix == ".json":
        return json.dumps({"spec": spec.to_json(), "result": result}, indent=1) + "\n"
    if suffix == ".csv":
        return write_worlds(spec, parts)
    document = make_failure_document(spec, result, falsification_words(language), language, base.rstrip("/"))
    words = evaluation_words(language)
    return write_html(document, words) if suffix == ".html" else write_markdown(document, words)


def _check(paths: list[Path], planner: str | None) -> None:
    """Drive cases again and say of each what came of it."""
    failing = 0
    for name, case in _cases(paths):
        try:
            found = replay(case, planner)
        except ValueError as error:
            fail(plain(f"{name}: {error}"))
        if not found.drivable:
            fail(plain(f"{name}: the way that it carries does not arrive any more."))
        if found.outcome is Outcome.SUCCESS:
            told = f"arrives, after {found.ticks} ticks"
        else:
            failing += 1
            told = "fails as recorded" if found.as_recorded(case) else "fails, in another way than recorded"
            told += f": {found.outcome} after {found.ticks} ticks"
        typer.echo(plain(f"{name}  {told}"))
    if failing:
        raise typer.Exit(1)


def _cases(paths: list[Path]) -> Iterator[tuple[str, Case]]:
    """The cases of files, each with its name. Ends the command for a file that holds none."""
    files = [file for path in paths for file in (sorted(path.glob("*.json")) if path.is_dir() else [path])]
    if not files:
        fail("There are no cases to check.")
    for file in files:
        try:
            values = json.loads(file.read_bytes())
            report = values.get("result") if isinstance(values, dict) else None
            held = [values] if report is None else [each["case"] for each in report["cases"]]
            yield from ((case.name, case) for case in map(Case.from_json, held))
        except OSError as error:
            fail(f"{file} cannot be read: {error.strerror}.")
        except (CaseError, ValueError, KeyError, TypeError) as error:
            fail(plain(f"{file} is no case: {error}"))
