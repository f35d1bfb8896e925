"""From a scenario to a recording of its beginning, which the page opens."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from service.actions import dump
from service.scenarios.evaluation import first_state
from service.scenarios.file import ScenarioFile
from service.sessions.persistence.link import pack_recording
from service.sessions.persistence.recording import FORMAT, VERSION


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
