"""`evaluate`: one sentence to many episodes and a report, on this machine or by a running service."""

from __future__ import annotations

import os
import time
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from threading import Event
from typing import Annotated, Any, Final, TypeAlias

import typer
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from service.actions import Varied
from service.cli.terminal import URL, ApiKey, Url, console, echo_json, fail, plain, service_at
from service.evaluations.kinds import part_key
from service.evaluations.request import evaluation_of
from service.narration import evaluation_words
from service.refusals import refusals
from service.resources import DEFAULT_LANGUAGE
from sim.config import Config
from sim.evaluate import Evaluation, EvaluationError, Part

FORMATS: Final = {".html": "html", ".md": "markdown", ".json": "json", ".csv": "csv"}
Ran: TypeAlias = tuple[dict[str, Any], dict[Part, bytes]]
"""What came of an evaluation, and of its parts."""
POLL_S: Final = 0.5
"""Seconds between two looks at an evaluation that a service runs."""


def evaluate(
    text: Annotated[str, typer.Argument(help="What to run, for instance: run 500 episodes with A*")],
    seed: Annotated[int, typer.Option(min=0, help="Of the first episode.")] = 0,
    processes: Annotated[
        int | None,
        typer.Option(min=1, max=256, help="Processes on this machine. Default: one for each core."),
    ] = None,
    to: Annotated[
        list[Path] | None, typer.Option(help="File of the report: .html, .md, .json or .csv. Repeatable.")
    ] = None,
    vary: Annotated[
        list[str] | None,
        typer.Option(help="Values to compare, for instance: traffic=light,heavy. Repeatable."),
    ] = None,
    language: Annotated[str, typer.Option(help="The language's code.")] = DEFAULT_LANGUAGE,
    service: Annotated[bool, typer.Option("--service", help="Have the running service do it.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print the figures as one JSON object.")] = False,
    url: Url = URL,
    api_key: ApiKey = None,
) -> None:
    """Run many episodes with one or several planners and report what came of them.

    Planners that are compared drive the same roads. The same sentence and
    seed give the same figures on any number of processes. No service is
    needed; with --service it is run there and its report is kept.

    Example: roadtalk evaluate "run 500 episodes with A* and compare with the rule planner"
    """
    for path in to or ():
        if path.suffix not in FORMATS:
            fail(f"A report is written as {', '.join(FORMATS)}, and not as {path.suffix or path.name}.")
        if not path.parent.is_dir():
            fail(f"There is no folder {path.parent} to write {path.name} to.")
    if service and vary:
        fail("--vary is for evaluations on this machine; say the conditions in the sentence.")
    if service:
        _by_service(text, seed, to or [], language, as_json, url, api_key)
    else:
        _here(text, seed, processes or os.cpu_count() or 1, to or [], language, as_json, url, vary or ())


def _here(
    text: str,
    seed: int,
    processes: int,
    to: list[Path],
    language: str,
    as_json: bool,
    url: str,
    vary: Sequence[str],
) -> None:
    """Run it on this machine."""
    spec = _read(text, seed, language, _varied(vary))
    report_of(spec, run_here(spec, processes, language), to, language, as_json, url)


def run_here(spec: Evaluation, processes: int, language: str) -> Ran:
    """The summary of an evaluation and its parts, run on this machine with a bar; Ctrl-C ends it."""
    parts: dict[Part, bytes] = {}
    return _run(spec, processes, parts, language), parts


def report_of(spec: Evaluation, ran: Ran, to: list[Path], language: str, as_json: bool, url: str) -> None:
    """Print what came of an evaluation, and write its reports."""
    summary, parts = ran
    words = evaluation_words(language)
    if as_json:
        echo_json({"spec": spec.to_json(), "result": summary})
    else:
        typer.echo(plain("\n\n".join(words.paragraphs(spec, summary))))
    for path in to:
        path.write_text(_written(FORMATS[path.suffix], spec, summary, parts, language, url), encoding="utf-8")
        typer.echo(f"{path}", err=as_json)


def _varied(options: Sequence[str]) -> Varied | None:
    """What `--vary` says; ends the command where it is not valid."""
    from pydantic import TypeAdapter, ValidationError

    values: dict[str, list[str | int]] = {}
    for option in options:
        name, _, listed = option.partition("=")
        values[name] = [int(each) if each.isdecimal() else each for each in listed.split(",")]
    try:
        return TypeAdapter(Varied).validate_python(values) if values else None
    except ValidationError as error:
        first = error.errors()[0]
        fail(plain(f"--vary {'.'.join(map(str, first['loc']))}: {first['msg']}."))


def _read(text: str, seed: int, language: str, vary: Varied | None = None) -> Evaluation:
    """The evaluation that a sentence asks for; ends the command with why there is none."""
    from service.actions import Evaluate, FindWorst
    from service.grammar import Language
    from service.grammar.parse_types import Understood

    words = refusals(language)
    try:
        parsed = Language.load(language).parse(text)
    except FileNotFoundError:
        fail(f"There is no language {language}.")
    if not isinstance(parsed, Understood):
        fail(plain(str(getattr(parsed, "message", "") or getattr(parsed, "question", ""))))
    match parsed.actions:
        case (Evaluate(road=None) as action,):
            pass
        case (Evaluate(),):
            fail(words.said("no_road_here"))
        case (FindWorst(),):
            fail(words.said("search_here"))
        case _:
            fail(words.said("no_evaluation"))
    try:
        return evaluation_of(replace(action, vary=vary or action.vary), Config(), seed=seed)
    except EvaluationError as error:
        problem = error.problems[0]
        if problem.code.endswith("_not_available"):
            fail(words.problem(problem))
        setting = "runs" if problem.field == "episodes" else problem.field
        fail(words.session("evaluation_refused", problem=problem, setting=setting))


def _run(spec: Evaluation, processes: int, parts: dict[Part, bytes], language: str) -> dict[str, Any]:
    """All episodes with a bar; Ctrl-C ends it."""
    from functools import partial

    from sim.evaluate.executor import LocalProcesses
    from sim.evaluate.run import pack_part, summarize_parts

    cancelled = Event()
    executor = LocalProcesses(processes)
    title = evaluation_words(language).title(spec)
    try:
        with _bar() as bar:
            task = bar.add_task(plain(title), total=spec.total)
            for piece, body in executor.run(partial(pack_part, spec.to_json()), spec.parts(), cancelled):
                parts[piece] = body
                bar.update(task, advance=piece.count)
            return summarize_parts(spec, parts, cancelled.is_set)
    except KeyboardInterrupt:
        fail("")
    finally:
        executor.close()


def _bar() -> Progress:
    """A bar on the error stream, so that the report alone is the output."""
    shown = console()
    shown.stderr = True
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    return Progress(*columns, console=shown, transient=True)


def _written(
    format: str,
    spec: Evaluation,
    summary: Mapping[str, Any],
    parts: Mapping[Part, bytes],
    language: str,
    base: str,
) -> str:
    """The report in a format; its links lead to the page of the service at `base`."""
    import json

    from service.evaluations.report.document import make_document
    from service.evaluations.report.write import write_csv, write_html, write_markdown

    if format == "json":
        return json.dumps({"spec": spec.to_json(), "result": summary}, indent=1) + "\n"
    if format == "csv":
        return write_csv(spec, {part_key(part): body for part, body in parts.items()})
    words = evaluation_words(language)
    document = make_document(spec, summary, words, language, base.rstrip("/"))
    return write_html(document, words) if format == "html" else write_markdown(document, words)


def _by_service(
    text: str, seed: int, to: list[Path], language: str, as_json: bool, url: str, api_key: str | None
) -> None:
    """Have the service run it, and wait for it."""
    with service_at(url, api_key) as client:
        found = client.evaluate(text, seed=seed, language=language)
        with _bar() as bar:
            task = bar.add_task(plain(found.title), total=found.runs)
            while found.state in ("queued", "running"):
                time.sleep(POLL_S)
                found = client.evaluation(found.id)
                bar.update(task, completed=found.done)
        if found.text is None:
            fail(plain(found.error or found.state))
        if as_json:
            echo_json(found.raw)
        else:
            typer.echo(plain("\n\n".join(found.text)))
            typer.echo(f"\n{client.url}{found.links['report']}")
        for path in to:
            path.write_text(client.report(found.id, format=FORMATS[path.suffix]), encoding="utf-8")
