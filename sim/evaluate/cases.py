"""The conditions under which an evaluation is run, where there are several: "in fog and in clear weather".

Every planner drives the same seeds under each of them, so that what the conditions do is seen.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any, Final

from sim.config import COUNTS, Config, Problem
from sim.session.scenario import TRAFFIC

MAX_CASES: Final = 24
"""Most conditions in one evaluation."""

SENSING: Final = ("weather", "time_of_day", "sensor")
"""What changes how a road is seen, and not the road: it varies on one road as well."""
VARIED: Final = (*SENSING, "traffic", *COUNTS.values())
"""What may be varied, in the order in which it is said."""


@dataclass(frozen=True)
class Case:
    """One of the conditions."""

    said: Mapping[str, Any]
    """what is different, by the names of `VARIED`"""
    parts: Mapping[str, Any]
    """the parts of the configuration that it sets"""

    def to_json(self) -> dict[str, Any]:
        """As JSON values."""
        return {"said": dict(self.said), "parts": dict(self.parts)}

    @staticmethod
    def from_json(values: Mapping[str, Any]) -> Case:
        """From JSON values."""
        return Case(dict(values["said"]), dict(values["parts"]))


def cases_of(vary: Mapping[str, Sequence[Any]]) -> tuple[Case, ...]:
    """A case for each combination of values; the first value of each is what the others are compared with.

    Values that are not valid are found where the configuration is made.
    """
    names = [name for name in VARIED if vary.get(name)]
    values = [list(dict.fromkeys(vary[name])) for name in names]
    if not names:
        return ()
    return tuple(
        Case(dict(zip(names, each, strict=True)), _parts(dict(zip(names, each, strict=True))))
        for each in product(*values)
    )


def _parts(said: Mapping[str, Any]) -> dict[str, Any]:
    parts = dict(said)
    if said.get("traffic") in TRAFFIC:
        parts |= {"spawn_probability": TRAFFIC[said["traffic"]], "vehicles": said.get("vehicles")}
    return parts


def problems_of(vary: Mapping[str, Sequence[Any]]) -> tuple[Problem, ...]:
    """What cannot be varied, or not that often."""
    if any(name not in VARIED for name in vary):
        return (Problem("vary", "must_be_a_list_of", choices=VARIED),)
    if len(cases_of(vary)) > MAX_CASES:
        return (Problem("conditions", "must_be_between", low=1, high=MAX_CASES),)
    return ()


def config_under(config: Config, case: Case) -> Config:
    """The configuration under a condition. Raises `ConfigError`."""
    return config.with_parts(**case.parts)
