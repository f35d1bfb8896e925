"""A snapshot: a whole session as one value.

A snapshot has all that a replay of the log would lead to: the present and the past states, what can be undone
and redone, bookmarks, the conversation, the latest lines. Taking it is quick and runs on the event loop; it
is immutable, so `snapshot_codec` encodes it in any thread. Transient lines, unstored talk and subscribers are
left out, as a restart drops them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from service.sessions.conversation import Conversation
from service.sessions.log import LogEvent
from service.sessions.scheduler.playback_speed import PlaybackSpeed
from service.sessions.undo_stack import UndoStack
from sim.session.timeline import Timeline

if TYPE_CHECKING:
    from service.sessions.session import Session


@dataclass(frozen=True, slots=True, kw_only=True)
class SessionSnapshot:
    """A session as its log has it, at one moment."""

    session: str
    sequence: int
    log_digest: bytes
    changed_at: int
    """the tick of the latest change"""
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
        """The snapshot of a session; for the event loop's thread."""
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
        """Make a new session equal to the snapshot."""
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
