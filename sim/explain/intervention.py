"""Running one decision again with something otherwise, remembering what was run.

There are two kinds of intervention. One changes the percept: something is not detected, all else is
unchanged. The other changes the world: something was never there, or a person edits the road first; then
the sensor runs again with the same belief. With a perfect sensor both give the same result.

Of several egos this is about the one that decided. What the others announced to it stands where something
is not seen; on a road that is otherwise they decide anew. Another ego can be taken out of what is seen as a
thing can, but no change of the road takes it away.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import replace

from sim.actions import Add, Where, WorldAction
from sim.config import Config
from sim.decide import announced_before, decide_on, sense
from sim.explain.effort import WorkSpentError, prepare, work_of
from sim.explain.factors import factors, is_factor, removal, without
from sim.explain.facts import Counterfactual, QuestionError
from sim.explain.quick_moves import QuickMoves, SeenOtherwise
from sim.perceive import Percept, sensor_named
from sim.plan import Decision
from sim.session.edits import apply
from sim.state import SimState
from sim.types import Cell, Kind, Move, is_ego
from sim.world import Thing, World
from sim.world.grid import board_of


def wall(world: World, cell: Cell) -> Add:
    """The thing that blocks a cell: a barrier; where a mover stands, a pothole, which disables it there."""
    held = world.moving >> world.road.index(cell) & 1
    return Add(kind="pothole" if held else "barrier", count=1, where=Where(cell=cell))


class Intervention:
    """Reruns one decision with changes to the percept, the world or the preferences."""

    def __init__(
        self,
        state: SimState,
        decision: Decision,
        announced: Mapping[str, Move] | None = None,
        most: int | None = None,
    ) -> None:
        """A moment in which a decision is taken (not while a result stands), and that decision.

        `announced`: the moves that its ego knew of, where they are known already. `most`: the work after
        which whatever is asked raises `WorkSpentError`.
        """
        self.state = state
        self.decision = decision
        self.ego = decision.av
        prepare(state)
        announced = announced_before(state, self.ego) if announced is None else announced
        self.percept = sense(state, announced, self.ego)[0]
        """what was seen when it was taken"""
        self.faithful = not announced and sensor_named(state.config.sensor).faithful
        """whether not to be seen is the same as not to be there: for it and for who decides before it"""
        self.factors = factors(state.config_of(self.ego))
        self.quick: QuickMoves | None = None
        """what finds moves many at once, where that can be"""
        if self.faithful and QuickMoves.answers(state, decision, self.percept):
            self.quick = QuickMoves(state.config_of(self.ego), self.percept, decision)
        self.count = 0
        self._work, self._most = 0, most
        self._alone: dict[str, Move] = {}
        self._known: dict[tuple[str, frozenset[str]], Move] = {}

    def allow(self, work: int) -> None:
        """Allow so much work from here on."""
        if self._most is not None:
            self._most = self._work + work

    def tried_without(self, name: str) -> Move | None:
        """The move without this one alone, if that was tried."""
        return self._alone.get(name)

    def try_without_each(self, names: Iterable[str]) -> bool:
        """Take each of these away by itself, all at once; whether that could be done."""
        left = [name for name in names if name not in self._alone]
        if self.quick is None:
            return False
        try:
            self.spend(len(left))
        except WorkSpentError:
            return False
        self._alone.update(self.quick.without_each(left))
        return all(name in self._alone for name in left)

    def without(self, names: Iterable[str]) -> Move:
        """The move had these things not been detected, or these wishes never been said."""
        gone = frozenset(names)
        if len(gone) == 1:
            (name,) = gone
            if name not in self._alone:
                self._alone[name] = self._without(gone)
            return self._alone[name]
        key = ("without", gone)
        if key not in self._known:
            self._known[key] = self._without(gone)
        return self._known[key]

    def _without(self, gone: frozenset[str]) -> Move:
        otherwise = None if self.quick is None else self.quick.without(gone)
        if otherwise is None:
            return self.decision_without(gone).move
        (move,) = self.made_after([otherwise])
        return move

    def keeping(self, names: Iterable[str]) -> Move:
        """The move had nothing but these been detected."""
        key = ("keeping", frozenset(names))
        if key not in self._known:
            if self.quick is not None:
                (self._known[key],) = self.made_after([self.quick.keeping(key[1])])
                return self._known[key]
            gone = [name for name in self.factors if name not in key[1]]
            config = without(self.state.config, gone) if gone else self.state.config
            self._known[key] = self._decide(self._with(config), self.percept.keeping(_things(key[1]))).move
        return self._known[key]

    def decision_without(self, names: Iterable[str]) -> Decision:
        """The whole decision had these not been detected."""
        names = frozenset(names)
        state = self._with(without(self.state.config, names))
        return self._decide(state, self.percept.without(_things(names)))

    def never_there(self, names: Iterable[str]) -> Move:
        """The move had these never been there: neither on the road nor in what is seen or remembered."""
        if self.faithful:
            return self.without(names)
        key = ("never_there", frozenset(names))
        if key not in self._known:
            gone = _things(key[1])
            state = self._with(without(self.state.config, key[1]), self.state.world.without(gone))
            self._known[key] = self._decide(state, self._look(state, gone).without(gone)).move
        return self._known[key]

    def only_there(self, names: Iterable[str]) -> Move:
        """The move had nothing but these been there."""
        if self.faithful:
            return self.keeping(names)
        key = ("only_there", frozenset(names))
        if key not in self._known:
            kept = _things(key[1])
            gone = (name for name in self.factors if name not in key[1])
            state = self._with(without(self.state.config, gone), self.state.world.keeping(kept))
            others = {each for each in state.egos if each != self.ego and each not in kept}
            self._known[key] = self._decide(state, self._look(state, others).keeping(kept)).move
        return self._known[key]

    def after(self, change: Iterable[WorldAction], undetected: Iterable[str] = ()) -> Move:
        """The move had a person made this change first, and had these not been detected then.

        Raises `EditError` for a change that cannot be made, such as on a cell with something not seen.
        """
        state = self.state
        for action in change:
            state = apply(state, action).state
        gone = frozenset(undetected)
        percept = self._look(state, [name for name in gone if is_ego(name)])
        return self._decide(state, percept.without(gone) if gone else percept).move

    def behind_barriers(self, gone: Iterable[str], cells: Collection[int]) -> Move | None:
        """The move without these and with barriers in these cells, as `after` tells of the actions.

        None where it takes the actions to tell: where sensors err, and in cells that hold anything.
        """
        percept = self.percept
        if not self.faithful or any(
            cell == percept.ego or cell in percept.movers or cell in percept.hazards for cell in cells
        ):
            return None
        gone = frozenset(gone)
        otherwise = None if self.quick is None else self.quick.without(gone)
        if otherwise is not None:
            unlike = otherwise.unlike._replace(barriers=board_of(cells))
            return self.made_after([otherwise._replace(unlike=unlike)])[0]
        seen = percept.without(_things(gone)) if gone else percept
        barriers = seen.boards[Kind.BARRIER] | board_of(cells)
        seen = replace(
            seen,
            boards=seen.boards.with_kind(Kind.BARRIER, barriers),
            hazards={**seen.hazards, **dict.fromkeys(cells, Kind.BARRIER.value)},
        )
        return self._decide(self._with(without(self.state.config, gone)), seen).move

    def made_after(self, changes: Sequence[SeenOtherwise]) -> list[Move]:
        """The move after each of these changes of what is seen. Precondition: `quick`.

        Raises `WorkSpentError` where there is no work left for all of them.
        """
        assert self.quick is not None
        self.spend(len(changes))
        return self.quick.moves(changes)

    def spend(self, decisions: int) -> None:
        """Count so many decisions that are taken at once. Precondition: `quick`.

        Raises `WorkSpentError` where there is no work left for all of them.
        """
        assert self.quick is not None
        work = decisions * self.quick.work
        if self._most is not None and self._work + work > self._most + self.quick.work:
            raise WorkSpentError
        self._work += work
        self.count += decisions

    def counterfactual(self, names: Iterable[str], move: Move) -> Counterfactual:
        """The smallest intervention that removes these names and leads to `move`.

        It edits the road where that is enough. A phantom is not on the road, so it can only go undetected.
        """
        names = tuple(names)
        if self.faithful and not any(map(is_ego, names)):
            return Counterfactual(removal(names, self.state.config), move, names)
        things = [name for name in names if not is_factor(name)]
        phantoms = [name for name in things if not self._removable(name)]
        change = self.removal(names)
        for undetected in (phantoms, things):
            if self.after(change, undetected) is move:
                return Counterfactual(change, move, names, tuple(undetected))
        change = removal([name for name in names if is_factor(name)], self.state.config)
        return Counterfactual(change, move, names, tuple(things))

    def removal(self, names: Iterable[str]) -> tuple[WorldAction, ...]:
        """The actions that take these away, as far as they are there."""
        there = (name for name in names if is_factor(name) or self._removable(name))
        return removal(there, self.state.config)

    def phantoms(self, names: Iterable[str]) -> tuple[str, ...]:
        """Those of these things that no action takes away: what is not there, and other egos."""
        return tuple(name for name in names if not is_factor(name) and not self._removable(name))

    def _removable(self, name: str) -> bool:
        return not is_ego(name) and self.state.world.index_of(name) is not None

    def _look(self, state: SimState, gone: Iterable[str] = ()) -> Percept:
        """What the ego sees on another road, where the others decide anew without what is gone."""
        return sense(state, announced_before(state, self.ego, gone=frozenset(gone)), self.ego)[0]

    def seen(self, name: str) -> tuple[Thing, bool] | None:
        """A thing as it was seen, and whether it is real; an undetected thing, as it is in the world."""
        seen = self.percept.find(name)
        if self.faithful and seen is not None:
            return seen, True
        there = self.state.world.find(name)
        if seen is None:
            return None if there is None else (there, True)
        return seen, there is not None and (there.kind, there.cell) == (seen.kind, seen.cell)

    def _with(self, config: Config, world: World | None = None) -> SimState:
        state = self.state
        if world is None:
            return state if config is state.config else replace(state, config=config)
        return replace(state, world=world, config=config)

    def _decide(self, state: SimState, percept: Percept) -> Decision:
        if self._most is not None and self._work >= self._most:
            raise WorkSpentError
        self.count += 1
        decision = decide_on(state, percept, self.ego)
        self._work += work_of(decision, state.config_of(self.ego))
        if decision.timed_out:  # nothing is proved by an answer that did not come
            raise QuestionError("no_answer", planner=decision.planner, fault=decision.fault)
        return decision


def _things(names: Iterable[str]) -> frozenset[str]:
    return frozenset(name for name in names if not is_factor(name))
