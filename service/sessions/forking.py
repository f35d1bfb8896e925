"""A session's way up to a tick, as the beginning of another: what a fork and a link are made of.

Taken from the log as it stands, not as it was said: what was undone or gone back on is not in it. So the
utterances are numbered anew and only the ones that changed the road come along, without their words; names
of moments and what "it" was do not. States and snapshots are shared with the session they were taken from.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import Any

from service import actions as contract
from service.sessions.history import History, Step
from service.store import EntryRecord
from sim.timeline import Entry, Timeline


@dataclass(frozen=True, slots=True)
class Way:
    """How a state was come to: a timeline that ends in it, and the same as steps and as stored."""

    timeline: Timeline
    history: History
    records: tuple[EntryRecord, ...]


def way_to(timeline: Timeline, tick: int, paused: bool = True) -> Way:
    """The way of a timeline to a past tick. Raises `IndexError`; the timeline itself stays as it is.

    `paused` is how the other session begins.
    """
    own = timeline.copy()
    own.rewind(tick)
    groups = [list(group) for _, group in groupby(own.entries, key=lambda each: (each.sequence, each.tick))]
    said = [
        tuple(Entry(number, entry.tick, entry.action) for entry in group)
        for number, group in enumerate(groups, start=1)
    ]
    own.entries = [entry for group in said for entry in group]
    history = History([Step((), group, paused, paused) for group in said])
    # All at once: one by one takes twice as long.
    dumped = iter(contract.dump(tuple(entry.action for entry in own.entries)))
    return Way(own, history, tuple(_record(group, [next(dumped) for _ in group]) for group in said))


def _record(group: Sequence[Entry], actions: Sequence[Mapping[str, Any]]) -> EntryRecord:
    return EntryRecord(sequence=group[0].sequence, tick=group[0].tick, text=None, actions=actions)
