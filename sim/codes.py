"""Codes of everything that is refused, with the names of the facts that come with each.

`sim` refuses in codes and facts; sentences for people are made elsewhere, one for each code. A new code is
added here first: an error with a code or a fact that is not listed cannot be made.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, Final

PROBLEMS: Final[Mapping[str, tuple[str, ...]]] = MappingProxyType(
    {
        "must_be_a_number": (),
        "must_be_a_whole_number": (),
        "must_be_between": ("low", "high"),
        "must_be_one_of": ("choices",),
        "must_be": ("choice",),
        "not_available_one_of": ("choices", "value"),
        "not_available_must_be": ("choice", "value"),
        "must_be_a_list_of": ("choices",),
        "must_be_true_or_false": (),
        "must_not_be_counted": ("layout",),
        "not_a_setting": (),
        "not_a_setting_but_near": ("near",),
        "too_many": ("room",),
        "no_drivable_road": ("draws",),
        "is_given_to_reset": (),
        "planner_not_available": ("value",),
        "second_vehicle_not_available": (),
        "has_no_way": (),
        "has_no_start": (),
        "must_stay_on_the_road": (),
        "cannot_be_done": (),
        "is_that_of_the_scenario": (),
    }
)
"""Codes of a `sim.config.Problem`. Those that end in `_not_available` are of scenarios; `has_no_way`,
`has_no_start` and `is_that_of_the_scenario` are of the road of an evaluation, `must_stay_on_the_road` and
`cannot_be_done` of its rules."""

EDITS: Final[Mapping[str, tuple[str, tuple[str, ...]]]] = MappingProxyType(
    {
        "too_many_moves": ("too-many", ("most",)),
        "id_is_no_place": ("bad-place", ()),
        "no_such_lane": ("outside-road", ("lane", "lanes")),
        "no_such_row": ("outside-road", ("row", "last_row")),
        "cell_off_road": ("outside-road", ("column", "row", "last_column", "last_row")),
        "too_far": ("outside-road", ("left", "side", "away")),
        "no_room": ("does-not-fit", ("count", "kind", "free", "place")),
        "too_many_for_scenario": ("does-not-fit", ("amount", "setting", "problem")),
        "no_new_road": ("does-not-fit", ("problem",)),
        "occupied": ("occupied", ("column", "row", "id")),
        "row_is_taken": ("occupied", ("lane", "row", "id", "kind", "free_row")),
        "none_there": ("none-there", ("kind", "place")),
        "no_such_thing": ("none-there", ("id",)),
        "no_such_ego": ("none-there", ("id",)),
        "of_another_kind": ("none-there", ("id", "kind")),
        "road_is_gone": ("none-there", ()),
        "same_thing": ("bad-place", ("id",)),
        "same_kind": ("bad-place", ("kind",)),
        "each_is_for_new_things": ("bad-place", ()),
        "would_fall_off": ("does-not-fit", ("lost", "setting")),
        "too_few": ("too-few", ("count", "kind", "place")),
        "other_vehicles_not_available": ("not-available", ()),
        "scenario_not_available": ("not-available", ("problem",)),
        "setting_not_available": ("not-available", ("setting",)),
        "no_such_traffic": ("out-of-range", ("choices",)),
        "value_refused": ("out-of-range", ("setting", "problem", "now")),
        "no_more_or_less": ("out-of-range", ("setting",)),
        "at_its_limit": ("out-of-range", ("setting", "now")),
        "traffic_by_steps_only": ("out-of-range", ("choices",)),
        "goal_not_found": ("does-not-fit", ("tried", "driven")),
        "goal_no_way": ("does-not-fit", ()),
        "goal_after_end": ("none-there", ()),
        "goal_among_egos": ("not-available", ()),
        "goal_same_planner": ("out-of-range", ()),
        "too_many_triggers": ("too-many", ("most",)),
        "no_such_trigger": ("none-there", ("number",)),
        "no_triggers": ("none-there", ()),
        "no_trigger_does": ("none-there", ()),
        "crowded": ("does-not-fit", ("percent",)),
    }
)
"""Codes of a `sim.session.errors.EditError`: the category of each, and its facts.

`place` is `there`, `road` or `between_start_and_goal`; `kind` is a `Kind` or `everything`; `problem` is a
`sim.config.Problem`.
"""

ADVICE: Final[Mapping[str, tuple[str, ...]]] = MappingProxyType(
    {
        "distance_out_of_range": ("low", "high", "value"),
        "speed_out_of_range": ("low", "high", "value"),
    }
)
"""Codes of a `sim.hazard_advice.NoAdviceError`; distances in metres, speeds in km/h."""


def check_facts(code: str, facts: Mapping[str, Any], expected: tuple[str, ...] | None) -> None:
    """Raises `ValueError` for a code that is not listed, or for other facts than are listed with it."""
    if expected is None:
        raise ValueError(f"the code {code!r} is not listed in sim.codes")
    if set(facts) != set(expected):
        raise ValueError(f"{code} comes with {sorted(expected)}, not with {sorted(facts)}")


def plain_text(code: str, facts: Mapping[str, Any]) -> str:
    """A code and its facts on one line for developers: `must be between (low=3, high=64)`."""
    told = ", ".join(f"{name}={value}" for name, value in facts.items())
    return f"{code.replace('_', ' ')} ({told})" if told else code.replace("_", " ")
