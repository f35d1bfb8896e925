"""Time that can be walked: a configuration and the actions with the tick at which each took effect.

That list *is* the session; every state is derived from it by replay, and snapshots along the way
only save time. An undo rewrites the log without the change.
Snapshots are spaced by replay work, so that no state is expensive to reach. Replay from a snapshot uses
the recorded moves (`sim.session.move_log`), so each tick is decided only once.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections import deque
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from sim.actions import WorldAction
from sim.config import Config
from sim.decide import announced_before, decide_each, sense
from sim.events import Event, EventType
from sim.perceive import sensor_named
from sim.plan import Decision, traits_of
from sim.plan.safe_planning import failed_decision, is_foreign, recorded_decision
from sim.session.edits import Applied, apply
from sim.session.move_log import MoveLog
from sim.session.packed_state import PackedState, pack
from sim.session.persistent_list import PersistentList
from sim.session.triggers import fire
from sim.state import FIRST, EgoStep, SimState, StepResult
from sim.transition import step
from sim.types import Move

SNAPSHOT_TICKS = 128
"""Work between two snapshots, in replayed ticks. It doubles whenever `MAX_SNAPSHOTS` is exceeded."""

MAX_SNAPSHOTS = 512
"""Of less than a kilobyte each, packed. A fork of a log of 50,000 ticks is to take 10 ms."""

ACTION_WORK = 4
"""Work of one logged action, in replayed ticks (equal to ticks of the simplest planner)."""

THINGS_AN_ACTION = 10
"""Number of things on the road that adds one replayed tick to the work of an action."""

LOOK_WORK = 8
"""Work of a look whose belief is needed later, in replayed ticks: a replay has to look again."""

ROAD_WORK, ROAD_CELLS = 4, 80
"""Work of generating a road in replayed ticks, and the number of cells that adds one more."""

_DRAWN = frozenset((EventType.EPISODE_STARTED, EventType.ROAD_KEPT))

UNPACKED = 2
"""The latest snapshots stay as they are: most of what is asked for is near the present."""

RECENT_RUNS = 8
"""States kept as they were, for questions about what has just been done."""

RECENT_CHANGES = 4
"""Number of states kept from before the latest edits, so that an undo replays only the ticks since then."""


class PlannerSilentError(Exception):
    """A planner from another package did not answer in time."""

    def __init__(self, planner: str, fault: str) -> None:
        super().__init__(f"{planner}: {fault}")
        self.planner = planner
        self.fault = fault


@dataclass(frozen=True, slots=True)
class Entry:
    """One action of the log. Entries of one `sequence` were said together."""

    sequence: int
    tick: int
    action: WorldAction


class Snapshot:
    """A state on the way: at a tick, once the first `entries` of the log were applied."""

    __slots__ = ("_kept", "entries", "tick")

    def __init__(self, tick: int, state: SimState, entries: int) -> None:
        self.tick = tick
        self.entries = entries
        self._kept: SimState | PackedState = state

    @property
    def state(self) -> SimState:
        """The state; of a packed snapshot a new object each time."""
        kept = self._kept
        return kept.unpack() if isinstance(kept, PackedState) else kept

    def pack(self) -> None:
        """Keep the state in fewer bytes, for all timelines that share this snapshot."""
        kept = self._kept
        if not isinstance(kept, PackedState):
            self._kept = pack(kept)


class Timeline:
    """A session's log and its present state. `copy()` is cheap: states and the log are values and shared."""

    def __init__(self, config: Config, state: SimState | None = None) -> None:
        """A session at tick 0; `state`: what it begins with, if not with a road generated for one ego.

        Raises `ValueError` for a state of another tick.
        """
        self.config = config
        self.state = SimState.start(config) if state is None else state
        if self.tick:
            raise ValueError(f"a session begins at tick 0, not at tick {self.tick}")
        self.entries: PersistentList[Entry] = PersistentList()
        self._gap = SNAPSHOT_TICKS
        self._work = 0
        self.worked = 0
        """all the work that was done on it, in ticks of the simplest planner: about what a replay takes"""
        self._snapshots: tuple[Snapshot, ...] = (Snapshot(0, self.state, 0),)
        self._recent: deque[SimState] = deque(maxlen=RECENT_RUNS)
        self._before: tuple[Snapshot, ...] = ()
        """before the latest changes"""
        self._track = MoveLog(egos=len(self.state.egos))

    @classmethod
    def made(
        cls,
        config: Config,
        state: SimState,
        entries: PersistentList[Entry],
        snapshots: Sequence[Snapshot],
        gap: int,
        work: int,
        worked: int,
        moves: Sequence[bytes],
    ) -> Timeline:
        """A timeline of the parts of another: see `parts`. Raises `ValueError` where moves are missing."""
        new = cls.__new__(cls)
        new.config, new.state, new.entries = config, state, entries
        new._snapshots, new._gap, new._work, new.worked = tuple(snapshots), gap, work, worked
        for shot in new._snapshots[:-UNPACKED]:
            shot.pack()
        new._recent = deque(maxlen=RECENT_RUNS)
        new._before = ()
        new._track = MoveLog(moves, len(state.egos))
        if len(new._track) != new.tick:
            raise ValueError(f"{len(new._track)} moves lead to tick {new.tick}")
        return new

    def parts(
        self,
    ) -> tuple[
        Config, SimState, PersistentList[Entry], tuple[Snapshot, ...], int, int, int, tuple[bytes, ...]
    ]:
        """All parts except the cached recent states."""
        shots, moves = self._snapshots, self._track.blocks
        return self.config, self.state, self.entries, shots, self._gap, self._work, self.worked, moves

    @property
    def tick(self) -> int:
        """The present tick."""
        return self.state.world.tick

    def copy(self) -> Timeline:
        """A timeline that goes its own way from here."""
        twin = Timeline.__new__(Timeline)
        twin.config = self.config
        twin.state = self.state
        twin.entries = self.entries
        twin._gap = self._gap
        twin._work = self._work
        twin.worked = self.worked
        twin._snapshots = self._snapshots
        twin._recent = self._recent.copy()
        twin._before = self._before
        twin._track = self._track.copy()
        return twin

    def advance(self, decided: Decision | Mapping[str, Decision] | None = None) -> StepResult:
        """One tick on, with what was `decided` for it elsewhere, if it was; of several egos by id.

        Raises `PlannerSilentError`; nothing has then changed. A planner that did not answer in time may
        answer when the tick is run again, so a tick without its answer must not become part of what is
        replayed.
        """
        if isinstance(decided, Decision):
            decided = {decided.av: decided}
        tick = _answered(step(self.state) if decided is None else step(self.state, decided))
        tick = _with_rules(self.state, tick)
        self._recent.append(self.state)
        self._went_on(tick, len(self.entries))
        return tick

    def apply(self, sequence: int, actions: Sequence[WorldAction]) -> list[Applied]:
        """Change the world at the present tick; all of the actions or, on `EditError`, none."""
        state, done, work = self.state, [], 0
        for action in actions:
            applied = apply(state, action)
            state = applied.state
            done.append(applied)
            work += _action_work(applied)
        before = Snapshot(self.tick, self.state, len(self.entries))
        self._before = (*self._before[1 - RECENT_CHANGES :], before)
        self.state = state
        self.entries = self.entries.plus([Entry(sequence, self.tick, action) for action in actions])
        self._worked(ACTION_WORK * len(actions), work, len(self.entries))
        return done

    def rewrite(self, entries: Sequence[Entry], since: int) -> None:
        """Make `entries` the log, as if nothing else had ever been said, and replay to the present tick.

        The new log may differ from the old one from tick `since` on; only the ticks from there on are decided
        again. Raises `PlannerSilentError`; the timeline is then invalid and must be discarded.
        """
        present = self.tick
        self._recent.clear()
        self._forget_from(entries, since)
        self.entries = entries if isinstance(entries, PersistentList) else PersistentList(entries)
        self.state, position = self._nearest(since)
        self._track.cut(since)
        self._work = 0
        while True:
            due = position
            self.state, position, work = self._apply_due(self.state, position)
            self._worked(ACTION_WORK * (position - due), work, position)
            if self.tick == present:
                return
            if self.tick < since:
                self.state = _after_rules(self.state, self._track.after(self.state))
                self._worked(1, 1, position)
            else:
                self._went_on(_with_rules(self.state, _answered(step(self.state))), position)

    def rewind(self, tick: int) -> None:
        """Make a past tick the present; what was said or happened after it is gone. Raises `IndexError`."""
        state = self.at(tick)
        if tick == self.tick:
            return
        self.worked += self.work_to(tick)
        self.state = state
        self.entries = self.entries.first(self._said_by(tick))
        self._snapshots, self._before = (
            tuple(shot for shot in shots if shot.tick <= tick) for shots in (self._snapshots, self._before)
        )
        self._track.cut(tick)
        self._work = 0
        self._recent.clear()

    def work_to(self, tick: int) -> int:
        """The approximate work to replay to a past tick, in ticks. Raises `IndexError`."""
        self._check(tick)
        shot = self._nearest_shot(tick)
        said = self._said_by(tick) - shot.entries
        return tick - shot.tick + said * ACTION_WORK

    def work_since(self, tick: int) -> int:
        """The approximate work to rerun from a past tick to the present, in ticks. Raises `IndexError`."""
        said = len(self.entries) - self._said_by(tick)
        return self.work_to(tick) + (self.tick - tick) * _tick_work(self.state) + said * ACTION_WORK

    def at(self, tick: int) -> SimState:
        """The state at a past tick, after the actions of that tick. Raises `IndexError`."""
        self._check(tick)
        if tick == self.tick:
            return self.state
        back = tick - self.tick + len(self._recent)
        if back >= 0:
            return self._recent[back]
        return next(self.between(tick, tick + 1))

    def between(self, first: int, stop: int) -> Iterator[SimState]:
        """The states from tick `first` up to but without `stop`, replayed in one go. Raises `IndexError`."""
        if first == stop:
            return
        for tick in (first, stop - 1):
            self._check(tick)
        state, position = self._nearest(first)
        track = self._track.copy()  # whoever reads on later reads of this
        while state.world.tick < stop:
            state, position, _ = self._apply_due(state, position)
            if state.world.tick >= first:
                yield state
            state = _after_rules(state, track.after(state))

    def decision(self, tick: int, ego: str | None = None) -> Decision | None:
        """The decision taken at a tick (None while a result stood), derived anew. Raises `IndexError`."""
        return self.decided(self.at(tick), ego)

    def decided(self, state: SimState, ego: str | None = None) -> Decision | None:
        """The decision of an ego, of the first by default, taken in a state of this timeline.

        None while a result stood, and where that ego had arrived.

        The decision is recomputed, except where the move of a planner of another package is recorded: that
        planner is not asked again. For the present state, it is the decision that would be made now.
        """
        step = self.taken(state, ego)
        return None if step is None else step.decision

    def taken(self, state: SimState, ego: str | None = None) -> EgoStep | None:
        """The decision of `decided`, with what that ego saw and expected."""
        return decide_each(state, self._noted(state)).get(ego or FIRST)

    def announced(self, state: SimState, ego: str | None = None) -> dict[str, Move]:
        """The moves that an ego knew of when it decided in a state of this timeline, by ego id."""
        return announced_before(state, ego, self._noted(state)) if len(state.world.avs) > 1 else {}

    def led_to(self, state: SimState) -> StepResult:
        """The tick that a state of this timeline led to."""
        return _with_rules(state, step(state, self._noted(state)))

    def _noted(self, state: SimState) -> dict[str, Decision]:
        """What planners of other packages decided in a past state, by ego id, where that is noted."""
        tick, found = state.world.tick, dict[str, Decision]()
        if tick >= self.tick:
            return found
        for number, id in enumerate(state.egos):
            config = state.config_of(id)
            if not is_foreign(config.planner):
                continue
            move = self._track.planned(tick, number)
            if move is not None:
                percept = sense(state, self._track.moves(state), id)[0]
                found[id] = recorded_decision(percept, config, move)
            elif self._track.failed(tick, number):
                found[id] = failed_decision(sense(state, self._track.moves(state), id)[0], config)
        return found

    def _check(self, tick: int) -> None:
        if not 0 <= tick <= self.tick:
            raise IndexError(f"tick {tick} is not between 0 and {self.tick}")

    def _went_on(self, tick: StepResult, entries: int) -> None:
        """One tick on, which was decided now, with so many entries applied."""
        self.state = tick.state
        steps, egos = tick.steps, tick.state.egos
        if len(egos) == 1:
            self._track.note(tick.decision)
        else:
            self._track.note(*[steps[id].decision if id in steps else None for id in egos])
        look, events = _look_work(tick.state), tick.events
        again = look + 1
        if events:
            fired = ACTION_WORK * sum(event.type is EventType.TRIGGERED for event in events)
            again += fired + _road_work(tick.state, events)
        self._worked(look + _tick_work(tick.state), again, entries)

    def _worked(self, work: int, again: int, entries: int) -> None:
        """Adds up the work done and `again`, its cost in a replay; takes a snapshot where one is due."""
        self._work += again
        self.worked += work
        if self._work < self._gap:
            return
        self._work = 0
        self._snapshots = (*self._snapshots, Snapshot(self.tick, self.state, entries))
        if len(self._snapshots) > UNPACKED:
            self._snapshots[-UNPACKED - 1].pack()
        if len(self._snapshots) > MAX_SNAPSHOTS:
            self._gap *= 2
            self._snapshots = self._snapshots[::2]

    def _forget_from(self, entries: Sequence[Entry], since: int) -> None:
        """Drops the snapshots that are wrong for the new log, which differs from tick `since` on."""
        start = bisect_left(self.entries, since, key=lambda entry: entry.tick)
        alike = start
        while alike < min(len(entries), len(self.entries)) and entries[alike] == self.entries[alike]:
            alike += 1  # an entry at this very tick may be among what stays
        self._snapshots, self._before = (
            tuple(shot for shot in shots if shot.tick <= since and shot.entries <= alike)
            for shots in (self._snapshots, self._before)
        )

    def _said_by(self, tick: int) -> int:
        """How many entries there are up to a tick and at it."""
        return bisect_right(self.entries, tick, key=lambda entry: entry.tick)

    def _nearest_shot(self, tick: int) -> Snapshot:
        nearest = self._snapshots[bisect_right(self._snapshots, tick, key=lambda shot: shot.tick) - 1]
        for shot in reversed(self._before):
            if shot.tick <= tick:
                return max(nearest, shot, key=lambda each: (each.tick, each.entries))
        return nearest

    def _nearest(self, tick: int) -> tuple[SimState, int]:
        shot = self._nearest_shot(tick)
        return shot.state, shot.entries

    def _apply_due(self, state: SimState, position: int) -> tuple[SimState, int, int]:
        """The state, the entries applied, and the work of those that were applied now."""
        work, due = 0, len(self.entries)
        entries = self.entries.shared  # nearly always there is nothing to do: that is to take no time
        while position < due and entries[position].tick == state.world.tick:
            applied = apply(state, entries[position].action)
            state = applied.state
            work += _action_work(applied)
            position += 1
        return state, position, work


def _answered(tick: StepResult) -> StepResult:
    """A tick whose planner answered in time. Raises `PlannerSilentError`."""
    for each in tick.steps.values():
        if each.decision.timed_out:
            raise PlannerSilentError(each.decision.planner, each.decision.fault or "")
    return tick


def _with_rules(before: SimState, tick: StepResult) -> StepResult:
    """A tick with the rules that were due at its end done."""
    if not tick.state.triggers:
        return tick
    state, events = fire(before, tick.state)
    return replace(tick, state=state, events=(*tick.events, *events))


def _after_rules(before: SimState, after: SimState) -> SimState:
    """The state after a tick with the rules that were due at its end done."""
    return fire(before, after)[0] if after.triggers else after


def _tick_work(state: SimState) -> int:
    egos = state.egos
    if len(egos) == 1:
        return traits_of(state.ego().planner or state.config.planner).work
    return max(traits_of(ego.planner or state.config.planner).work for ego in egos.values())


def _look_work(state: SimState) -> int:
    return 0 if sensor_named(state.config.sensor).stateless else LOOK_WORK * len(state.egos)


def _action_work(applied: Applied) -> int:
    world = applied.state.world
    things = len(world.movers) + len(world.hazards)
    return ACTION_WORK + things // THINGS_AN_ACTION + _road_work(applied.state, applied.events)


def _road_work(state: SimState, events: Sequence[Event]) -> int:
    if not any(event.type in _DRAWN for event in events):
        return 0
    return ROAD_WORK + state.world.road.columns * state.world.road.rows // ROAD_CELLS
