"""A session with a past, to be forked."""

from __future__ import annotations

from hypothesis import strategies as st

from service.problems import ProblemError
from service.sessions.session import Session
from tests.support.session_talk import SAID
from tests.support.sessions import Service, do


async def talked(said: list[tuple[int, list[dict[str, object]]]]) -> tuple[Service, Session]:
    service = Service()
    session = await service.session()
    for ticks, actions in said:
        service.clock.tick(ticks)
        try:
            await do(session, *actions)
        except ProblemError:
            continue
    return service, session


TALK = st.lists(st.tuples(st.integers(0, 6), SAID), max_size=8)
