"""A session's way up to a tick, as the beginning of another: what a fork and a link are made of.

Taken from the log as it stands, not as it was said: what was undone or gone back on is not in it. Only what
changed the road comes along, without its words; names of moments and what "it" was do not.

A fork shares the way with its parent, states and entries in memory, the log in the store, and goes on
counting its changes where the last of them was. A link writes it out.
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
    """How a state was come to: a timeline that ends in it, and where it leaves the log it was taken from."""

    timeline: Timeline
    branch: Branch
    steps: int
    """changes on it"""

    def undo_stack(self, paused: bool) -> UndoStack:
        """What can be undone of it, in a session that begins so."""
        return UndoStack(base_entries=len(self.timeline.entries), base_steps=self.steps, base_paused=paused)


def timeline_until(timeline: Timeline, tick: int) -> Timeline:
    """A timeline up to a past tick. Raises `IndexError`; the timeline itself stays as it is."""
    own = timeline.copy()
    own.rewind(tick)
    return own


def fork_point(session_id: str, mixed: Collection[int], timeline: Timeline, tick: int) -> ForkPoint:
    """The way of a session to a past tick; `mixed` are the changes that the log has a part of only."""
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
    """Whether such a change is in the log of the road with part of its actions only."""
    changing = sum(is_world_action(action) for action in actions)
    return 0 < changing < len(actions)


def flatten_log(timeline: Timeline) -> list[EntryRecord]:
    """The log of a timeline as changes of a session, numbered from 1."""
    return renumber(_records(timeline.entries))


def renumber(entries: Sequence[EntryRecord]) -> list[EntryRecord]:
    """The same, numbered from 1 without gaps: a recording has no parent."""
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
