"""The result of a search: how often the planner failed, at random and directed, and the cases."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any, Final

from sim.evaluate.failures import failure_pattern
from sim.falsify.case import Case, replay
from sim.falsify.space import KINDS_SEARCHED, LAYOUTS
from sim.falsify.spec import Falsification
from sim.falsify.stages import CASES, Parts, SearchPiece, pieces, unpack
from sim.falsify.world import Finding, Looked, drive
from sim.planner_names import BUILT_IN
from sim.statistics import wilson
from sim.types import Outcome

VERSION: Final = 1
"""Of the form of a result."""


def summarize(spec: Falsification, parts: Parts) -> dict[str, Any]:
    """The result as JSON values. Raises `ValueError` unless every piece is there."""
    if pieces(spec, parts):
        raise ValueError("pieces of the search are missing")
    generations = [
        [each for stretch in cut for each in unpack(parts[SearchPiece(stretch, None).key])]
        for cut in spec.stretches()
    ]
    seen = [each for generation in generations for each in generation]
    random = generations[0] if spec.directed else seen
    directed = seen[len(random) :]
    counts = {finding.value: sum(each.finding is finding for each in seen) for finding in Finding}
    found = [json.loads(parts[f"case:{number}"]) for number in range(CASES)]
    cases, given_up = _cases(spec, found)
    return {
        "version": VERSION,
        "planner": spec.planner,
        "worlds": spec.worlds,
        "findings": counts,
        "random": _share(random),
        "directed": _share(directed) if directed else None,
        "generations": [_generation(generation) for generation in generations],
        "cases": cases,
        "given_up": given_up,
        "hardest": None if cases else _hardest(found),
    }


def _share(looked: Sequence[Looked]) -> dict[str, Any]:
    """How many worlds the planner failed, with the 95 % interval of the share (Wilson)."""
    failed = sum(each.finding.failed for each in looked)
    low, high = wilson(failed, len(looked))
    return {"count": failed, "of": len(looked), "share": failed / len(looked), "low": low, "high": high}


def _generation(looked: Sequence[Looked]) -> dict[str, Any]:
    """What a generation was like: its failures, and the mean levels of its worlds."""
    count = len(looked)
    levels = {
        kind.value: round(sum(each.point.levels[place] for each in looked) / count, 4)
        for place, kind in enumerate(KINDS_SEARCHED)
    }
    layouts = {
        str(layout): number
        for place, layout in enumerate(LAYOUTS)
        if (number := sum(each.point.layout == place for each in looked))
    }
    return {"failed": _share(looked), "levels": levels, "layouts": layouts}


def _cases(
    spec: Falsification, found: Sequence[Mapping[str, Any] | None]
) -> tuple[list[dict[str, Any]], int]:
    """Cases with how they fail, each world once, and how many failures no 1-minimal world was found for."""
    cases: dict[str, dict[str, Any]] = {}
    given_up = 0
    for each in found:
        if each is None or "case" not in each:
            continue
        if each["case"] is None:
            given_up += 1
            continue
        case = Case.from_json(each["case"])
        if case.world.digest() in cases:
            continue
        states = drive(case.start)
        pattern, thing = failure_pattern(states[-1], list(states[-1].ego().record.move_list()))
        cases[case.world.digest()] = {
            "index": each["index"],
            "seed": case.config.seed,
            "outcome": case.outcome.value,
            "ticks": case.ticks,
            "tick": case.tick,
            "least": len(case.way),
            "things": list(case.things),
            "things_before": each["things"],
            "pattern": pattern,
            "thing": thing,
            "arrive": [
                name
                for name in BUILT_IN
                if name != spec.planner and replay(case, name).outcome is Outcome.SUCCESS
            ],
            "case": each["case"],
        }
    return sorted(cases.values(), key=lambda each: (len(each["things"]), each["index"])), given_up


def _hardest(found: Sequence[Mapping[str, Any] | None]) -> dict[str, Any] | None:
    """Of the arrivals that took longest the one that lost most against the quickest way."""
    slow = [dict(each) for each in found if each is not None and each.get("least") is not None]
    return max(slow, key=lambda each: (each["ticks"] - each["least"], -each["index"]), default=None)
