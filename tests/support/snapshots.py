"""Sessions brought back from a snapshot, compared with those that never left."""

from __future__ import annotations

from copy import deepcopy
from typing import Any

import orjson
from hypothesis import strategies as st

from service.grammar.topic import Phrases
from service.problems import ProblemError
from service.sessions.fork import fork_point
from service.sessions.session import Session
from service.store import MemoryStore
from tests.support.session_talk import SAID, load, rewind, save
from tests.support.sessions import ADD, ADD_CARS, PAUSE, REDO, RESUME, UNDO, Service, do

AFTERWARDS = ([UNDO], [UNDO], [REDO], [ADD], [load("a")], [UNDO, ADD], [rewind(2)], [UNDO], [PAUSE], [RESUME])


def all_of(session: Session) -> dict[str, Any]:
    """Whatever a user could see of it, now or later."""
    position = session.log_position
    steps = (*session.undo_stack.done, *session.undo_stack.undone)
    jumps = [(each.jump.before, each.jump.after) for each in steps if each.jump is not None]
    return {
        **whole(session),
        "paused": (session.paused, position.paused, position.tick, position.digest),
        "ground": (
            session.undo_stack.base_entries,
            session.undo_stack.base_steps,
            session.undo_stack.base_paused,
        ),
        "past": list(session.timeline.between(0, session.timeline.tick)),
        "moments": [
            (name, each.timeline.state, list(each.timeline.entries))
            for name, each in session.undo_stack.bookmarks.items()
        ],
        "jumps": [(one.state, other.state, [*one.entries], [*other.entries]) for one, other in jumps],
        "standing": session.status,
        "state": orjson.loads(session.state_body()),
        "talk": session.conversation.to_json(),
        "first line": session.log.first_number,
    }


async def said(session: Session, actions: list[dict[str, object]]) -> str:
    try:
        return await do(session, *actions)
    except ProblemError as problem:
        return problem.detail


async def back(store: MemoryStore, session: str, *, short: bool, **given: int) -> Session:
    """The session in a service of its own, of a copy of the store."""
    copied = deepcopy(store)
    if not short:
        copied._snapshots.clear()
    service = Service(copied, **given)
    found = await service.manager.get(session)
    fates = service.manager.snapshots.counts
    assert (fates["used"], fates["unfit"]) == ((1, 0) if short else (0, 0))
    return found


async def compared(store: MemoryStore, session: str, **given: int) -> None:
    short = await back(store, session, short=True, **given)
    long = await back(store, session, short=False, **given)
    assert all_of(short) == all_of(long)
    for actions in AFTERWARDS:
        one, other = await said(short, actions), await said(long, actions)
        assert one == other, (actions, one, other)
        assert all_of(short) == all_of(long)
    ways = [
        fork_point(each.id, each.partial_changes, each.timeline, each.timeline.tick // 2)
        for each in (short, long)
    ]
    assert ways[0].branch == ways[1].branch, "what a fork and a link are made of"


NAMES = st.sampled_from([[save("a")], [save("b"), ADD], [load("a")], [ADD_CARS, load("b"), ADD]])


TALK = st.lists(st.tuples(st.integers(0, 5), st.one_of(SAID, NAMES)), max_size=12)


def whole(session: Session) -> dict[str, Any]:
    return {
        "run": session.run,
        "sequence": session.sequence,
        "pace": session.playback_speed,
        "entries": list(session.timeline.entries),
        "done": session.undo_stack.done,
        "undone": session.undo_stack.undone,
        "steps": session.undo_stack.steps,
        "saved": {name: (each.sequence, each.tick) for name, each in session.undo_stack.bookmarks.items()},
        "topic": session.conversation.topic(session.run, Phrases()),
        "mixed": session.partial_changes,
        "log": (session.log.last_number, session.log.latest(400)),
    }
