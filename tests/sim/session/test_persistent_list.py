"""A chain is a list that nobody can change, whoever else goes on from the same beginning."""

from __future__ import annotations

from threading import Thread

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sim.session.persistent_list import PersistentList

MOVES = st.lists(
    st.tuples(st.integers(0, 30), st.one_of(st.integers(0, 6), st.lists(st.integers(), max_size=3))),
    max_size=20,
)


@given(MOVES)
def test_many_chains_of_one_beginning_are_as_many_lists(moves: list[tuple[int, int | list[int]]]) -> None:
    chains, lists = [PersistentList([1, 2, 3])], [[1, 2, 3]]
    for which, move in moves:
        place = which % len(chains)
        if isinstance(move, int):
            chains.append(chains[place].first(move))
            lists.append(lists[place][:move])
        else:
            chains.append(chains[place].plus(move))
            lists.append(lists[place] + move)
        for chain, items in zip(chains, lists, strict=True):
            assert (list(chain), len(chain)) == (items, len(items))
            assert chain.after(2) == items[2:]
            assert list(chain[1:]) == items[1:]
            assert list(reversed(chain)) == items[::-1]


@given(st.lists(st.integers(0, 1), max_size=5), st.lists(st.integers(0, 1), max_size=5), st.integers(0, 5))
def test_what_two_have_in_common(one: list[int], other: list[int], shared: int) -> None:
    base = PersistentList([7] * shared)
    first, second = base.plus(one), base.plus(other)
    alike = first.common_prefix_length(second)
    assert list(first)[:alike] == list(second)[:alike]
    assert alike in (len(first), len(second)) or first[alike] != second[alike]
    assert (first == second) == (one == other)


def test_a_place_that_is_not_there() -> None:
    chain = PersistentList([1, 2, 3]).first(2)
    assert (chain[-1], chain[1]) == (2, 2)
    for place in (2, -3):
        with pytest.raises(IndexError):
            chain[place]
    assert chain != (1, 2, 3)
    assert chain != 5


def test_two_threads_go_two_ways() -> None:
    base: PersistentList[int] = PersistentList([0])
    grown: dict[int, PersistentList[int]] = {}

    def grow(mark: int) -> None:
        chain = base
        for _ in range(2000):
            chain = chain.plus([mark])
        grown[mark] = chain

    threads = [Thread(target=grow, args=(mark,)) for mark in (1, 2, 3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert {mark: set(chain.after(1)) for mark, chain in grown.items()} == {1: {1}, 2: {2}, 3: {3}}
