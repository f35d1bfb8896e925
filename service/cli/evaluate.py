"""`evaluate`: one sentence to many episodes and a report, on this machine or by a running service."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final, cast

import typer

from service.cli.long_runs import (
    FORMATS,
    Processes,
    Ray,
    RayCommand,
    To,
    bar,
    check_reports,
    check_room,
    fail_refused,
    parsed_actions,
    run_with_bar,
    tell,
    write_report,
)
from service.cli.terminal import URL, ApiKey, Url, echo_json, fail, plain, service_at
from service.evaluations.names import EVALUATION
from service.resources import DEFAULT_LANGUAGE

if TYPE_CHECKING:
    from service.actions import MapAxis, Varied
    from sim.evaluate import Evaluation, Part

COMMAND: Final = RayCommand
POLL_S: Final = 0.5
"""Seconds between two looks at an evaluation that a service runs."""


def evaluate(
    text: Annotated[str, typer.Argument(help="What to run, for instance: run 500 episodes with A*")],
    seed: Annotated[
        int | None,
        typer.Option(
            min=0,
            help="Of the first episode, and of the road where the sentence says this road. "
            "Default: 0; of a scenario that is named, its own.",
        ),
    ] = None,
    processes: Processes = None,
    ray: Ray = None,
    to: To = None,
    vary: Annotated[
        list[str] | None,
        typer.Option(help="Values to compare, for instance: traffic=light,heavy. Repeatable."),
    ] = None,
    map_over: Annotated[
        str | None,
        typer.Option("--map", help="Draw a success map over two numbers, for instance: potholes,vehicles."),
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
    check_reports(to or ())
    if service and (vary or ray or map_over):
        name = "vary" if vary else "ray" if ray else "map"
        fail(f"--{name} is for evaluations that this command runs itself; leave out --service.")
    if service:
        _by_service(text, seed, to or [], language, as_json, url, api_key)
    else:
        spec = _read(text, seed, language, _varied(vary or ()), _axes(map_over))
        run_here(spec, processes, ray, to or [], language, as_json, url)


def run_here(
    spec: Evaluation,
    processes: int | None,
    ray: str | None,
    to: Sequence[Path],
    language: str,
    as_json: bool,
    url: str,
) -> None:
    """Run an evaluation on this machine or a cluster, print what came of it and write its reports."""
    from service.evaluations.kinds import part_key
    from service.evaluations.view import view_of
    from service.narration import evaluation_words
    from sim.evaluate.run import evaluate as run

    check_room(to, spec.total * len(spec.planners))
    parts: dict[Part, bytes] = {}
    summary = run_with_bar(
        evaluation_words(language).title(spec),
        spec.total,
        processes,
        ray,
        lambda executor, done, cancelled: run(spec, executor, done, cancelled, parts),
    )
    told = {"spec": spec.to_json(), "result": summary}
    kept = {part_key(part): body for part, body in parts.items()}
    tell(view_of(EVALUATION, told["spec"], language), told, kept, to, language, as_json, url)


def _varied(options: Sequence[str]) -> Varied | None:
    """What `--vary` says; ends the command where it is not valid."""
    from pydantic import TypeAdapter, ValidationError

    from service.actions import Varied

    values: dict[str, list[str | int]] = {}
    for option in options:
        name, _, listed = option.partition("=")
        values[name] = [int(each) if each.isdecimal() else each for each in listed.split(",")]
    try:
        return TypeAdapter(Varied).validate_python(values) if values else None
    except ValidationError as error:
        first = error.errors()[0]
        fail(plain(f"--vary {'.'.join(map(str, first['loc']))}: {first['msg']}."))


def _axes(option: str | None) -> tuple[MapAxis, MapAxis] | None:
    """What `--map` says; ends the command where it is not valid."""
    from sim.evaluate.success_map import AXES

    names = (option or "").split(",")
    if option is None:
        return None
    if len(names) != 2 or names[0] == names[1] or any(name not in AXES for name in names):
        fail(f"--map takes two of {', '.join(AXES)}, such as potholes,vehicles.")
    return cast("tuple[MapAxis, MapAxis]", tuple(names))


def _read(
    text: str, seed: int | None, language: str, vary: Varied | None, axes: tuple[MapAxis, MapAxis] | None
) -> Evaluation:
    """The evaluation that a sentence asks for; ends the command with why there is none."""
    from service.actions import Evaluate, FindWorst
    from service.evaluations.request import evaluation_of
    from service.refusals import refusals
    from sim.config import Config
    from sim.evaluate import EvaluationError
    from sim.state import SimState

    words = refusals(language)
    match parsed_actions(text, language):
        case (Evaluate() as action,):
            if action.road is not None and seed is None:
                fail(words.said("no_road_here"))
        case (FindWorst(),):
            fail(words.said("search_here"))
        case _:
            fail(words.said("no_evaluation"))
    asked = replace(action, vary=vary or action.vary, map=axes or action.map)
    config = Config() if seed is None else replace(Config(), seed=seed)
    try:
        road = None if asked.road is None else SimState.start(config)  # "this road" is the one of the seed
        return evaluation_of(asked, config, road, seed)
    except EvaluationError as error:
        fail_refused(error, language, "runs")


def _by_service(
    text: str, seed: int | None, to: list[Path], language: str, as_json: bool, url: str, api_key: str | None
) -> None:
    """Have the service run it, and wait for it."""
    with service_at(url, api_key) as client:
        found = client.evaluate(text, seed=seed, language=language)
        with bar() as shown:
            task = shown.add_task(plain(found.title), total=found.runs)
            while found.state in ("queued", "running"):
                time.sleep(POLL_S)
                found = client.evaluation(found.id)
                shown.update(task, completed=found.done)
        if found.text is None:
            fail(plain(found.error or found.state))
        if as_json:
            echo_json(found.raw)
        else:
            typer.echo(plain("\n\n".join(found.text)))
            typer.echo(f"\n{client.url}{found.links['report']}")
        for path in to:
            write_report(path, client.report(found.id, format=FORMATS[path.suffix]))
