"""The log of a fork: the shared entries of its parent, then its own.

A log is append-only, so shared entries stay where they are, whatever the parent does, even if it is deleted.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from service.store.base import Branch, EntryRecord

_SET = ord("1")


def encode_standing(numbers: Iterable[int], last: int) -> str:
    """Numbers up to `last` as `Branch.standing`."""
    size = last // 8 + 1
    digits = bytearray(b"0" * (8 * size))
    for number in numbers:
        digits[number] = _SET
    # Read as one number of two digits: bits set one by one take three times as long.
    digits.reverse()
    return int(digits, 2).to_bytes(size, "little").hex()


def join_logs(line: Iterable[tuple[Branch | None, Sequence[EntryRecord]]]) -> list[EntryRecord]:
    """The log of the last of a chain of sessions, each a fork of the one before, with its own entries."""
    log: list[EntryRecord] = []
    for branch, own in line:
        log = [*(inherited_entries(branch, log) if branch is not None else ()), *own]
    return log


def inherited_entries(branch: Branch, log: Sequence[EntryRecord]) -> list[EntryRecord]:
    """The shared entries of a fork, given its parent's log; without their text."""
    board = bytes.fromhex(branch.standing)
    entries = [
        EntryRecord(
            sequence=each.sequence, tick=each.tick, text=None, actions=each.actions, digest=each.digest
        )
        for each in log
        if each.sequence <= branch.sequence and board[each.sequence >> 3] >> (each.sequence & 7) & 1
    ]
    if branch.instead:
        entries += [EntryRecord(**each, text=None) for each in branch.instead]
        entries.sort(key=lambda each: (each.sequence, each.tick))
    return entries
