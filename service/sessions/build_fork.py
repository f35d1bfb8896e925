"""Makes a session that begins as another one was at a tick, with changes of its own."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime
from functools import partial

from service import actions as contract
from service.actions import Action
from service.actions.table import PLAYBACK_SPEED, traits_of
from service.sessions.facts import performed_actions
from service.sessions.fork import fork_point
from service.sessions.persistence.replay import replay_one
from service.sessions.persistence.replay_elsewhere import replay_entry
from service.sessions.persistence.session_snapshot import SessionSnapshot
from service.sessions.scheduler.offload import STEPS_S, run_in_thread
from service.sessions.scheduler.playback_speed import NORMAL
from service.sessions.services import SessionServices
from service.sessions.session import Session
from service.sessions.work_estimate import transaction_units
from service.store import EntryRecord, SessionRecord
from service.work.units import THREAD
from sim.actions import Set


async def build_fork(
    parent: Session,
    tick: int,
    actions: tuple[Action, ...],
    name: str | None,
    paused: bool | None,
    services: SessionServices,
) -> tuple[Session, list[EntryRecord]]:
    """A session that is `parent` up to a tick and then changed, not yet stored, and its own entries.

    `paused`: None for as the parent is. Raises a `ProblemError`.
    """
    speed, begins = parent.playback_speed, parent.paused if paused is None else paused
    partial_changes, timeline = parent.partial_changes.copy(), parent.timeline.copy()
    point = await services.work.in_thread(fork_point, parent.id, partial_changes, timeline, tick)
    record = SessionRecord(
        id=services.shard.new_id(),
        name=name,
        created_at=datetime.now(UTC),
        config=parent.record.config,
        paused=begins,
        tick=tick,
        branch=point.branch,
        language=parent.language,
    )
    session = Session(record, point.timeline, services)
    session.start_from(point)
    session.partial_changes = {each["sequence"] for each in point.branch.instead}
    if not any(traits_of(action).changes_session for action in actions):
        # Done only to refuse what is not possible: as everywhere, it is not stored.
        session.begin_transaction().perform(session.sequence + 1, actions)
        actions = ()
    actions = await services.work.in_thread(_settled, session, actions)
    said: list[tuple[Action, ...]] = (
        [] if speed == NORMAL else [(Set(parameter=PLAYBACK_SPEED, value=speed),)]
    )
    if actions:
        said.append(actions)
    entries: list[EntryRecord] = []
    for each in said:
        entry = EntryRecord(
            sequence=session.sequence + 1,
            tick=session.timeline.tick,
            text=None,
            actions=contract.dump(each),
        )
        entries.append(entry)
        session = await _perform(session, entry, each, services)
    session.record = replace(record, tick=session.timeline.tick)
    session.paused = session.paused if paused is None else paused
    return session, entries


async def _perform(
    session: Session, entry: EntryRecord, actions: tuple[Action, ...], services: SessionServices
) -> Session:
    """The session with an entry performed; another object where that was done in a worker process."""
    transaction = session.begin_transaction()
    units = transaction_units(transaction, actions)
    services.work.check(units)
    again = partial(replay_one, session, session.narrator, entry)
    if transaction.needs_external_planner(actions):
        await run_in_thread(True, STEPS_S, again)
        return session
    if units <= THREAD:
        await services.work.in_thread(again)
        return session
    snapshot = SessionSnapshot.take(session)
    done = await services.work.in_process(
        units, replay_entry, session.record, snapshot, entry, services.narrator, services.settings
    )
    partial_changes = session.partial_changes
    session = done.revive(session.record, services)
    session.paused = done.snapshot.paused
    session.partial_changes |= partial_changes
    return session


def _settled(session: Session, actions: tuple[Action, ...]) -> tuple[Action, ...]:
    """The actions with what each goal and style comes to in its place, as they are stored."""
    if not any(traits_of(action).stands_for_others for action in actions):
        return actions
    return performed_actions(actions, session.begin_transaction().perform(session.sequence + 1, actions))
