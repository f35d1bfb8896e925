"""From a scenario to the state that it begins with, and to many episodes of it."""

from __future__ import annotations

from service.scenarios.file import ScenarioFile
from sim.config import Problem
from sim.evaluate import Evaluation, EvaluationError
from sim.session.edits import apply
from sim.state import SimState
from sim.world.notation import write


def first_state(scenario: ScenarioFile) -> SimState:
    """The scenario at tick 0, its rules standing. Raises `ConfigError`, `GenerationError` or `EditError`."""
    state = SimState.start(scenario.to_config())
    for action in (*scenario.setup, *scenario.rules):
        state = apply(state, action).state
    return state


def evaluation_of_scenario(
    scenario: ScenarioFile, runs: int, planners: tuple[str, ...] = (), seed: int | None = None
) -> Evaluation:
    """Many episodes of a scenario: all on its road, or each on one of its own where it has no seed.

    What is left to chance differs between the runs. Raises `EvaluationError`, `ConfigError`,
    `GenerationError` or `EditError`.
    """
    config = scenario.to_config()
    state = None if scenario.seed is None else first_state(_without_rules(scenario))
    spec = Evaluation(
        planners=planners or (config.planner,),
        episodes=runs,
        config=config if state is None else state.config,
        seed=(scenario.seed or 0) if seed is None else seed,
        world=None if state is None else write(state.world),
        rules=tuple(scenario.rules),
        scenario_name=scenario.name,
    )
    try:
        spec.check_road()
    except EvaluationError as error:
        raise EvaluationError(tuple(_named(each) for each in error.problems)) from error
    return spec


def _without_rules(scenario: ScenarioFile) -> ScenarioFile:
    return scenario.model_copy(update={"rules": []})


def _named(problem: Problem) -> Problem:
    return Problem("road" if problem.field == "world" else problem.field, problem.code, **problem.facts)
