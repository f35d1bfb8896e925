"""Makes a session that begins as another one was at a tick, with changes of its own."""

from __future__ import annotations

import secrets
from dataclasses import replace
from datetime import UTC, datetime
from functools import partial

from anyio import to_thread

from service import actions as contract
from service.actions import Action
from service.actions.table import PLAYBACK_SPEED, traits_of
from service.sessions.facts import performed_actions
from service.sessions.fork import fork_point
from service.sessions.persistence.replay import replay_one
from service.sessions.scheduler.offload import STEPS_S, with_time_limit
from service.sessions.scheduler.playback_speed import NORMAL
from service.sessions.services import SessionServices
from service.sessions.session import Session
from service.store import EntryRecord, SessionRecord
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
    point = await to_thread.run_sync(fork_point, parent.id, partial_changes, timeline, tick)
    record = SessionRecord(
        id=secrets.token_urlsafe(16),
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
    actions = await to_thread.run_sync(_settled, session, actions)
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
        again = partial(replay_one, session, session.narrator, entry)
        await to_thread.run_sync(with_time_limit(STEPS_S, again))
    session.record = replace(record, tick=session.timeline.tick)
    session.paused = session.paused if paused is None else paused
    return session, entries


def _settled(session: Session, actions: tuple[Action, ...]) -> tuple[Action, ...]:
    """The actions with what each goal and style comes to in its place, as they are stored."""
    if not any(traits_of(action).stands_for_others for action in actions):
        return actions
    return performed_actions(actions, session.begin_transaction().perform(session.sequence + 1, actions))
