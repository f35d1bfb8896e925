"""Turns of the loop: pieces of work that come together are spread over several."""

from __future__ import annotations

import asyncio

import pytest

from service.work import turn
from service.work.turn import TurnBudget


async def turns_of(pieces: int) -> list[int]:
    """The turn of the loop in which each of some pieces of work was done."""
    budget, done, now = TurnBudget(), [], 0

    async def piece() -> None:
        async with budget.piece():
            done.append(now)

    tasks = [asyncio.create_task(piece()) for _ in range(pieces)]
    while not all(task.done() for task in tasks):
        await asyncio.sleep(0)
        now += 1
    return done


async def test_pieces_that_use_up_a_turn_get_one_each(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(turn, "TURN_S", 0.0)
    done = await turns_of(5)
    assert len(set(done)) == 5
    assert done == sorted(done)


async def test_quick_pieces_share_a_turn(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(turn, "TURN_S", 600.0)
    assert len(set(await turns_of(5))) == 1


async def test_a_piece_that_fails_is_counted_and_lets_others_on(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(turn, "TURN_S", 0.0)
    budget = TurnBudget()
    with pytest.raises(ValueError, match="no"):
        async with budget.piece():
            raise ValueError("no")
    async with asyncio.timeout(10), budget.piece():
        pass
