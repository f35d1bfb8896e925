"""Encodes session snapshots as JSON values, and decodes them. For any thread."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import chain
from typing import Any

from service import actions as contract
from service.sessions.bookmarks import Bookmark
from service.sessions.conversation import Conversation
from service.sessions.log import LogEvent
from service.sessions.persistence.session_snapshot import SessionSnapshot
from service.sessions.rewind import TimeJump
from service.sessions.undo_stack import UndoStack, UndoStep
from sim.actions import Trigger, WorldAction
from sim.session.persistent_list import PersistentList
from sim.session.serialization import Packer, Pool, Unpacker
from sim.session.timeline import Entry, Snapshot, Timeline

MAX_STATES = 1_024
"""Largest number of intermediate states; timelines beside the present one are thinned to fit."""

ACTIONS_PER_CALL = 500
"""Actions dumped in one call, which holds the interpreter lock."""


def encode(frozen: SessionSnapshot, thinned: int = 1) -> tuple[dict[str, Any], set[str]]:
    """A snapshot as JSON values, with one of `thinned` intermediate states, and its planners."""
    writing = _Encoder(frozen, thinned)
    return writing.values, writing.packer.planners()


class _Encoder:
    """Numbers shared parts, so that each is written once: entries, logs, states and timelines."""

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
            "ground": [
                history.base_entries,
                history.base_steps,
                history.base_paused,
                history.fork_sequence,
            ],
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
            "triggers": contract.dump(tuple(self.packer.triggers)),
        }

    def _gap_beside(self, beside: Iterable[Timeline]) -> int:
        """One of how many states to write of timelines other than the present one, so that all fit."""
        others = {id(each) for timeline in beside for each in timeline.parts()[3]} - self._main
        room, gap = max(1, MAX_STATES - len(self._main)), self._thinned
        while len(others) > room * gap:
            gap *= 2
        return gap

    def _encode_logs(self, timelines: Sequence[Timeline]) -> tuple[dict[int, int], list[Any]]:
        """The distinct logs, each as the length of the prefix it shares with the one before, and the rest."""
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
            step.speed,
        ]


def _ascii(moves: bytes) -> str:
    return moves.decode("ascii")


def _entries(entries: Sequence[Entry]) -> list[Any]:
    """Sequences, ticks, which action each entry has, and the distinct actions."""
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
    """The snapshot from JSON values.

    Raises `ValueError`, `TypeError` or `LookupError` for invalid values.
    """
    entries = _decode_entries(values["entries"])
    timelines = _decode_timelines(values, entries)

    def step(parts: Sequence[Any]) -> UndoStep:
        before, after, paused_before, paused_after, jump, speed = parts
        return UndoStep(
            tuple(entries[number] for number in before),
            tuple(entries[number] for number in after),
            paused_before,
            paused_after,
            None if jump is None else TimeJump(timelines[jump[0]], timelines[jump[1]]),
            None if speed is None else (speed[0], speed[1]),
        )

    ground, ground_steps, ground_paused, fork_sequence = values["ground"]
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
            fork_sequence=fork_sequence,
        ),
        partial_changes=frozenset(values["mixed"]),
        conversation=Conversation.from_json(values["conversation"]),
        last_line=values["last_line"],
        lines=[
            LogEvent(0, tick, kind, text, tuple(ids), None if cell is None else (cell[0], cell[1]))
            for tick, kind, text, ids, cell in values["lines"]
        ],
    )


def _decode_entries(parts: Sequence[Any]) -> list[Entry]:
    sequences, ticks, which, dumped = parts
    actions: Sequence[WorldAction] = contract.load(dumped)  # type: ignore[assignment]  # none else is written
    return [
        Entry(sequence, tick, actions[number])
        for sequence, tick, number in zip(sequences, ticks, which, strict=True)
    ]


def _decode_timelines(values: Mapping[str, Any], entries: Sequence[Entry]) -> list[Timeline]:
    triggers: Sequence[Trigger] = contract.load(values.get("triggers", []))  # type: ignore[assignment]
    states = Unpacker(values["states"], triggers)
    logs: list[PersistentList[Entry]] = []
    for alike, *stretches in values["logs"]:
        begin = logs[-1].shared[:alike] if alike else ()
        logs.append(PersistentList([*begin, *_decode_runs(stretches, entries)]))
    snapshots = [
        Snapshot(states.runs[run].world.tick, states.runs[run], count) for run, count in values["snapshots"]
    ]
    moves = [each.encode("ascii") for each in values["moves"]]
    return [
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


def _common_prefix_length(one: Sequence[Entry], other: Sequence[Entry]) -> int:
    """The number of entries that both begin with."""
    low, high = 0, min(len(one), len(other))
    while low < high:  # whole slices: comparing them is quick where they are the same objects
        middle = (low + high + 1) // 2
        if one[low:middle] == other[low:middle]:
            low = middle
        else:
            high = middle - 1
    return low


def _encode_runs(numbers: Sequence[int]) -> list[int]:
    """Numbers as runs of consecutive ones: the first of each run, and its length."""
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
