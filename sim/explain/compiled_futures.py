"""Futures by compiled words, once they are loaded: the ends that `sim.explain.futures` finds, much faster.

A leaf, so that nothing is loaded before an explanation wants it (`sim.explain.effort.prepare`).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from sim.config import Config
from sim.plan import traits_of
from sim.search.compiled_rows import BY_COST, BY_RANK, rows_are_compiled_for
from sim.search.costs import TICKS_ALONE, Weights, weights
from sim.state import SimState
from sim.transition import repeats_for_ever
from sim.types import Mode

if TYPE_CHECKING:
    from sim.batch.row_words import DrivenTicks, FoundEnds


def ticks_are_compiled_for(state: SimState, ego: str | None = None) -> bool:
    """Whether the ticks of a run are known in compiled words, and these are loaded.

    An ego that a person drives counts as one that drives by itself. That a run ends where it repeats itself
    (`Config.repetition`) is not known in words.
    """
    return (
        rows_are_compiled_for(state.world, state.config)
        and state.config_of(ego).planner in (*BY_RANK, *BY_COST)
        and not state.ego(ego).queue
    )


def futures_are_compiled_for(state: SimState, ego: str | None = None) -> bool:
    """Whether the futures of an ego can be found in compiled words, and these are loaded.

    An ego that a person drives counts as one that drives by itself.
    """
    if not ticks_are_compiled_for(state, ego):
        return False
    config = state.config_of(ego)
    return not (config.repetition and repeats_for_ever(config, config.planner))


def compiled_futures(
    state: SimState, most: int, quick_until: int, most_futures: int, *, seen: bool
) -> FoundEnds:
    """The ends of the futures of the only ego. Precondition: `futures_are_compiled_for`.

    `most`: decisions that are allowed; `quick_until`: decisions of a quick planner before which it is not
    looked whether the goal is out of reach; `seen`: whether it is known who reacts in the coming tick.
    """
    from sim.batch.row_words import futures_of

    config = state.config_of()
    known = None
    if seen:
        reactions = config.mover_behaviour.reactions(state.world, config)
        known = reactions.yielding, reactions.attentive
    until = quick_until if traits_of(config.planner).quick else 0
    return futures_of(state, config.planner, _charges(config), known, until, most, most_futures)


def drive_is_compiled_for(state: SimState, ego: str | None = None) -> bool:
    """Whether a run can be driven on in compiled words, and these are loaded."""
    return futures_are_compiled_for(state, ego) and state.ego(ego).mode is Mode.AUTO


def compiled_drive(state: SimState, most: int | None = None) -> DrivenTicks:
    """The ticks of a run up to before the one that ends its episode, at most so many.

    Of the ego itself the state after them holds no more than before them. Precondition:
    `drive_is_compiled_for`; the ticks up to a repetition that ends a run need `ticks_are_compiled_for` alone.
    """
    from sim.batch.row_words import drive_on

    config = state.config_of()
    left = config.max_ticks + 1 - state.world.episode_tick
    return drive_on(state, config.planner, _charges(config), left if most is None else min(most, left))


def _charges(config: Config) -> Weights:
    """What a planner goes by, if it goes by cost."""
    return weights(config) if traits_of(config.planner).weighs_costs else TICKS_ALONE
