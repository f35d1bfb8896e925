"""Where an id lives: everywhere the same answer, evenly spread, and little moves when a shard is added."""

from __future__ import annotations

from collections import Counter

import pytest

from service.sharding import SINGLE, Shard, shard_of

IDS = [f"session-{number}" for number in range(4_000)]


def test_the_place_of_an_id_never_changes() -> None:
    """Fixed, since services of different versions have to agree on what is in one database."""
    assert [shard_of(each, 4) for each in ("a", "b", "c", "", "ä", "\udc80")] == [3, 2, 3, 0, 0, 1]


@pytest.mark.parametrize("shards", [2, 3, 8])
def test_ids_are_spread_evenly(shards: int) -> None:
    found = Counter(shard_of(each, shards) for each in IDS)
    even = len(IDS) / shards
    assert set(found) == set(range(shards))
    assert all(0.85 * even < count < 1.15 * even for count in found.values())


def test_one_shard_more_takes_ids_and_moves_no_others() -> None:
    moved = [(shard_of(each, 4), shard_of(each, 5)) for each in IDS]
    assert {after for before, after in moved if before != after} == {4}


@pytest.mark.parametrize("number", range(3))
def test_a_shard_draws_ids_of_its_own(number: int) -> None:
    shard = Shard(number, 3)
    drawn = [shard.new_id() for _ in range(20)]
    assert len(set(drawn)) == 20
    assert {shard_of(each, 3) for each in drawn} == {number}


def test_one_process_has_everything() -> None:
    assert all(SINGLE.owns(each) for each in IDS[:10])


def test_limits_are_divided_and_never_nothing() -> None:
    assert [Shard(0, 4).share(amount) for amount in (20, 21, 1)] == [5, 6, 1]
