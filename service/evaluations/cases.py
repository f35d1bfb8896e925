"""Cases of a search for failures, made ready for its report: in words, and with a link that opens them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict
from typing import Any, Final

from service.narration.case import CaseWords
from service.narration.sayings import Sayings
from service.sessions.persistence.link import pack_recording
from service.sessions.persistence.recording import FORMAT, VERSION
from sim.evaluate.executor import CancelledError
from sim.falsify import Case
from sim.falsify.world import drive
from sim.state import SimState
from sim.types import kind_of

ENTRY: Final = 50
"""Things that one entry of a recording takes away."""


def explain_cases(result: dict[str, Any], language: str, cancelled: Callable[[], bool]) -> dict[str, Any]:
    """The result of a search with each case in words, and with a link that opens it in the page."""
    try:
        words = CaseWords(Sayings.load(language))
    except FileNotFoundError:
        words = CaseWords(Sayings.load())
    for each in result["cases"]:
        if cancelled():
            raise CancelledError
        case = Case.from_json(each["case"])
        each["case"]["why"] = words.why(case, each)
        each["link"] = case_link(case, case.tick)
    return result


def case_link(case: Case, tick: int) -> str | None:
    """A link that opens the case at a tick; None where its road is drawn otherwise by now.

    It carries a recording: the road that the configuration draws, and what is taken off it.
    """
    start = SimState.start(case.config)
    kept = set(case.things)
    gone = [
        name for name in (*start.world.movers.values(), *start.world.hazards.values()) if name not in kept
    ]
    if start.world.without(gone).digest() != case.world.digest():
        return None
    shown = drive(case.start)[tick].world
    actions = [
        {"do": "remove", "kind": kind_of(name).value, "count": 1, "where": {"id": name}} for name in gone
    ]
    chunks = [actions[first : first + ENTRY] for first in range(0, len(actions), ENTRY)]
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
