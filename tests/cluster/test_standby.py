"""Which process becomes a shard."""

from __future__ import annotations

import asyncio
from collections import Counter

import pytest

from service.cluster.standby import Standby, processes_of_node


async def of(nodes: list[str], first: int | None = None) -> Standby:
    standby = Standby(len(nodes) if first is None else first)
    for process, node in enumerate(nodes):
        await standby.add(process, node)
    return standby


async def test_shards_are_spread_over_the_nodes_though_one_is_ready_first() -> None:
    nodes = ["a", "a", "a", "b", "b", "b"]
    standby = await of(nodes)
    taken = [await standby.take() for _ in range(4)]
    assert Counter(nodes[each] for each in taken) == {"a": 2, "b": 2}


async def test_none_is_taken_before_all_were_ready_once() -> None:
    standby = await of(["a"], first=2)
    waiting = asyncio.create_task(standby.take())
    await asyncio.sleep(0)
    assert not waiting.done()
    await standby.add(1, "b")
    assert await waiting in (0, 1)


async def test_the_reserve_of_a_node_where_a_shard_died_is_the_last_choice() -> None:
    nodes = ["a", "a", "b", "b"]
    standby = await of(nodes)
    first, second = await standby.take(), await standby.take()
    assert {nodes[first], nodes[second]} == {"a", "b"}
    standby.leave(second)
    assert nodes[await standby.take()] == nodes[first], "the other one may be dead with its node"
    await standby.add(second, nodes[second])
    assert nodes[await standby.take()] == nodes[second]


@pytest.mark.parametrize("nodes", range(2, 8))
@pytest.mark.parametrize("workers", range(1, 20))
def test_when_any_one_node_dies_the_others_have_processes_for_all_shards(workers: int, nodes: int) -> None:
    assert (nodes - 1) * processes_of_node(workers, nodes) >= workers
