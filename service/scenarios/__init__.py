"""Scenario files: a road, what is put on it, the rules that stand on it, and why it is kept."""

from service.scenarios.file import FORMAT, VERSION, Flaw, ScenarioError, ScenarioFile, read_scenario
from service.scenarios.library import NAMES, named_scenario

__all__ = [
    "FORMAT",
    "NAMES",
    "VERSION",
    "Flaw",
    "ScenarioError",
    "ScenarioFile",
    "named_scenario",
    "read_scenario",
]
