"""Whether what explanations claim is so: by editing the road and letting it run, nothing else."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import combinations

from sim.actions import Drive, Prefer, Remove, Set, SetMode, Where, WorldAction
from sim.config import Config
from sim.explain import Explanation
from sim.session.edits import apply
from sim.state import SimState
from sim.transition import step
from sim.types import Mode, Move, Outcome, kind_of

MOST_PARTS = 3
"""Causes of which every part is tried."""


def move_after(state: SimState, change: Iterable[WorldAction]) -> Move:
    """The move a run makes after a person has made these changes."""
    for action in change:
        state = apply(state, action).state
    decision = step(state).decision
    assert decision is not None
    return decision.move


def taking(names: Iterable[str], config: Config) -> list[WorldAction]:
    """What a person does to take these away: things, wishes, settings."""
    gone = set(names)
    actions: list[WorldAction] = [
        Remove(kind=kind_of(name).value, count=1, where=Where(id=name)) for name in gone if ":" not in name
    ]
    if any(name.startswith("preference:") for name in gone):
        kept = [wish for wish in config.preferences if f"preference:{wish}" not in gone]
        actions += [Prefer(preference="balanced"), *(Prefer(preference=wish) for wish in kept)]
    if "setting:safety_buffer" in gone:
        actions.append(Set(parameter="safety_buffer", value=Config().safety_buffer))
    return actions


def keeping(names: Iterable[str], state: SimState) -> list[WorldAction]:
    """What a person does to leave nothing but these."""
    kept = set(names)
    kinds = {kind_of(name) for name in kept if ":" not in name}
    gone = sorted({thing.kind for thing in state.world.things()} - kinds)
    actions: list[WorldAction] = [Remove(kind=kind.value, count="all") for kind in gone]
    others = [thing.id for thing in state.world.things() if thing.kind in kinds and thing.id not in kept]
    wishes = [f"preference:{wish}" for wish in state.config.preferences]
    factors = [*wishes, "setting:safety_buffer"]
    return [*actions, *taking([*others, *(name for name in factors if name not in kept)], state.config)]


def wrong_claims(explanation: Explanation, *, parts: bool) -> Iterator[str]:
    """Every claim of a why that is not so; `parts`: whether the parts of its causes are tried as well."""
    state, fact = explanation.moment, explanation.decision.move
    causes = [cause.id for cause in explanation.causes]
    for cause in explanation.causes:
        if cause.group and move_after(state, taking(cause.group, state.config)) is fact:
            yield f"without {cause.group} it stays {fact}"
        alone = move_after(state, taking([cause.id], state.config)) is not fact
        if alone is not cause.necessary:
            yield f"{cause.id} is {'' if alone else 'not '}necessary"
        if cause.each_enough and any(
            move_after(state, keeping([name], state)) is not fact for name in cause.group
        ):
            yield f"not each of {cause.group} is enough"
    for flip in explanation.counterfactuals:
        if move_after(state, flip.change) is not flip.move:
            yield f"after {flip.change} it is not {flip.move}"
    sufficient = explanation.verified.sufficient
    if sufficient is not None and sufficient is not (move_after(state, keeping(causes, state)) is fact):
        yield f"{causes} are not enough"
    if parts and explanation.verified.minimal and len(causes) <= MOST_PARTS:
        for size in range(len(causes)):
            for part in combinations(causes, size):
                if move_after(state, keeping(part, state)) is fact:
                    yield f"{part} would have been enough"


def played(state: SimState, move: Move) -> tuple[Outcome, int] | None:
    """How an episode ends when a person makes one move and then lets go; None if the move is held back."""
    mode = state.mode
    for action in (SetMode(mode=Mode.MANUAL), Drive(move=move)):
        state = apply(state, action).state
    tick = step(state)
    if tick.decision is None or tick.decision.held_back:
        return None
    state = tick.state
    if state.world.outcome is Outcome.RUNNING:
        state = apply(state, SetMode(mode=mode)).state
    while state.world.outcome is Outcome.RUNNING:
        state = step(state).state
    return state.world.outcome, state.world.episode_tick
