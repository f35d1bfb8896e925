"""What a planner decided in a tick: with its whole trace, or in the few words of a tick message."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from service.contract import notebook_html as html
from service.contract.model import Answered, Cell, DocumentedAs, Model, MoveName, Page, Tick

Weight = Annotated[int, DocumentedAs(Literal[0, 1, 2])]


@dataclass(frozen=True, slots=True)
class Option(Model):
    """One move as the planner saw it."""

    move: MoveName
    cell: Cell | None
    verdict: Annotated[str, DocumentedAs(Literal["free", "blocked", "off_road"])]
    cost: float | None
    reason: str
    causes: tuple[str, ...]
    text: str = ""
    """What spoke for or against it, in a few words."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Decision(Answered):
    """What was decided in the world of a tick; it leads to the next."""

    tick: Tick
    planner: str
    move: MoveName
    asked: MoveName | None
    """The move that a person driving asked for."""
    options: tuple[Option, ...]
    narration: str
    weight: Weight
    """How much there is to say: 0 nothing was in the way, 1 a detour, 2 a wait or worse."""

    def _repr_html_(self) -> str:
        """Every move and what spoke for or against it, for notebooks."""
        rows = [(option.move, option.verdict, option.cost, option.reason) for option in self.options]
        return html.table(self.narration, ("move", "verdict", "cost", "reason"), rows)


@dataclass(frozen=True, slots=True)
class DecisionPage(Page[Decision]):
    """Decisions, oldest first. Ticks at which a result stood have none."""

    items: tuple[Decision, ...]
    after: int
    """Send as `after` for what follows."""
    more: bool


@dataclass(frozen=True, slots=True)
class BlockedMove(Model):
    """A move that could not be made, and why."""

    move: MoveName
    reason: str
    causes: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class BriefDecision(Answered):
    """A decision as a tick message tells it: of its options, only the blocked ones."""

    tick: Tick
    planner: str
    move: MoveName
    reason: str
    """Why the preferred move was made, or what kept the ego from it."""
    causes: tuple[str, ...]
    """Ids of the things behind `reason`."""
    weight: Weight
    """How much there is to say: 0 nothing was in the way, 1 a detour, 2 a wait or worse."""
    blocked: tuple[BlockedMove, ...]
