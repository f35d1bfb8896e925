"""Fork points: a session's timeline up to a tick, as the start of another session or of a link.

A fork point is taken from the log without undone and rewound changes. It has the changes of the road only,
without their text; bookmarks and the conversation are left out.

A fork shares the log with its parent, in memory and in the store, and continues its sequence numbers. A link
writes the log out.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from itertools import groupby

from service import actions as contract
from service.actions import Action
from service.actions.table import is_world_action
from service.sessions.undo_stack import UndoStack
from service.store import Branch, EntryRecord
from service.store.fork_log import encode_standing
from sim.session.timeline import Entry, Timeline


@dataclass(frozen=True, slots=True)
class ForkPoint:
    """A timeline that ends at the fork, and how its log relates to the parent's."""

    timeline: Timeline
    branch: Branch
    steps: int
    """number of changes up to the fork"""

    def undo_stack(self, paused: bool) -> UndoStack:
        """The undo stack of a session that starts here."""
        return UndoStack(
            base_entries=len(self.timeline.entries),
            base_steps=self.steps,
            base_paused=paused,
            fork_sequence=self.branch.sequence + 1,
        )


def timeline_until(timeline: Timeline, tick: int) -> Timeline:
    """A copy of a timeline, rewound to a past tick. Raises `IndexError`."""
    own = timeline.copy()
    own.rewind(tick)
    return own


def fork_point(session_id: str, mixed: Collection[int], timeline: Timeline, tick: int) -> ForkPoint:
    """The fork point of a session at a past tick; `mixed`: changes that are in the log in part only."""
    own = timeline_until(timeline, tick)
    numbers = [entry.sequence for entry in own.entries]
    last = numbers[-1] if numbers else 0
    written = {each for each in numbers if each in mixed} if mixed else set()
    parts = [entry for entry in own.entries if entry.sequence in written] if written else []
    instead = [
        {"sequence": record.sequence, "tick": record.tick, "actions": record.actions}
        for record in _records(parts)
    ]
    common = encode_standing((each for each in numbers if each not in written) if written else numbers, last)
    branch = Branch(parent=session_id, sequence=last, tick=tick, standing=common, instead=instead)
    return ForkPoint(own, branch, int(common, 16).bit_count() + len(instead))


def is_partly_of_world(actions: Sequence[Action]) -> bool:
    """Whether some of these actions change the world and some do not: the log has only part of them."""
    changing = sum(is_world_action(action) for action in actions)
    return 0 < changing < len(actions)


def flatten_log(timeline: Timeline) -> list[EntryRecord]:
    """The log of a timeline as entries of a session, numbered from 1."""
    return renumber(_records(timeline.entries))


def renumber(entries: Sequence[EntryRecord]) -> list[EntryRecord]:
    """The same entries, numbered from 1 without gaps, since a recording has no parent."""
    return [
        EntryRecord(sequence=number, tick=each.tick, text=each.text, actions=each.actions, digest=each.digest)
        for number, each in enumerate(entries, start=1)
    ]


def _records(entries: Sequence[Entry]) -> list[EntryRecord]:
    # All at once: one by one takes twice as long.
    dumped = iter(contract.dump(tuple(entry.action for entry in entries)))
    return [
        EntryRecord(sequence=sequence, tick=tick, text=None, actions=[next(dumped) for _ in said])
        for (sequence, tick), said in groupby(entries, key=lambda each: (each.sequence, each.tick))
    ]
