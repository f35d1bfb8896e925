"""What is said to a session in tests of time, storage and forks."""

from __future__ import annotations

from hypothesis import strategies as st

from service.sessions.session import Session
from sim.session.timeline import Timeline
from sim.state import SimState
from tests.support.sessions import ADD, ADD_CARS, PAUSE, REDO, UNDO


def rewind(ticks: int) -> dict[str, object]:
    return {"do": "rewind", "ticks": ticks}


def rewind_to(moment: str | int) -> dict[str, object]:
    return {"do": "rewind", "to": moment}


def anew(session: Session) -> SimState:
    """The state that the present log leads to when it is played from the beginning."""
    timeline = Timeline(session.timeline.config)
    entries = list(session.timeline.entries)
    while True:
        while entries and entries[0].tick == timeline.tick:
            entry = entries.pop(0)
            timeline.apply(entry.sequence, [entry.action])
        if timeline.tick == session.timeline.tick:
            assert not entries, "nothing stands in the log that is still to come"
            return timeline.state
        timeline.advance()


SAID = st.lists(
    st.one_of(
        st.sampled_from([ADD, ADD_CARS, PAUSE, UNDO, REDO, UNDO, REDO, {"do": "resume"}, {"do": "reset"}]),
        st.integers(1, 12).map(rewind),
        st.sampled_from(["crash", "episode", "start", 4]).map(rewind_to),
        st.sampled_from("ab").map(lambda name: {"do": "save", "name": name}),
        st.sampled_from("ab").map(lambda name: {"do": "load", "name": name}),
        st.just({"do": "step", "ticks": 3}),
    ),
    min_size=1,
    max_size=3,
)


def save(name: str) -> dict[str, object]:
    return {"do": "save", "name": name}


def load(name: str) -> dict[str, object]:
    return {"do": "load", "name": name}
