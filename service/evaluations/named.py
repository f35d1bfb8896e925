"""Evaluations of what has a name: a scenario that comes with Roadtalk, or a moment saved in a session."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import asdict, replace
from typing import Final

from service.actions import Evaluate
from sim.config import Config, ConfigError, Problem
from sim.evaluate.cases import SENSING, VARIED, cases_of, config_under
from sim.evaluate.spec import MAX_EPISODES, Evaluation, EvaluationError
from sim.generation import GenerationError
from sim.randomness import MAX_SEED
from sim.session.errors import EditError
from sim.state import SimState
from sim.types import Outcome
from sim.world.notation import write

MAX_LISTED: Final = 10
"""Most names of saved moments in the refusal of an unknown one."""


def evaluation_of_name(
    action: Evaluate, runs: int, config: Config, saved: Mapping[str, SimState], seed: int | None
) -> Evaluation:
    """Many episodes of what an evaluation names, under the conditions that it says.

    `saved` are the moments of the session, which come before scenarios of the same name; `config` is the
    configuration whose planner drives where none is named. Raises `EvaluationError`.
    """
    assert action.scenario_name is not None
    if action.road is not None:
        raise EvaluationError((Problem("road", "is_that_of_the_scenario"),))
    state = _saved(action.scenario_name, saved)
    if state is not None:
        spec = _of_moment(action.scenario_name, state, action.planners or (config.planner,), runs, seed)
    else:
        spec = _of_scenario(action, runs, config, saved, seed)
    try:
        return replace(spec, config=_config_under(action, spec))
    except ConfigError as error:
        raise EvaluationError(error.problems) from error


def state_as_road(state: SimState) -> str:
    """The world of a state, for episodes that start from it. Raises `EvaluationError` where none can."""
    if state.world.outcome is not Outcome.RUNNING or len(state.world.avs) != 1:
        raise EvaluationError((Problem("road", "has_no_start"),))
    return write(state.world)


def first_seed(config: Config) -> int:
    """The first seed of an evaluation that names none: that of a configuration, if enough come after it."""
    return config.seed if config.seed <= MAX_SEED - MAX_EPISODES else 0


def name_key(name: str) -> str:
    """A name as names are compared: "Rush Hour" is "rush-hour"."""
    return re.sub(r"[\s_-]+", "-", name.strip().casefold())


def _saved(name: str, saved: Mapping[str, SimState]) -> SimState | None:
    if name in saved:
        return saved[name]
    alike = [state for other, state in saved.items() if name_key(other) == name_key(name)]
    return alike[-1] if alike else None


def _of_moment(
    name: str, state: SimState, planners: tuple[str, ...], runs: int, seed: int | None
) -> Evaluation:
    config = state.config_of()
    return Evaluation(
        planners=planners,
        episodes=runs,
        config=config,
        seed=first_seed(config) if seed is None else seed,
        world=state_as_road(state),
        scenario_name=name,
    )


def _of_scenario(
    action: Evaluate, runs: int, config: Config, saved: Mapping[str, SimState], seed: int | None
) -> Evaluation:
    from service.scenarios import NAMES, named_scenario  # at the first name: reading files takes a while
    from service.scenarios.evaluation import evaluation_of_scenario

    assert action.scenario_name is not None
    key = name_key(action.scenario_name)
    if key not in NAMES:
        # As one text, since none of its words is to be told in another language.
        names = ", ".join((*list(saved)[-MAX_LISTED:], *NAMES))
        raise EvaluationError((Problem("scenario_name", "must_be_one_of", choices=(names,)),))
    scenario = named_scenario(key)
    planners = action.planners or (scenario.planner or config.planner,)
    try:
        return evaluation_of_scenario(scenario, runs, planners, seed)
    except ConfigError as error:
        raise EvaluationError(error.problems) from error
    except (GenerationError, EditError) as error:
        raise EvaluationError((Problem("road", "has_no_way"),)) from error


def _config_under(action: Evaluate, spec: Evaluation) -> Config:
    """The configuration under the conditions that are said. Raises `ConfigError` or `EvaluationError`."""
    parts = {} if action.scenario is None else asdict(action.scenario)
    said = {name: (value,) for name, value in parts.items() if value is not None}
    allowed = VARIED if spec.world is None else SENSING
    if any(name not in allowed for name in said):
        raise EvaluationError((Problem("scenario", "must_be_a_list_of", choices=allowed),))
    cases = cases_of(said)
    return config_under(spec.config, cases[0]) if cases else spec.config
