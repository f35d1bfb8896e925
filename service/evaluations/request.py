"""From an action to the evaluation that it asks for, on the road that it is asked of."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, replace
from typing import Any, Final

from service.actions import Evaluate, FindWorst
from service.evaluations.named import evaluation_of_name, first_seed, state_as_road
from sim.actions import Scenario
from sim.config import Config, ConfigError, Problem
from sim.evaluate.cases import cases_of, problems_of
from sim.evaluate.spec import Evaluation, EvaluationError
from sim.evaluate.success_map import cells_of, problems_of_map
from sim.falsify import Falsification
from sim.falsify.spec import MAX_WORLDS
from sim.planner_names import PROMISED
from sim.randomness import MAX_SEED
from sim.session.scenario import config_of_scenario, find_unavailable
from sim.state import SimState

RUNS: Final = 100
"""Episodes of each planner where no number is said."""
WORLDS: Final = 1_000
"""Worlds that are searched for failures where no number is said."""


_NO_MOMENTS: Final[Mapping[str, SimState]] = {}


def evaluation_of(
    action: Evaluate,
    config: Config,
    state: SimState | None = None,
    seed: int | None = None,
    saved: Mapping[str, SimState] = _NO_MOMENTS,
) -> Evaluation:
    """The evaluation that is asked for; checked, down to whether its road has a way to the goal.

    Its roads are drawn from a configuration, or from the scenario that is said; with `road` it is the one of
    `state`, from this moment on, and with `scenario_name` that of a scenario or of a moment in `saved`. The
    first seed is that of the configuration unless another is given, and of a scenario its own.
    Raises `EvaluationError`.
    """
    if missing := unavailable_part(action):
        raise EvaluationError((missing,))
    vary = _varied(action)
    if problems := problems_of(vary) if action.map is None else problems_of_map(action.map, vary):
        raise EvaluationError(problems)
    runs = RUNS if action.runs is None else action.runs
    if action.scenario_name is not None:
        spec = evaluation_of_name(action, runs, config, saved, seed)
    else:
        spec = _evaluation_of_roads(action, runs, config, state, seed)
    cases = cases_of(vary) if action.map is None else cells_of(action.map, vary, spec.config)
    spec = replace(spec, cases=cases, axes=action.map)
    spec.check_road()
    return spec


def _evaluation_of_roads(
    action: Evaluate, runs: int, config: Config, state: SimState | None, seed: int | None
) -> Evaluation:
    """Many episodes on roads that are drawn, or on that of the session, under no conditions."""
    config = _config_of(action, config)
    world = None
    if action.road is not None:
        if state is None:
            raise EvaluationError((Problem("road", "has_no_start"),))
        world = state_as_road(state)
    return Evaluation(
        planners=action.planners or (config.planner,),
        episodes=runs,
        config=config,
        seed=first_seed(config) if seed is None else seed,
        world=world,
    )


def _varied(action: Evaluate) -> dict[str, tuple[Any, ...]]:
    """The values that are compared, by setting."""
    values = {} if action.vary is None else asdict(action.vary)
    return {name: tuple(each) for name, each in values.items() if each is not None}


def falsification_of(action: FindWorst, config: Config, seed: int | None = None) -> Falsification:
    """The search for failures that is asked for; checked. `seed`: instead of that of the configuration.

    Raises `EvaluationError`.
    """
    if missing := unavailable_part(action):
        raise EvaluationError((missing,))
    first = config.seed if config.seed <= MAX_SEED - MAX_WORLDS else 0
    return Falsification(
        planner=action.planner or config.planner,
        worlds=WORLDS if action.runs is None else action.runs,
        config=config,
        seed=first if seed is None else seed,
    )


def unavailable_part(action: Evaluate | FindWorst) -> Problem | None:
    """The first thing that is asked for and that this version lacks."""
    if isinstance(action, FindWorst):
        missing = action.planner in PROMISED
        return Problem("planner", "planner_not_available", value=action.planner) if missing else None
    for planner in action.planners or ():
        if planner in PROMISED:
            return Problem("planners", "planner_not_available", value=planner)
    return None if action.scenario is None else find_unavailable(Scenario(**asdict(action.scenario)))


def _config_of(action: Evaluate, config: Config) -> Config:
    """The configuration that the roads are drawn from. Raises `EvaluationError`."""
    if action.scenario is None:
        return config
    scenario = Scenario(**asdict(action.scenario))
    try:
        made = config_of_scenario(config, scenario)
    except ConfigError as error:
        raise EvaluationError(error.problems) from error
    # Planners are named beside the scenario; without any, the one that drives is meant.
    return made if scenario.planner else made.with_parts(planner=config.planner)
