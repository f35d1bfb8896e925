"""What is asked for by leave: "could I take the wheel from here?".

While a drive goes on, that is a request made politely. Once it is over, nobody can drive on from there, so it
is a question, and nothing is done.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Final

from service.actions import Action, Ask
from service.sessions.utterance import Utterance
from sim.actions import SetMode
from sim.session.timeline import Timeline
from sim.types import Mode, Outcome

PERMISSION: Final = "permission"
"""What an utterance supposes that asks whether a person may drive."""
ANSWERED: Final = Ask(about="world", what="endings")
"""The question it is once the drive is over: what follows an end."""


def as_it_stands(utterance: Utterance, timeline: Timeline) -> Utterance:
    """The utterance as it is meant in the present state."""
    if PERMISSION not in utterance.supposes or timeline.state.world.outcome is Outcome.RUNNING:
        return utterance
    actions: list[Action] = []
    for action in utterance.actions:
        meant = ANSWERED if isinstance(action, SetMode) and action.mode is Mode.MANUAL else action
        if meant not in actions:
            actions.append(meant)
    return replace(utterance, actions=tuple(actions), supposes=())
