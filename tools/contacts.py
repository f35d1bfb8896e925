"""Every way to meet in a tick: which moves of the vehicle and of something near it make their boxes touch.

    python -m tools.contacts                    the table, as text
    python -m tools.contacts --figure <png>     each kind of contact, drawn at the moment it happens
    python -m tools.contacts --write            tests/web/bodies.json, which the page's tests read

The cases are all there are: six moves of the vehicle, and things of each kind within two cells, which stay
or (movers) step sideways. The rule of collisions in cells is this table put into words (`Case.words`).
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from pathlib import Path as FilePath
from typing import Any, Final

from sim.render.motion import poses
from sim.rules.collision_geometry import SIZES, Path, first_contact
from sim.types import HAZARDS, MOVERS, Cell, Kind, Move, Outcome
from sim.world import World
from sim.world.boards import BOARDED, NO_BOARDS, Boards
from tests.support.roads import numbered, road

TABLE: Final = FilePath(__file__).parents[1] / "tests" / "web" / "bodies.json"
PHASES: Final = (0.4, 1.0)
"""Shares of a tick's time at which the page's poses are compared with these."""
MIDDLE: Final[Cell] = (4, 4)
REACH: Final = 2


@dataclass(frozen=True, slots=True)
class Case:
    """A move of the vehicle and a thing near it."""

    move: Move
    kind: Kind
    offset: Cell
    """of the thing's cell from the vehicle's at the beginning of the tick"""
    step: int
    """the thing's, −1 to the left, 1 to the right"""

    @property
    def thing(self) -> Path:
        """The thing's way, the vehicle starting in (0, 0)."""
        return Path(self.kind, self.offset, (self.offset[0] + self.step, self.offset[1]))

    @property
    def contact(self) -> Fraction | None:
        """When the boxes first touch."""
        return first_contact(Path(Kind.AV, (0, 0), self.move.offset), self.thing)

    @property
    def words(self) -> str | None:
        """What the rule in cells says of the case; None where it says nothing."""
        across, along = self.move.offset
        end = self.thing.end
        if end == self.move.offset:
            return "same cell"
        if end == (0, 0) and self.offset == self.move.offset:
            return "swap"
        if across and along and self.step == -across and end in ((0, 0), (0, along)):
            return "met on the diagonal, from behind" if end == (0, 0) else "met on the diagonal, ahead"
        return None


def cases() -> Iterator[Case]:
    """All of them; nothing begins the tick in the vehicle's own cell."""
    near = range(-REACH, REACH + 1)
    for kind in (*MOVERS, *HAZARDS):
        for move in Move:
            for along in near:
                for across in near:
                    if (across, along) != (0, 0):
                        for step in (-1, 0, 1) if kind.moves else (0,):
                            yield Case(move, kind, (across, along), step)


def worlds(case: Case) -> tuple[World, World]:
    """A road before and after the tick of a case, judged by its boxes."""
    side = 2 * MIDDLE[0] + 1
    column, row = MIDDLE[0] + case.offset[0], MIDDLE[1] + case.offset[1]

    def at(av: Cell, thing: Cell) -> World:
        index = thing[1] * side + thing[0]
        av_index = av[1] * side + av[0]
        bare = replace(road(*(["." * side] * (side - 1)), "A" + "." * (side - 1)), avs=(av_index,))
        board = 1 << index
        boards = Boards.of({case.kind: board}) if case.kind in BOARDED else NO_BOARDS
        left = board if case.kind.moves and case.step < 0 else 0
        right = board & ~left if case.kind.moves else 0
        return replace(bare, left=left, right=right, boards=boards)

    before = at(MIDDLE, (column, row))
    end = (MIDDLE[0] + case.move.offset[0], MIDDLE[1] + case.move.offset[1])
    after = replace(at(end, (column + case.step, row)), tick=1)
    if case.contact is not None:
        after = replace(after, outcome=Outcome.CRASH, ended=1)
    return numbered(before), numbered(after)


def document() -> dict[str, Any]:
    """What the page's tests are compared with: sizes, and the poses that the window draws.

    A case is its kind, move, offset, step and, for each phase, where the vehicle's and the thing's centres
    are seen, from the cell the vehicle started in.
    """
    listed = []
    kinds = (Kind.AV, *MOVERS, *reversed(HAZARDS))
    for case in cases():
        before, after = worlds(case)
        places = []
        for phase in PHASES:
            seen = poses(before, after, phase)
            for pose in (seen.av, *seen.things):
                places += [round(pose.column - MIDDLE[0], 9), round(pose.row - MIDDLE[1], 9)]
        listed.append([case.kind, case.move, *case.offset, case.step, places])
    return {
        "sizes": {kind: [float(side) for side in SIZES[kind]] for kind in kinds},
        "phases": PHASES,
        "cases": listed,
    }


def written() -> str:
    """The document as the file holds it, one case a line."""
    whole = document()
    lines = ",\n".join(json.dumps(each, separators=(",", ":")) for each in whole.pop("cases"))
    head = json.dumps(whole, separators=(",", ":"))
    return f'{head[:-1]},"cases":[\n{lines}\n]}}\n'


def table() -> str:
    """The contacts as text, and the least room that is left where there is none."""
    lines = [f"{'move':<14} {'thing':<11} {'from':>8} {'to':>8}  {'touch at':<10} by the rule"]
    touching = 0
    for case in cases():
        if case.contact is None and case.words is None:
            continue
        touching += 1
        when = "never" if case.contact is None else f"{float(case.contact):.4f}"
        start, end = (f"{across:+d},{along:+d}" for across, along in (case.offset, case.thing.end))
        lines.append(
            f"{case.move:<14} {case.kind:<11} {start:>8} {end:>8}  {when:<10} {case.words or 'NOT COUNTED'}"
        )
    count = sum(1 for _ in cases())
    lines.append(
        f"\n{count} cases, {touching} contacts; cells are told as columns, rows from the vehicle's own."
    )
    return "\n".join(lines)


def main(arguments: list[str]) -> None:
    """What was asked for."""
    match arguments:
        case []:
            print(table())
        case ["--write"]:
            TABLE.write_text(written(), encoding="utf-8")
            print(f"{TABLE.name}: {TABLE.stat().st_size / 1000:.0f} kB")
        case ["--figure", path]:
            from tools.contacts_figure import figure

            figure(FilePath(path))
        case _:
            raise SystemExit(__doc__)


if __name__ == "__main__":
    main(sys.argv[1:])
