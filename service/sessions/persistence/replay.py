"""Replays: the stored entries of a session, performed again by the same transactions.

The log keeps its latest lines only, so only those are put into words. All else is as without a restart: the
state, what can be undone, bookmarks, the conversation. Questions and transient log lines are not restored.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice, takewhile
from typing import TYPE_CHECKING

from pydantic import ValidationError

from service import actions as contract
from service.actions import Action
from service.problems import Invalid, ProblemError, RecordingMismatch
from service.sessions.facts import Answerable, parts_with_events
from service.sessions.fork import ForkPoint
from service.sessions.log import EventLog
from service.sessions.narrator_protocol import NarratorProtocol
from service.sessions.outcome import compose_reply
from service.sessions.planner_timeout import planner_timeout_problem
from service.sessions.transaction import Transaction, step_ticks
from service.sessions.utterance import Outcome, Utterance
from service.store import Branch, EntryRecord
from sim.events import Event
from sim.session.errors import EditError
from sim.session.timeline import PlannerSilentError, Timeline
from sim.state import SimState, StepResult

if TYPE_CHECKING:
    from service.sessions.session import Session


class ReplayError(Exception):
    """An entry that cannot be replayed; `position` is its index (the number of entries: the time after them).

    `differs`: it can be replayed, but to another digest than it names.
    """

    def __init__(self, position: int, reason: Exception) -> None:
        super().__init__(str(reason))
        self.position = position
        self.differs = isinstance(reason, RecordingMismatch)


@dataclass(frozen=True, slots=True)
class _Line:
    """A line of the log that an entry wrote."""

    tick: int
    text: str


def replay(
    session: Session,
    narrator: NarratorProtocol,
    entries: Sequence[EntryRecord],
    tick: int,
    *,
    most: int | None = None,
    first: int | None = None,
) -> None:
    """Replay entries on a session and run on to `tick`; the session is paused then.

    The session is new, or with `first` it is as the entries before that left it. Nobody else may have it;
    runs in any thread. Raises `ReplayError`, also where more than `most` ticks would have to be run
    (rewinding can make them more than the last tick).
    """
    Replay(session, narrator, session.log).replay_all(entries, tick, most, first)
    session.paused = True


def replay_one(session: Session, narrator: NarratorProtocol, entry: EntryRecord) -> None:
    """Replay one stored entry. Raises `ProblemError`, or pydantic's `ValidationError`."""
    again = Replay(session, narrator, session.log)
    again.replay_entry(entry, contract.load(entry.actions))
    again.write_log()


class Replay:
    """Replays entries on a session that nobody else has yet; in any thread."""

    def __init__(self, session: Session, narrator: NarratorProtocol, log: EventLog) -> None:
        self._session = session
        self._narrator = narrator
        self._log = log
        self._lines: deque[_Line | tuple[Event, SimState]] = deque(maxlen=log.capacity)
        self._written = 0

    def replay_all(
        self, entries: Sequence[EntryRecord], tick: int, most: int | None, first: int | None
    ) -> None:
        """See `replay`."""
        ticks, session = 0, self._session
        actions = _load_actions(entries[first or 0 :])
        branch = session.record.branch
        if first is None:
            first = 0 if branch is None else self._replay_shared(branch, entries, actions)
        for position, entry in enumerate(entries[first:], start=first):
            try:
                said = next(actions)
                ticks += max(0, entry.tick - session.timeline.tick) + step_ticks(said)
                if most is not None and ticks > most:
                    raise Invalid(f"More than {most} ticks would have to be run.")
                self.replay_entry(entry, said, held=len(entries) - position <= self._log.capacity)
            except (ProblemError, ValidationError) as error:
                raise ReplayError(position, error) from error
        try:
            self.run_to(tick)
        except ProblemError as error:
            raise ReplayError(len(entries), error) from error
        self.write_log()

    def _replay_shared(
        self, branch: Branch, entries: Sequence[EntryRecord], actions: Iterator[tuple[Action, ...]]
    ) -> int:
        """Replay what a fork shares with its parent, without log lines; returns the number of entries."""
        timeline, common = self._session.timeline, 0
        for entry in takewhile(lambda each: each.sequence <= branch.sequence, entries):
            try:
                said = next(actions)
                while timeline.tick < entry.tick:
                    _advance(timeline)
                timeline.apply(entry.sequence, said)  # type: ignore[arg-type]  # nothing else comes along
                self._check(entry)
            except (ProblemError, EditError, ValidationError) as error:
                raise ReplayError(common, error) from error
            common += 1
        try:
            while timeline.tick < branch.tick:
                _advance(timeline)
        except ProblemError as error:
            raise ReplayError(common, error) from error
        self._session.partial_changes.update(each["sequence"] for each in branch.instead)
        self._session.start_from(ForkPoint(timeline, branch, common))
        return common

    def replay_entry(self, entry: EntryRecord, said: tuple[Action, ...], *, held: bool = True) -> None:
        """Replay one entry; `held`: the log will still hold a line of it. Raises `ProblemError`."""
        session = self._session
        if entry.tick < session.timeline.tick or entry.sequence != session.sequence + 1:
            raise Invalid(f"Entry {entry.sequence} at tick {entry.tick} is out of order.")
        self.run_to(entry.tick)
        if entry.paused is not None:
            session.paused = entry.paused
        transaction = Transaction(
            session.timeline,
            session.paused,
            session.undo_stack,
            session.playback_speed,
            session.language,
            stored=True,
        )
        facts = transaction.perform(entry.sequence, said)
        before = session.run
        session.log_position.add_work(transaction.timeline.worked, 1)
        step = transaction.undo_stack.is_step_after(session.undo_stack)
        session.adopt(transaction, entry.sequence, said)
        session.log_position.append(entry)
        self._check(entry)
        answers = [self._narrator.answer(fact) for fact in facts if isinstance(fact, Answerable)]
        session.conversation.record(
            Outcome(
                utterance=Utterance(actions=said, text=entry.text),
                facts=facts,
                reply="",
                answer=answers[-1] if answers else None,
                sequence=entry.sequence,
                changes=(),
                before=before,
            ),
            step=step,
        )
        text = compose_reply(self._narrator, facts, answers) if held else ""
        self._add(_Line(entry.tick, text))
        for run, part in parts_with_events(facts):
            for event in part.events:
                self._add((event, run))

    def run_to(self, tick: int) -> None:
        """Run ticks up to one. Raises `ProblemError` where a planner does not answer in time."""
        timeline = self._session.timeline
        while timeline.tick < tick:
            done = _advance(timeline)
            for event in done.events:
                self._add((event, done.state))

    def write_log(self) -> None:
        """Write the lines that the log still holds."""
        self._log.skip(self._written - len(self._lines))
        for line in self._lines:
            if isinstance(line, _Line):
                self._log.add(line.tick, "changed", line.text)
            else:
                event, run = line
                text = self._narrator.event(event, run)
                self._log.add(event.tick, event.type, text, event.ids, event.cell)
        self._lines.clear()
        self._written = 0

    def _add(self, line: _Line | tuple[Event, SimState]) -> None:
        self._lines.append(line)
        self._written += 1

    def _check(self, entry: EntryRecord) -> None:
        if entry.digest is None:
            return
        found = self._session.run.world.digest()
        if found != entry.digest:
            told = f"Entry {entry.sequence} ends in {found}, not in {entry.digest} as it once did."
            raise RecordingMismatch(told)


def _advance(timeline: Timeline) -> StepResult:
    try:
        return timeline.advance()
    except PlannerSilentError as silence:
        raise planner_timeout_problem(silence) from silence


def _load_actions(entries: Sequence[EntryRecord]) -> Iterator[tuple[Action, ...]]:
    """The actions of each entry, validated at once; a bad entry raises when its turn comes."""
    try:
        actions = iter(contract.load([action for entry in entries for action in entry.actions]))
    except ValidationError:
        yield from (contract.load(entry.actions) for entry in entries)
        return
    for entry in entries:
        yield tuple(islice(actions, len(entry.actions)))
