"""From a scenario to how it begins: as a state, as a recording that the page opens, and as an evaluation."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from service.actions import dump
from service.scenarios.file import ScenarioFile
from service.sessions.persistence.link import pack_recording
from service.sessions.persistence.recording import FORMAT, VERSION
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


def recording_of(scenario: ScenarioFile) -> dict[str, Any]:
    """A recording that begins as the scenario does. Raises as `first_state` does."""
    state = first_state(scenario)
    actions = dump((*scenario.setup, *scenario.rules))
    entry = {"sequence": 1, "tick": 0, "text": None, "actions": actions}
    return {
        "format": FORMAT,
        "version": VERSION,
        "rules": state.config.rules,
        "name": scenario.name,
        "config": asdict(scenario.to_config()),
        "entries": [entry] if actions else [],
        "tick": 0,
        "digest": state.world.digest(),
    }


def scenario_link(scenario: ScenarioFile) -> str:
    """A link that opens the scenario in the page of any service."""
    return pack_recording(recording_of(scenario))


def evaluation_of_scenario(
    scenario: ScenarioFile, runs: int, planners: tuple[str, ...] = (), seed: int | None = None
) -> Evaluation:
    """Many episodes of a scenario: all on its road, or each on one of its own where it has no seed.

    What is left to chance differs between the runs. Raises `EvaluationError`, `ConfigError`,
    `GenerationError` or `EditError`.
    """
    config = scenario.to_config()
    state = None if scenario.seed is None else first_state(replace_rules(scenario))
    spec = Evaluation(
        planners=planners or (config.planner,),
        episodes=runs,
        config=config if state is None else state.config,
        seed=(scenario.seed or 0) if seed is None else seed,
        world=None if state is None else write(state.world),
        rules=tuple(scenario.rules),
    )
    try:
        spec.check_road()
    except EvaluationError as error:
        raise EvaluationError(tuple(_named(each) for each in error.problems)) from error
    return spec


def replace_rules(scenario: ScenarioFile) -> ScenarioFile:
    """The scenario without its rules."""
    return scenario.model_copy(update={"rules": []})


def _named(problem: Problem) -> Problem:
    return Problem("road" if problem.field == "world" else problem.field, problem.code, **problem.facts)
