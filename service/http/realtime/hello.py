"""The first message of a stream: the whole session, its state and the latest lines of its log."""

from __future__ import annotations

from service.http.deps import Context
from service.http.session_json import session_json, told_decision
from service.sessions.messages import hello_message
from service.sessions.session import Session
from service.sessions.subscribers import add_event_id

HELLO_EVENTS = 100
"""Lines of the log that a new client gets."""


def hello(context: Context, session: Session) -> bytes:
    """Makes the message."""
    latest = session.latest_decision()
    decision = told_decision(session.narrator, latest[1], latest[0]) if latest else None
    log = session.log.latest(HELLO_EVENTS)
    sentence = context.interpreter.sentence_for(session.run.config, session.language)
    own, state = session_json(session, sentence), session.state_body()
    message = hello_message(own, state, log, decision, session.sequence)
    return add_event_id(message, session.subscribers.last_event_id)
