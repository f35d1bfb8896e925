"""`scenario`: scenario files on this machine, and those that come with Roadtalk."""

from __future__ import annotations

import json
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Final

import typer
import yaml

from service.cli.evaluate import run_here
from service.cli.long_runs import check_reports, fail_refused
from service.cli.terminal import URL, echo_json, fail, plain
from service.refusals import refusals
from service.resources import DEFAULT_LANGUAGE
from service.scenarios import NAMES, ScenarioError, ScenarioFile, named_scenario, read_scenario
from sim.config import ConfigError
from sim.evaluate import EvaluationError
from sim.generation import GenerationError
from sim.session.errors import EditError

RUNS: Final = 100


class What(StrEnum):
    """What is done with a scenario."""

    LIST = "list"
    CHECK = "check"
    SHOW = "show"
    SAY = "say"
    LINK = "link"
    MAKE = "make"
    RUN = "run"
    SCHEMA = "schema"


def scenario(
    what: Annotated[What, typer.Argument(help="What to do.")],
    which: Annotated[str, typer.Argument(help="A name of the list, or a file; for make, a sentence.")] = "",
    name: Annotated[str, typer.Option(help="For make: its name, in words joined by -.")] = "my-scenario",
    reason: Annotated[str, typer.Option(help="For make: why it exists.")] = "Made from a sentence.",
    seed: Annotated[
        int | None, typer.Option(min=0, help="For make: of its road. For run: of the first run.")
    ] = None,
    runs: Annotated[int, typer.Option(help="For run: episodes of each planner.")] = RUNS,
    planner: Annotated[list[str] | None, typer.Option(help="For run: a planner. Repeatable.")] = None,
    processes: Annotated[
        int | None,
        typer.Option(min=1, max=256, help="For run: processes. Default: one for each core."),
    ] = None,
    to: Annotated[
        list[Path] | None,
        typer.Option(help="For run: file of the report. For make: .yaml or .json. Repeatable."),
    ] = None,
    language: Annotated[str, typer.Option(help="The language's code.")] = DEFAULT_LANGUAGE,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
    url: Annotated[str, typer.Option(help="Of the service whose page links open.")] = URL,
) -> None:
    """List, check, show, say, open, make and run scenario files.

    check names each flaw with line and field, and exits with 1. say prints
    the sentence that makes the scenario, where there is one; make writes the
    scenario that a sentence makes. run evaluates it: all runs on its road, or
    each on a road of its own where it has no seed. schema prints the form of
    a file as JSON Schema.

    Example: roadtalk scenario run rush-hour --runs 200 --planner astar --planner priority
    """
    match what:
        case What.LIST:
            _list(as_json)
        case What.SCHEMA:
            echo_json(ScenarioFile.model_json_schema())
        case What.MAKE:
            _write(_made(which, name, reason, seed, language), to or [], as_json)
        case What.RUN:
            _run(_found(which), runs, planner or [], seed, processes, to or [], language, as_json, url)
        case _:
            _tell(what, _found(which), language, as_json, url)


def _list(as_json: bool) -> None:
    if as_json:
        echo_json({"scenarios": [named_scenario(each).to_values() for each in NAMES]})
        return
    width = max(map(len, NAMES))
    for each in NAMES:
        typer.echo(f"{each:<{width}}  {named_scenario(each).reason}")


def _tell(what: What, found: ScenarioFile, language: str, as_json: bool, url: str) -> None:
    from service.grammar import Language
    from service.scenarios.begin import scenario_link
    from service.scenarios.evaluation import first_state
    from service.scenarios.words import sentence_of
    from sim.world.notation import write

    try:
        state = first_state(found)
    except (ConfigError, GenerationError, EditError) as error:
        fail(plain(f"{found.name}: {_why(error, language)}"))
    match what:
        case What.CHECK:
            typer.echo(
                f"{found.name}: a valid scenario of {len(found.setup)} changes and {len(found.rules)} rules"
            )
        case What.SHOW if as_json:
            echo_json(found.to_values())
        case What.SHOW:
            typer.echo(_yaml(found))
            typer.echo(write(state.world))
        case What.LINK:
            typer.echo(f"{url.rstrip('/')}/{scenario_link(found)}")
        case _:
            said = sentence_of(found, Language.load(language))
            if said is None:
                fail(f"No sentence makes {found.name}.")
            typer.echo(plain(said))


def _found(which: str) -> ScenarioFile:
    """A scenario by its name or its file; ends the command where there is none, or where it has flaws."""
    if which in NAMES:
        return named_scenario(which)
    path = Path(which)
    try:
        text = path.read_text(encoding="utf-8") if which else ""
    except (OSError, UnicodeDecodeError, ValueError):
        fail(plain(f"There is no scenario and no readable file {which}. There are: {', '.join(NAMES)}."))
    try:
        return read_scenario(text)
    except ScenarioError as error:
        fail(plain("\n".join(f"{path.name}: {flaw}" for flaw in error.flaws)))


def _made(text: str, name: str, reason: str, seed: int | None, language: str) -> ScenarioFile:
    from pydantic import ValidationError

    from service.grammar import Language
    from service.scenarios.words import NoScenarioError, scenario_of

    try:
        return scenario_of(text, Language.load(language), name, reason, seed)
    except (ConfigError, EditError) as error:
        fail(plain(_why(error, language)))
    except ValidationError as error:
        first = error.errors()[0]
        fail(plain(f"{'.'.join(map(str, first['loc']))}: {first['msg']}"))
    except (NoScenarioError, FileNotFoundError) as error:
        fail(plain(str(error)))


def _write(made: ScenarioFile, to: list[Path], as_json: bool) -> None:
    if not to:
        typer.echo(json.dumps(made.to_values(), indent=1) if as_json else _yaml(made))
    for path in to:
        text = json.dumps(made.to_values(), indent=1) + "\n" if path.suffix == ".json" else _yaml(made)
        path.write_text(text, encoding="utf-8")
        typer.echo(f"{path}")


def _run(
    found: ScenarioFile,
    runs: int,
    planners: list[str],
    seed: int | None,
    processes: int | None,
    to: list[Path],
    language: str,
    as_json: bool,
    url: str,
) -> None:
    from service.scenarios.evaluation import evaluation_of_scenario

    check_reports(to)
    try:
        spec = evaluation_of_scenario(found, runs, tuple(planners), seed)
    except EvaluationError as error:
        fail_refused(error, language, "runs")
    except (ConfigError, GenerationError, EditError) as error:
        fail(plain(_why(error, language)))
    run_here(spec, processes, None, to, language, as_json, url)


def _why(error: Exception, language: str) -> str:
    return refusals(language).edit(error) if isinstance(error, EditError) else str(error)


def _yaml(found: ScenarioFile) -> str:
    return str(yaml.safe_dump(found.to_values(), sort_keys=False, allow_unicode=True, width=100))
