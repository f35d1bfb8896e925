"""`play`: the road in a window of its own."""

from __future__ import annotations

import re
import secrets
from os import environ
from typing import TYPE_CHECKING, Annotated, NoReturn

import typer

from sim import planner_names
from sim.config import Config, ConfigError

if TYPE_CHECKING:
    from service.window.loading import Loading
    from sim.actions import Scenario

SIZE = "1440x900"
LEAST_PX = 320
MOST_PX = 8_192
UNUSABLE = 2
"""Exit status where a window cannot be had, or was asked for wrongly."""


def play(
    potholes: Annotated[
        int | None, typer.Option(min=0, help="How many potholes; asked for in the window if not given.")
    ] = None,
    obstacles: Annotated[int | None, typer.Option(min=0, help="How many obstacle vehicles.")] = None,
    seed: Annotated[
        int | None, typer.Option(min=0, help="The road's seed.", show_default="a new one")
    ] = None,
    scenario: Annotated[
        str | None, typer.Option(help='The road in a sentence: "a highway with 10 potholes".')
    ] = None,
    planner: Annotated[str | None, typer.Option(help="Who decides.", show_default=Config().planner)] = None,
    language: Annotated[
        str, typer.Option(envvar="ROADTALK_LANGUAGE", help="The language of the window: en or de.")
    ] = "en",
    size: Annotated[str, typer.Option(help="Width and height of the window in pixels.")] = SIZE,
) -> None:
    """Open the road in a window: drive, watch it drive, talk to it. No service is needed.

    Press ? in the window for all keys. Exits with 2 where there is no display.

    Example: roadtalk play --potholes 12
    """
    room = _size(size)
    if planner is not None and not planner_names.known(planner):
        _refuse(f"There is no planner called {planner}. There are: {', '.join(planner_names.names())}.")
    given: dict[str, object] = {"seed": secrets.randbits(32) if seed is None else seed}
    given |= {} if obstacles is None else {"vehicles": obstacles}
    given |= {} if planner is None else {"planner": planner}
    given |= {} if potholes is None else {"potholes": potholes}
    try:
        base = Config().with_parts(**given)
    except ConfigError as error:
        _refuse_road(error)

    environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")
    _choose_language(language)
    from service.window import loop
    from service.window.loading import LoadError, Loading

    loading = Loading()
    if scenario is not None:
        base = _described(loading, scenario, base, given)

    def config_of(asked: int | None) -> Config:
        return base if not ask or asked is None else base.with_parts(potholes=asked)

    ask = potholes is None and scenario is None
    try:
        loop.play(loop.open_display(room), config_of, ask=ask, loading=loading)
    except loop.NoDisplayError as error:
        _refuse(
            f"There is no display to open a window on ({error}). Run it on a desktop, or use the page: "
            "roadtalk serve"
        )
    except LoadError as error:
        _refuse(str(error))
    except KeyboardInterrupt:
        pass  # Ctrl-C in the terminal closes the window like anything else


def _described(loading: Loading, sentence: str, base: Config, given: dict[str, object]) -> Config:
    """The road that a sentence describes; what was given as an option stands."""
    from service.window.loading import LoadError
    from service.window.scenario import NoScenarioError, scenario_in
    from sim.session.scenario import config_of_scenario

    try:
        scenario: Scenario = scenario_in(sentence, loading.wait().languages)
        return config_of_scenario(base, scenario).with_parts(**given)
    except (LoadError, NoScenarioError) as error:
        _refuse(str(error))
    except ConfigError as error:
        _refuse_road(error)


def _choose_language(code: str) -> None:
    from service.window.texts import choose_language, languages

    try:
        choose_language(code)
    except ValueError:
        _refuse(f"The window speaks no language {code}. It speaks: {', '.join(languages())}.")


def _size(text: str) -> tuple[int, int]:
    found = re.fullmatch(r"\s*(\d{3,4})\s*[xX×]\s*(\d{3,4})\s*", text)
    if found is None or not all(LEAST_PX <= int(side) <= MOST_PX for side in found.groups()):
        _refuse(
            f"{text!r} is no size of a window; say for instance {SIZE}, and at least {LEAST_PX} each way."
        )
    return int(found[1]), int(found[2])


def _refuse_road(error: ConfigError) -> NoReturn:
    from service.refusals import refusals

    told = "; ".join(f"{each.field}: {refusals().problem(each)}" for each in error.problems)
    _refuse(f"There can be no such road: {told}.")


def _refuse(message: str) -> NoReturn:
    typer.echo(message, err=True)
    raise typer.Exit(UNUSABLE)
