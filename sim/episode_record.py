"""The record of an episode so far: its first world, every move, and the reason of each detour.

The record is part of the state, so the end of an episode is summarized without running it again, and undo,
fork and replay keep it right. The reason of a detour is the thing that the ego would have met straight ahead.
It is read from the worlds before and after the move, not from what the planner says.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Final

from sim.fast_replace import fast_constructor
from sim.types import MOVES, Kind, Move, kind_of
from sim.world import World

_SIGNS: Final = {move: str(place) for place, move in enumerate(MOVES)}


class DetourReason(StrEnum):
    """Why the ego did not go straight on, where no thing stood there."""

    YOU = "you"
    """a person asked for the move, or drives by hand and asked for none"""
    PLANNER = "planner"
    """the planner gave no valid answer, and the ego stayed"""
    BETTER = "better"
    """straight on was free, and the planner preferred another move"""


Sake = Kind | DetourReason
"""For whose sake a detour is made: that of a kind of thing, or another reason."""
_REASONS: Final = frozenset(DetourReason)


@dataclass(frozen=True, slots=True)
class EpisodeRecord:
    """The record of an episode so far (immutable)."""

    start: World | None = None
    """the world in which the first move was made; None before it"""
    edits: int = 0
    """number of edits of the session at the latest move"""
    changed: bool = False
    """whether the road was edited after the first move"""
    certain: bool = True
    """whether no random draw decided who gives way"""
    moves: str = ""
    """every move, as the digit of its place in `Move`"""
    sakes: tuple[tuple[Sake, int], ...] = ()
    """number of moves that were not straight on per reason, in the order of their first occurrence"""
    last: World | None = None
    """the world before the move that ended the episode"""

    @property
    def waits(self) -> int:
        """The number of moves with a reason in which the ego stood."""
        aside = sum(move not in (Move.FORWARD, Move.STAY) for move in self.move_list())
        return sum(count for _, count in self.sakes) - aside

    def after(
        self,
        before: World,
        after: World,
        move: Move,
        edits: int,
        certain: bool,
        by_person: bool,
        faulty: bool,
        ended: bool,
        number: int = 0,
    ) -> EpisodeRecord:
        """Returns the record with one more move of ego `number`, which leads from `before` to `after`.

        To stay after it has arrived is no detour.
        """
        sakes = self.sakes
        if move is not Move.FORWARD and (len(before.avs) == 1 or before.avs[number] >= before.road.columns):
            reason, _ = detour_reason(before, after, by_person=by_person, faulty=faulty, number=number)
            sakes = _count_reason(sakes, reason)
        return _extend(
            before if self.start is None else self.start,
            edits,
            self.changed or (self.start is not None and edits != self.edits),
            self.certain and certain,
            self.moves + _SIGNS[move],
            sakes,
            before if ended else None,
        )

    def move_list(self) -> tuple[Move, ...]:
        """Lists every move, in order."""
        return tuple(MOVES[int(sign)] for sign in self.moves)


_extend = fast_constructor(EpisodeRecord, "start", "edits", "changed", "certain", "moves", "sakes", "last")


def sake_of(word: str) -> Sake:
    """Returns the reason that is written as this word. Raises `ValueError`."""
    return DetourReason(word) if word in _REASONS else Kind(word)


def detour_reason(
    before: World, after: World, *, by_person: bool, faulty: bool, number: int = 0
) -> tuple[Sake, tuple[str, ...]]:
    """Returns why a move of ego `number` was not straight on, and the ids of what it would have met there."""
    if by_person or faulty:
        return (DetourReason.YOU if by_person else DetourReason.PLANNER), ()
    ahead = before.avs[number] - before.road.columns
    met = tuple(table[ahead] for table in (before.hazards, after.movers) if ahead in table)
    return (kind_of(met[0]), met) if met else (DetourReason.BETTER, ())


def _count_reason(sakes: tuple[tuple[Sake, int], ...], one: Sake) -> tuple[tuple[Sake, int], ...]:
    for place, (other, count) in enumerate(sakes):
        if other is one:
            return (*sakes[:place], (one, count + 1), *sakes[place + 1 :])
    return (*sakes, (one, 1))
