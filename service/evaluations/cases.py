"""Cases of a search for failures, made ready for its report: in words, and with a link that opens them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict
from typing import Any, Final

from service.actions import dump
from service.narration.case import CaseWords
from service.narration.sayings import Sayings
from service.sessions.persistence.link import pack_recording
from service.sessions.persistence.recording import FORMAT, VERSION
from sim.actions import Remove, Where
from sim.evaluate.executor import CancelledError
from sim.falsify import Case
from sim.falsify.world import drive
from sim.session.saved_config import new_config
from sim.state import SimState
from sim.types import PLACEABLE, kind_of

ENTRY: Final = 50
"""Actions of one entry of a recording."""
REASON: Final = 1_000
"""Characters of the reason of a scenario file."""


def explain_cases(result: dict[str, Any], language: str, cancelled: Callable[[], bool]) -> dict[str, Any]:
    """The result of a search with each case in words, as a scenario file, and with a link that opens it."""
    try:
        words = CaseWords(Sayings.load(language))
    except FileNotFoundError:
        words = CaseWords(Sayings.load())
    for each in result["cases"]:
        if cancelled():
            raise CancelledError
        case = Case.from_json(each["case"])
        each["case"]["why"] = words.why(case, each)
        told = Case.from_json(each["case"])
        each["link"] = case_link(told, case.tick)
        each["scenario"] = case_scenario(told)
    return result


def case_link(case: Case, tick: int) -> str | None:
    """A link that opens the case at a tick; None where its road is drawn otherwise by now.

    It carries a recording: the road that the configuration draws, and what is taken off it.
    """
    gone = removals(case)
    if gone is None:
        return None
    shown = drive(case.start)[tick].world
    chunks = [dump(tuple(gone[first : first + ENTRY])) for first in range(0, len(gone), ENTRY)]
    recording = {
        "format": FORMAT,
        "version": VERSION,
        "rules": case.config.rules,
        "name": case.name,
        "config": asdict(case.config),
        "entries": [
            {"sequence": number, "tick": 0, "text": None, "actions": chunk}
            for number, chunk in enumerate(chunks, 1)
        ],
        "tick": tick,
        "digest": shown.digest(),
    }
    return pack_recording(recording)


def case_scenario(case: Case) -> dict[str, Any] | None:
    """The case as a scenario file of its name, as JSON values; None where such a file cannot hold it."""
    from service.scenarios.evaluation import first_state
    from service.scenarios.file import FORMAT as SCENARIO
    from service.scenarios.file import VERSION as SCENARIO_VERSION
    from service.scenarios.file import ScenarioFile

    gone = removals(case)
    if gone is None:
        return None
    usual = asdict(new_config({}))
    differing = {name: value for name, value in asdict(case.config).items() if value != usual[name]}
    parts = {name: value for name, value in differing.items() if name not in ("seed", "planner")}
    values = {
        "format": SCENARIO,
        "version": SCENARIO_VERSION,
        "name": case.name.replace("_", "-"),
        "reason": case.why[:REASON] or case.name,
        "config": {name: list(value) if isinstance(value, tuple) else value for name, value in parts.items()},
        "seed": case.config.seed,
        "planner": case.config.planner,
        "setup": dump(tuple(gone)),
    }
    try:
        found = ScenarioFile.model_validate(values)
    except ValueError:
        return None  # too many things to take away, or a planner of another package
    same = first_state(found).world.digest() == case.world.digest()
    return found.to_values() if same else None


def removals(case: Case) -> list[Remove] | None:
    """What is taken off the road that the case's configuration draws; None where that is another road."""
    start = SimState.start(case.config).world
    kept = set(case.things)
    gone = [name for name in (*start.movers.values(), *start.hazards.values()) if name not in kept]
    if start.without(gone).digest() != case.world.digest():
        return None
    bare = {kind for kind in PLACEABLE if not any(kind_of(name) is kind for name in kept)}
    whole = [kind for kind in PLACEABLE if kind in bare and start.count(kind)]
    actions = [Remove(kind=kind.value, count="all") for kind in whole]
    for name in gone:
        if kind_of(name) not in bare:
            kind = kind_of(name).value
            actions.append(Remove(kind=kind, count=1, where=Where(id=name)))  # type: ignore[arg-type]
    return actions
