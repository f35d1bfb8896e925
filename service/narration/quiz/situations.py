"""The situations of a quiz: roads on which a planner decides, with the moves and reasons to choose from."""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final, Literal

from service.narration.explanation import Explained
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from sim.config import Config
from sim.explain import Explanation, why
from sim.explain.factors import is_factor
from sim.session.timeline import Timeline
from sim.types import MOVES, Move, Outcome
from sim.world.notation import write

Phase = Literal["before", "explained", "after"]
PHASES: Final[tuple[Phase, ...]] = ("before", "explained", "after")
MOST: Final = 12
"""Situations of one phase at most."""
NOTHING: Final = "nothing"
"""The reason of a move that nothing was in the way of."""

_COLUMNS, _ROWS, _TICKS = 5, 12, 8
_AHEAD, _BEHIND = 5, 1
"""Rows shown before and behind the vehicle."""
_WRONG_REASONS = 2
_DRAWS = 60
"""Roads drawn for each situation at most, until one has a move that is wanted."""


@dataclass(frozen=True, slots=True)
class Reason:
    """One reason to choose: a thing on the road, or nothing."""

    id: str
    text: str


@dataclass(frozen=True, slots=True)
class Situation:
    """One decision to predict, or to read the explanation of."""

    phase: Phase
    picture: tuple[str, ...]
    """rows of the road around the vehicle, in the signs of `sim.world.notation`"""
    reasons: tuple[Reason, ...]
    move: Move
    """what it did"""
    reason: str
    """the id of the right reason"""
    explanation: str


def situations(seed: int, planner: str, count: int, sayings: Sayings) -> tuple[Situation, ...]:
    """The situations of a quiz, `count` in each phase; the same for the same arguments.

    Before and after have the same moves as far as they can be found, so that one is as hard as the other.
    """
    if not 1 <= count <= MOST:
        raise ValueError(f"a phase has 1 to {MOST} situations")
    draw = random.Random(f"{seed} {planner}")
    drawn = _decisions(draw, planner)
    tested = sorted(_varied(drawn, 2 * count), key=lambda each: MOVES.index(each.decision.move))
    shown = _varied(drawn, count)
    by_phase = {"before": tested[::2], "explained": shown, "after": tested[1::2]}
    found: list[Situation] = []
    for phase in PHASES:
        draw.shuffle(by_phase[phase])
        found += (_situation(phase, each, sayings, draw) for each in by_phase[phase])
    return tuple(found)


def _decisions(draw: random.Random, planner: str) -> Iterator[Explanation]:
    """Explanations of decisions on roads drawn one after the other."""
    while True:
        config = Config(
            seed=draw.randrange(2**32),
            columns=_COLUMNS,
            rows=_ROWS,
            potholes=draw.choice([4, 8]),
            vehicles=draw.choice([3, 6, 9]),
            pedestrians=draw.choice([0, 1]),
            barriers=draw.choice([1, 3]),
            planner=planner,
        )
        timeline = Timeline(config)
        for _ in range(draw.randrange(1, _TICKS)):
            timeline.advance()
        before = timeline.at(timeline.tick - 1)
        if timeline.decision(timeline.tick - 1) is not None and before.world.outcome is Outcome.RUNNING:
            yield why(timeline)


def _varied(drawn: Iterator[Explanation], count: int) -> list[Explanation]:
    """Some decisions, of each move no more than a third and one if others can be found."""
    most = count // 3 + 1
    had: Counter[Move] = Counter()
    found: list[Explanation] = []
    for tried, each in enumerate(drawn):
        left = count * _DRAWS - tried
        if had[each.decision.move] < most or left <= 0:
            had[each.decision.move] += 1
            found.append(each)
        if len(found) == count:
            break
    return found


def _situation(phase: Phase, explanation: Explanation, sayings: Sayings, draw: random.Random) -> Situation:
    naming = Naming(sayings, explanation.moment, ego=explanation.decision.av)
    right, wrong = _reasons(explanation)
    named = [right, *wrong, *([] if right == NOTHING else [NOTHING])]
    draw.shuffle(named)
    return Situation(
        phase=phase,
        picture=_picture(explanation),
        reasons=tuple(
            Reason(each, sayings.say("quiz", NOTHING) if each == NOTHING else naming.thing(each))
            for each in named
        ),
        move=explanation.decision.move,
        reason=right,
        explanation=Explained(sayings).text(explanation, now=explanation.decision.tick + 1),
    )


def _reasons(explanation: Explanation) -> tuple[str, list[str]]:
    """The first cause that is a thing, or `NOTHING`; and the nearest things that are no causes at all."""
    causes = [cause.id for cause in explanation.causes if not is_factor(cause.id)]
    parts = {name for each in (*explanation.causes, *explanation.also) for name in (each.id, *each.group)}
    parts |= {*explanation.untried, *(link.blocker for link in explanation.chain)}
    parts |= {name for option in explanation.decision.options for name in option.causes}
    world = explanation.moment.world
    column, row = world.road.cell(world.av)
    others = [
        thing
        for thing in world.things()
        if thing.id not in parts and row - _AHEAD <= thing.cell[1] <= row + _BEHIND
    ]
    others.sort(key=lambda each: (abs(each.cell[0] - column) + abs(each.cell[1] - row), each.id))
    return causes[0] if causes else NOTHING, [each.id for each in others[:_WRONG_REASONS]]


def _picture(explanation: Explanation) -> tuple[str, ...]:
    world = explanation.moment.world
    rows = write(world).splitlines()[1 : world.road.rows + 1]
    own = world.road.cell(world.av)[1]
    return tuple(rows[max(0, own - _AHEAD) : own + _BEHIND + 1])
