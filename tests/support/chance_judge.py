"""Whether the chances that sentences state are so: futures are drawn anew, by other seeds, and counted."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from math import sqrt

from sim.explain.chances import Chances
from sim.state import FIRST, SimState
from sim.transition import step, transition
from sim.types import Move, Outcome

DRAWS = 40
"""Futures that are drawn to hold a stated chance to."""
FURTHEST = 4.5
"""Standard deviations by which a share may be off: once in 150,000 by chance."""


def judge_stated(
    state: SimState, move: Move | None, stated: Chances | None, text: str
) -> Iterator[tuple[str, str | None]]:
    """Whether a stated chance of arriving is told, and is that of futures drawn anew.

    `move`: the one made first; None for what the ego makes of it, with who reacts in the coming tick seen.
    """
    if stated is None or stated.settled or not re.search(r"%|of \d+ futures", text):
        return
    after = _after(state, move)
    arrived = sum(_arrives(after, seed) for seed in range(DRAWS))
    yield "5 chance off", _off(stated, arrived, text)


def _off(stated: Chances, arrived: int, text: str) -> str | None:
    """What is false about a chance, or None."""
    share = arrived / DRAWS
    drawn = stated.futures or 0
    mean = (stated.arrives * drawn + arrived + 1) / (drawn + DRAWS + 2) if drawn else stated.arrives
    spread = sqrt(max(mean * (1 - mean), 0.25 / DRAWS) * (1 / DRAWS + (1 / drawn if drawn else 0)))
    if abs(share - stated.arrives) <= FURTHEST * spread:
        return None
    return f"{arrived} of {DRAWS} arrive, {stated.arrives:.3f} is stated: {text}"


def hangs_on_chance(state: SimState, draws: int, move: Move | None = None) -> bool:
    """Whether different draws of who gives way after the coming tick lead to different ends.

    Who reacts in the coming tick is drawn already and seen: it is not drawn anew. `move`: the one made in it;
    None for what the ego makes of it.
    """
    if state.config.certain or state.world.outcome is not Outcome.RUNNING:
        return False
    after = _after(state, move)
    return len({_end(after, seed) for seed in range(draws)}) > 1


def _after(state: SimState, move: Move | None) -> SimState:
    return step(state).state if move is None else transition(state, {FIRST: move}).state


def _arrives(state: SimState, seed: int) -> bool:
    return _end(state, 1_000 + seed)[0] is Outcome.SUCCESS


def _end(state: SimState, seed: int) -> tuple[Outcome, int]:
    drawn = replace(state, config=state.config.with_parts(seed=state.config.seed + seed))
    while drawn.world.outcome is Outcome.RUNNING:
        drawn = step(drawn).state
    return drawn.world.outcome, drawn.world.tick
