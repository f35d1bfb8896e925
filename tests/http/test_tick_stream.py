"""The messages of ticks, byte for byte: however quickly they are made, readers of old see no difference."""

from __future__ import annotations

from hashlib import blake2b

import pytest

from service.contract.encode.state import SessionStatus
from service.sessions.messages import tick_message
from sim.config import Config
from sim.state import SimState
from sim.transition import step
from tests.support.tick_roads import TICKS, roads

SENT = {1: "45287be357b9314cdd82bdff1d2bebf9", 2: "c93cb4d0551258ed8c4e9ddb214ee01c"}
"""By version of the rules."""
FIRST = {"attentive": 0.0, "collision": "cell", "repetition": False, "rules": 1}
NOWHERE = SessionStatus("s", paused=False, sequence=0)


def sent(config: Config) -> list[bytes]:
    """What is told of every tick but those that begin a road: that is a state, which may come to say more."""
    run, told = SimState.start(config), []
    for sequence in range(TICKS):
        tick = step(run)
        if tick.state.world.episode == run.world.episode:
            words = None if tick.decision is None else f"{tick.decision.move}."
            told.append(tick_message(sequence, lambda: NOWHERE, run, tick.state, tick.decision, words, ()))
        run = tick.state
    return told


def under(rules: int, config: Config) -> Config:
    """The road as it was under a version of the rules."""
    if rules == 2:
        return config
    planner = "priority" if config.planner == "rules" else config.planner
    return config.with_parts(**FIRST, planner=planner)


@pytest.mark.parametrize("rules", SENT)
def test_what_is_sent_is_what_was_sent_before(rules: int) -> None:
    messages = [message for config in roads() for message in sent(under(rules, config))]
    assert len(messages) > len(roads()) * TICKS * 0.9
    assert blake2b(b"".join(messages), digest_size=16).hexdigest() == SENT[rules]
