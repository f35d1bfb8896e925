"""`worst`: search for worlds that a planner fails although they can be driven, and replay those found."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Final

import typer

from service.cli.long_runs import (
    Processes,
    Ray,
    RayCommand,
    To,
    check_reports,
    check_room,
    fail_refused,
    parsed_actions,
    run_with_bar,
    tell,
)
from service.cli.terminal import URL, fail, plain
from service.evaluations.names import FIND_WORST
from service.resources import DEFAULT_LANGUAGE

if TYPE_CHECKING:
    from sim.falsify import Case, Falsification

COMMAND: Final = RayCommand


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
    processes: Processes = None,
    ray: Ray = None,
    cases: Annotated[
        Path | None,
        typer.Option(help="Folder to write each case to: for --check, and as a scenario file."),
    ] = None,
    to: To = None,
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

    from service.evaluations.view import view_of

    check_reports(to or ())
    spec = _spec(text, planner, worlds, seed, language, directed=not random)
    if cases is not None:
        cases.mkdir(parents=True, exist_ok=True)
    check_room(to or (), spec.worlds)
    parts: dict[str, bytes] = {}
    result = _search(spec, processes, ray, parts, language)
    told = {"spec": spec.to_json(), "result": result}
    tell(view_of(FIND_WORST, told["spec"], language), told, parts, to or (), language, as_json, url)
    if cases is not None:
        for each in result["cases"]:
            path = cases / f"{each['case']['name']}.json"
            path.write_text(json.dumps(each["case"], indent=1) + "\n", encoding="utf-8")
            typer.echo(f"{path}", err=as_json)
            if each["scenario"] is not None:
                import yaml

                named = path.with_suffix(".yaml")
                named.write_text(yaml.safe_dump(each["scenario"], sort_keys=False), encoding="utf-8")
                typer.echo(f"{named}", err=as_json)


def _spec(
    text: str, planner: str | None, worlds: int | None, seed: int, language: str, *, directed: bool
) -> Falsification:
    """The search that is asked for; ends the command with why there is none."""
    from service.actions import FindWorst
    from service.evaluations.request import falsification_of
    from sim.config import Config
    from sim.evaluate.spec import EvaluationError
    from sim.falsify import Falsification

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
        fail_refused(error, language, "worlds")


def _read(text: str, language: str) -> Any:
    """The one action of a sentence, which must ask for a search."""
    from service.actions import FindWorst
    from service.refusals import refusals

    match parsed_actions(text, language):
        case (FindWorst() as action,):
            return action
    fail(refusals(language).said("no_evaluation"))


def _search(
    spec: Falsification, processes: int | None, ray: str | None, parts: dict[str, bytes], language: str
) -> dict[str, Any]:
    """What came of the whole search; its cases in words."""
    from service.evaluations.cases import explain_cases
    from service.narration import falsification_words
    from sim.falsify.search import falsify
    from sim.falsify.stages import total

    result = run_with_bar(
        falsification_words(language).title(spec),
        total(spec),
        processes,
        ray,
        lambda executor, done, cancelled: falsify(spec, executor, done, cancelled, parts),
    )
    return explain_cases(result, language, lambda: False)


def _check(paths: list[Path], planner: str | None) -> None:
    """Drive cases again and say of each what came of it."""
    from sim.falsify.case import replay
    from sim.types import Outcome

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
    from sim.falsify import Case, CaseError

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
