"""Where things are that were put on the road or taken from it, and how many there are now.

Places are as people say them: lanes count from 1 at the left, and metres from the vehicle.
"""

from __future__ import annotations

from collections.abc import Sequence

from service.narration.sayings import Sayings
from sim.state import SimState
from sim.types import Cell, Kind
from sim.world import Thing

MOST_LANES = 3
"""How many lanes are listed of things added; more are all over the road."""


def place_of(sayings: Sayings, run: SimState, things: Sequence[Thing], verb: str) -> str:
    """Where things are, as it follows the `verb`: " in lane 4, 10 m ahead". Empty where all over the road."""
    lanes = sorted({thing.cell[0] + 1 for thing in things})
    rows = {thing.cell[1] for thing in things}
    if len(rows) == 1:
        away = _row(sayings, run, *rows)
        if len(lanes) == 1:
            return _say(sayings, verb, "lane_and_row", lane=lanes[0], away=away)
        if len(lanes) > MOST_LANES:
            return _say(sayings, verb, "row", away=away)
    if len(lanes) == 1:
        return _say(sayings, verb, "lane", lane=lanes[0])
    if len(lanes) <= MOST_LANES and verb == "add":
        return _say(sayings, verb, "lanes", lanes=sayings.joined([str(lane) for lane in lanes]))
    return ""


def spot_of(sayings: Sayings, run: SimState, cell: Cell) -> str:
    """A cell as seen from the vehicle: "lane 4, 10 m ahead"."""
    return sayings.say("replies", "spot", lane=cell[0] + 1, away=_row(sayings, run, cell[1]))


def _row(sayings: Sayings, run: SimState, row: int) -> str:
    """How far a row is from the vehicle along the road: "10 m ahead"."""
    along = run.world.avs[0] // run.world.road.columns - row
    side = "beside" if along == 0 else "ahead" if along > 0 else "behind"
    metres = sayings.number(abs(along) * run.config.cell_m)
    return sayings.say("replies", "away", side, metres=metres)


def how_many_now(sayings: Sayings, run: SimState, kinds: Sequence[Kind], *, left: bool) -> str:
    """How many there are of some kinds, or of everything where they are several: "there are 14 cars now".

    `left`: some were taken away.
    """
    counts = run.world.counts()
    count = counts[kinds[0]] if len(kinds) == 1 else sum(counts.values())
    noun = kinds[0] if len(kinds) == 1 else "everything"
    form = "one" if count == 1 else "many"
    if not count:
        form = "everything" if left and not any(counts.values()) and len(kinds) > 1 else "none"
    things = sayings.things(noun, max(count, 1) if count else 2)
    return sayings.say("replies", "left" if left else "now", form, count=count, things=things)


def _say(sayings: Sayings, verb: str, key: str, **parts: object) -> str:
    return sayings.say("replies", "places", verb, key, **parts)
