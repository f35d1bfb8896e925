"""Names of what the kernel shows."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from sim.perceive.kernel.places import TRIPLE
from sim.perceive.look import NUMBER
from sim.types import Kind, phantom_id

_KINDS: Final = tuple(NUMBER)


class Namer:
    """Names of what is believed to be there: `sim.perceive.grid_sensor` says by which rule."""

    def __init__(self, shown: list[int], reports: int, names: list[str], phantoms: int) -> None:
        """`reports`: where the reports begin in `shown`."""
        self.phantoms = phantoms
        self._shown = shown
        self._reports = reports
        self._names = names

    def named(self, first: int, last: int, known: Mapping[int, str]) -> dict[int, str]:
        """The ids of what is shown from `first` to `last`, by cell. `known`: of what was believed before."""
        shown, names = self._shown, self._names
        cells, things = shown[first:last:TRIPLE], shown[first + 2 : last : TRIPLE]
        if -1 not in things:
            return {cell: names[thing] for cell, thing in zip(cells, things, strict=True)}
        found = [names[thing] if thing >= 0 else "" for thing in things]
        used, reported = set(found), self._reported()
        for place, cell in enumerate(cells):
            if not found[place]:
                kind = shown[first + TRIPLE * place + 1]
                found[place] = self._name_of(
                    _KINDS[kind], (known.get(cell), reported.get((kind, cell))), used
                )
                used.add(found[place])
        return dict(zip(cells, found, strict=True))

    def _name_of(self, kind: Kind, candidates: tuple[str | None, ...], used: set[str]) -> str:
        for name in candidates:
            if name is not None and name not in used and name.startswith(f"{kind}-"):
                return name
        self.phantoms += 1
        return phantom_id(kind, self.phantoms)

    def _reported(self) -> dict[tuple[int, int], str]:
        """The ids of what was detected, by kind and the cell of the report."""
        rest = self._shown[self._reports :]
        return {
            (kind, cell): self._names[thing]
            for kind, cell, thing in zip(rest[::TRIPLE], rest[1::TRIPLE], rest[2::TRIPLE], strict=True)
            if thing >= 0
        }
