"""A whole session as one value, and that as JSON values and back.

All that a replay of its log would come to: the present, the past with what makes every tick of it near, what
can be undone and redone, moments with a name, what "it" is, the latest lines. Taking the value is quick and
done where the session lives; what it is made of never changes, so writing it is for any thread. Leaves out
what a restart does away with: passing lines, talk that was kept nowhere, watchers.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import TYPE_CHECKING, Any

from service import actions as contract
from service.sessions.bookmarks import Bookmark
from service.sessions.conversation import Conversation
from service.sessions.log import LogEvent
from service.sessions.rewind import TimeJump
from service.sessions.scheduler.playback_speed import PlaybackSpeed
from service.sessions.undo_stack import UndoStack, UndoStep
from sim.actions import WorldAction
from sim.session.persistent_list import PersistentList
from sim.session.serialization import Packer, Pool, Unpacker
from sim.session.timeline import Entry, Snapshot, Timeline

if TYPE_CHECKING:
    from service.sessions.session import Session

MAX_STATES = 1_024
"""States on the way of all timelines together; of those beside the present one fewer are written then."""

ACTIONS_PER_CALL = 500
"""Actions written at once: nothing else is done meanwhile, not even in other threads."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SessionSnapshot:
    """A session as its log has it, at one moment."""

    session: str
    sequence: int
    log_digest: bytes
    changed_at: int
    """the tick at which the latest change was done"""
    paused: bool
    playback_speed: PlaybackSpeed
    timeline: Timeline
    undo_stack: UndoStack
    partial_changes: frozenset[int]
    conversation: Conversation
    last_line: int
    lines: Sequence[LogEvent]

    @staticmethod
    def take(session: Session) -> SessionSnapshot:
        """A session as it is now; for its own thread."""
        last, lines = session.log.durable_lines()
        return SessionSnapshot(
            session=session.id,
            sequence=session.sequence,
            log_digest=session.log_position.digest,
            changed_at=session.log_position.tick,
            paused=session.log_position.paused,
            playback_speed=session.playback_speed,
            timeline=session.timeline.copy(),
            undo_stack=session.undo_stack.copy(),
            partial_changes=frozenset(session.partial_changes),
            conversation=session.conversation.durable,
            last_line=last,
            lines=lines,
        )

    def apply_to(self, session: Session) -> None:
        """Make this of a new session, as its log has it."""
        session.sequence, session.playback_speed, session.paused = (
            self.sequence,
            self.playback_speed,
            self.paused,
        )
        session.timeline, session.undo_stack, session.partial_changes = (
            self.timeline,
            self.undo_stack,
            set(self.partial_changes),
        )
        session.conversation = self.conversation
        session.log_position.commit(self.paused, self.changed_at)
        session.log_position.digest = self.log_digest
        session.log.skip(self.last_line - len(self.lines))
        for line in self.lines:
            session.log.add(line.tick, line.type, line.text, line.ids, line.cell)


def encode(frozen: SessionSnapshot, thinned: int = 1) -> tuple[dict[str, Any], set[str]]:
    """It as JSON values, with one of so many states on the way, and the planners that drive in it."""
    writing = _Encoder(frozen, thinned)
    return writing.values, writing.packer.planners()


class _Encoder:
    """Numbers for what is shared: entries of logs, the logs, states, timelines."""

    def __init__(self, frozen: SessionSnapshot, thinned: int) -> None:
        self.packer = Packer()
        self._entries: list[Entry] = []
        self._entry_numbers: dict[int, int] = {}
        self._timelines, self._snapshots, self._moves = Pool(), Pool(), Pool()
        self._thinned = thinned
        history = frozen.undo_stack
        jumps = [step.jump for step in chain(history.done, history.undone) if step.jump is not None]
        beside = [moment.timeline for moment in history.bookmarks.values()]
        beside += [timeline for jump in jumps for timeline in (jump.before, jump.after)]
        self._main = frozenset(
            id(each) for place, each in enumerate(frozen.timeline.parts()[3]) if place % thinned == 0
        )
        self._gap = self._gap_beside(beside)
        self._logs = self._encode_logs([frozen.timeline, *beside])
        main = self._timeline(frozen.timeline)
        self.values: dict[str, Any] = {
            "sequence": frozen.sequence,
            "trail": frozen.log_digest.hex(),
            "changed_at": frozen.changed_at,
            "paused": frozen.paused,
            "pace": frozen.playback_speed,
            "timeline": main,
            "done": [self._step(step) for step in history.done],
            "undone": [self._step(step) for step in history.undone],
            "saved": [
                [each.name, each.sequence, self._timeline(each.timeline)]
                for each in history.bookmarks.values()
            ],
            "ground": [history.base_entries, history.base_steps, history.base_paused],
            "mixed": sorted(frozen.partial_changes),
            "conversation": frozen.conversation.to_json(),
            "last_line": frozen.last_line,
            "lines": [[line.tick, line.type, line.text, line.ids, line.cell] for line in frozen.lines],
            "timelines": self._timelines.values,
            "snapshots": self._snapshots.values,
            "moves": self._moves.values,
            "logs": self._logs[1],
            "entries": _entries(self._entries),
            "states": self.packer.packed(),
        }

    def _gap_beside(self, beside: Iterable[Timeline]) -> int:
        """One of how many states is written of what is beside the present timeline, so that all have room."""
        others = {id(each) for timeline in beside for each in timeline.parts()[3]} - self._main
        room, gap = max(1, MAX_STATES - len(self._main)), self._thinned
        while len(others) > room * gap:
            gap *= 2
        return gap

    def _encode_logs(self, timelines: Sequence[Timeline]) -> tuple[dict[int, int], list[Any]]:
        """Each list that logs are beginnings of: how much is as in the one before, and what follows."""
        most: dict[int, int] = {}
        lists: dict[int, Sequence[Entry]] = {}
        log: Sequence[Entry]
        for timeline in timelines:
            shared = timeline.entries.shared
            lists[id(shared)] = shared
            most[id(shared)] = max(len(timeline.entries), most.get(id(shared), 0))
        logs: list[Any] = []
        before: Sequence[Entry] = ()
        for key, shared in lists.items():
            log = shared[: most[key]]
            alike = _common_prefix_length(before, log)  # often they are the same but for their ends
            logs.append([alike, *_encode_runs([self._entry(entry) for entry in log[alike:]])])
            before = log
        return {key: number for number, key in enumerate(lists)}, logs

    def _entry(self, entry: Entry) -> int:
        found = self._entry_numbers.get(id(entry))
        if found is None:
            found = self._entry_numbers[id(entry)] = len(self._entries)
            self._entries.append(entry)
        return found

    def _timeline(self, timeline: Timeline) -> int:
        return self._timelines.number(timeline, self._encode_timeline)

    def _encode_timeline(self, timeline: Timeline) -> list[Any]:
        config, run, entries, snapshots, gap, work, worked, moves = timeline.parts()
        kept = [
            each for place, each in enumerate(snapshots) if id(each) in self._main or place % self._gap == 0
        ]
        return [
            self.packer.config(config),
            self.packer.run(run),
            self._logs[0][id(entries.shared)],
            len(entries),
            _encode_runs([self._snapshots.number(each, self._encode_snapshot) for each in kept]),
            gap,
            work,
            worked,
            _encode_runs([self._moves.number(block, _ascii) for block in moves]),
        ]

    def _encode_snapshot(self, snapshot: Snapshot) -> list[int]:
        return [self.packer.run(snapshot.state), snapshot.entries]

    def _step(self, step: UndoStep) -> list[Any]:
        jump = step.jump
        return [
            [self._entry(entry) for entry in step.before],
            [self._entry(entry) for entry in step.after],
            step.paused_before,
            step.paused_after,
            None if jump is None else [self._timeline(jump.before), self._timeline(jump.after)],
        ]


def _ascii(moves: bytes) -> str:
    return moves.decode("ascii")


def _entries(entries: Sequence[Entry]) -> list[Any]:
    """Sequences, ticks, which action each is, and the actions, each once."""
    numbers: dict[str, int] = {}
    actions: list[Any] = []
    which = []
    for start in range(0, len(entries), ACTIONS_PER_CALL):
        for action in contract.dump(
            tuple(entry.action for entry in entries[start : start + ACTIONS_PER_CALL])
        ):
            number = numbers.setdefault(repr(action), len(actions))
            if number == len(actions):
                actions.append(action)
            which.append(number)
    return [[entry.sequence for entry in entries], [entry.tick for entry in entries], which, actions]


def decode(values: Mapping[str, Any], session: str) -> SessionSnapshot:
    """What was written.

    Raises `ValueError`, `TypeError` or `LookupError` for what cannot be read.
    """
    states = Unpacker(values["states"])
    sequences, ticks, which, dumped = values["entries"]
    actions: Sequence[WorldAction] = contract.load(dumped)  # type: ignore[assignment]  # none else is written
    entries = [
        Entry(sequence, tick, actions[number])
        for sequence, tick, number in zip(sequences, ticks, which, strict=True)
    ]
    logs: list[PersistentList[Entry]] = []
    for alike, *stretches in values["logs"]:
        begin = logs[-1].shared[:alike] if alike else ()
        logs.append(PersistentList([*begin, *_decode_runs(stretches, entries)]))
    snapshots = [
        Snapshot(states.runs[run].world.tick, states.runs[run], count) for run, count in values["snapshots"]
    ]
    moves = [each.encode("ascii") for each in values["moves"]]
    timelines = [
        Timeline.made(
            states.configs[config],
            states.runs[run],
            logs[log].first(length),
            _decode_runs(places, snapshots),
            gap,
            work,
            worked,
            _decode_runs(blocks, moves),
        )
        for config, run, log, length, places, gap, work, worked, blocks in values["timelines"]
    ]

    def step(parts: Sequence[Any]) -> UndoStep:
        before, after, paused_before, paused_after, jump = parts
        return UndoStep(
            tuple(entries[number] for number in before),
            tuple(entries[number] for number in after),
            paused_before,
            paused_after,
            None if jump is None else TimeJump(timelines[jump[0]], timelines[jump[1]]),
        )

    ground, ground_steps, ground_paused = values["ground"]
    return SessionSnapshot(
        session=session,
        sequence=values["sequence"],
        log_digest=bytes.fromhex(values["trail"]),
        changed_at=values["changed_at"],
        paused=values["paused"],
        playback_speed=values["pace"],
        timeline=timelines[values["timeline"]],
        undo_stack=UndoStack(
            done=PersistentList([step(parts) for parts in values["done"]]),
            undone=PersistentList([step(parts) for parts in values["undone"]]),
            bookmarks={name: Bookmark(name, number, timelines[of]) for name, number, of in values["saved"]},
            base_entries=ground,
            base_steps=ground_steps,
            base_paused=ground_paused,
        ),
        partial_changes=frozenset(values["mixed"]),
        conversation=Conversation.from_json(values["conversation"]),
        last_line=values["last_line"],
        lines=[
            LogEvent(0, tick, kind, text, tuple(ids), None if cell is None else (cell[0], cell[1]))
            for tick, kind, text, ids, cell in values["lines"]
        ],
    )


def _common_prefix_length(one: Sequence[Entry], other: Sequence[Entry]) -> int:
    """How many entries both begin with."""
    low, high = 0, min(len(one), len(other))
    while low < high:  # whole slices: comparing them is quick where they are the same objects
        middle = (low + high + 1) // 2
        if one[low:middle] == other[low:middle]:
            low = middle
        else:
            high = middle - 1
    return low


def _encode_runs(numbers: Sequence[int]) -> list[int]:
    """Numbers as stretches of such that follow each other: the first of each, and how many."""
    stretches: list[int] = []
    for number in numbers:
        if stretches and number == stretches[-2] + stretches[-1]:
            stretches[-1] += 1
        else:
            stretches += (number, 1)
    return stretches


def _decode_runs(stretches: Sequence[int], values: Sequence[Any]) -> list[Any]:
    found: list[Any] = []
    for first, count in zip(stretches[::2], stretches[1::2], strict=True):
        part = values[first : first + count]
        if len(part) != count:
            raise IndexError(first + count)
        found += part
    return found
