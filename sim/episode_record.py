"""What an episode has come to so far: its beginning, every move, and for whose sake each detour was made.

Kept along with the run, so that an end can be summed up without driving the episode again, and so that
undoing, forking and replaying need no care. Whose sake is read off the worlds before and after, not off
a planner's own account: it is whoever would have been met straight ahead.
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
    """a person asked for it, or drives and asked for nothing"""
    PLANNER = "planner"
    """the planner did not answer, and the vehicle stayed"""
    BETTER = "better"
    """straight on was free, and the planner held something else to be better"""


Sake = Kind | DetourReason
"""For whose sake a detour is made: that of a kind of thing, or another reason."""
_REASONS: Final = frozenset(DetourReason)


@dataclass(frozen=True, slots=True)
class EpisodeRecord:
    """An episode so far. A value, never changed."""

    start: World | None = None
    """the world in which the first move was made; None before that"""
    edits: int = 0
    """changes the session had seen when the course was last in step with the road"""
    changed: bool = False
    """whether a person changed the road meanwhile"""
    certain: bool = True
    """whether nothing was left to who gives way"""
    moves: str = ""
    """every move, as its place in `Move`"""
    sakes: tuple[tuple[Sake, int], ...] = ()
    """how many detours were made for whose sake, in the order they first came"""
    last: World | None = None
    """the world before the move that ended the episode"""

    @property
    def detours(self) -> int:
        """Moves that were not straight on."""
        return sum(count for _, count in self.sakes)

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
        """With one more move made by ego `number`. To stay after it has arrived is no detour."""
        sakes = self.sakes
        if move is not Move.FORWARD and (len(before.avs) == 1 or before.avs[number] >= before.road.columns):
            reason, _ = sake(before, after, by_person=by_person, faulty=faulty, number=number)
            sakes = _counted(sakes, reason)
        return _gone_on(
            before if self.start is None else self.start,
            edits,
            self.changed or (self.start is not None and edits != self.edits),
            self.certain and certain,
            self.moves + _SIGNS[move],
            sakes,
            before if ended else None,
        )

    def made(self) -> tuple[Move, ...]:
        """Every move, in order."""
        return tuple(MOVES[int(sign)] for sign in self.moves)


_gone_on = fast_constructor(EpisodeRecord, "start", "edits", "changed", "certain", "moves", "sakes", "last")


def sake_of(word: str) -> Sake:
    """The sake that was written as this word. Raises `ValueError`."""
    return DetourReason(word) if word in _REASONS else Kind(word)


def sake(
    before: World, after: World, *, by_person: bool, faulty: bool, number: int = 0
) -> tuple[Sake, tuple[str, ...]]:
    """For whose sake a move of ego `number` was not straight on, and who would have been met there."""
    if by_person or faulty:
        return (DetourReason.YOU if by_person else DetourReason.PLANNER), ()
    ahead = before.avs[number] - before.road.columns
    met = tuple(table[ahead] for table in (before.hazards, after.movers) if ahead in table)
    return (kind_of(met[0]), met) if met else (DetourReason.BETTER, ())


def _counted(sakes: tuple[tuple[Sake, int], ...], one: Sake) -> tuple[tuple[Sake, int], ...]:
    for place, (other, count) in enumerate(sakes):
        if other is one:
            return (*sakes[:place], (one, count + 1), *sakes[place + 1 :])
    return (*sakes, (one, 1))
