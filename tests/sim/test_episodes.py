"""Episodes come out as the version before did, trace and all: a sample of `tools.episodes`."""

from __future__ import annotations

import pytest

from tools import episodes

CHEAP = ("layouts", "limit", "mixed", "changed", "by hand")
SEARCHING = ("mixed", "changed")
SAMPLE = [
    *(f"{planner} {family} 0" for planner in ("rules", "priority") for family in CHEAP),
    *(f"{planner} {family} 0" for planner in ("astar", "dijkstra", "exact") for family in SEARCHING),
    "priority first rules 0",
]


@pytest.mark.parametrize("group", SAMPLE)
def test_episodes_are_as_they_were(group: str) -> None:
    assert episodes.hashed(group)[1] == episodes.kept()[group], (
        f"`python -m tools.episodes --lines {group!r}` prints what differs from the version before"
    )


def test_all_groups_are_kept() -> None:
    assert len(episodes.groups()) * episodes.RUNS * episodes.EPISODES == 20_000
    assert [*episodes.kept()] == [*episodes.groups()]


def test_every_part_is_in_what_is_hashed() -> None:
    """Ends, moves that would meet something with an id, changes and refusals."""
    lines = "\n".join(episodes.lines_of("exact changed 0"))
    for part in (" success ", " stuck ", ":mover_enters:", ":vehicle-", "changed ", "refused ", "run 9 "):
        assert part in lines, part
