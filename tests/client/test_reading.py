"""Reading the models of the contract: what is new is passed over, what is missing or wrong is named."""

from __future__ import annotations

from typing import Any

import pytest

from service.client.errors import UnexpectedAnswer
from service.client.messages import Hello, Message, Tick, read_message
from service.client.reading import read
from service.contract import answers

MOVE = {"move": "forward", "reason": "free", "causes": []}
DECISION: dict[str, Any] = {"tick": 3, "planner": "rules", "weight": 0, "blocked": [MOVE], **MOVE}
METRICS: dict[str, Any] = {
    "episodes": 1, "successes": 1, "crashes": 0, "stuck": 0, "success_rate": 1, "steps": 4, "distance_m": 5,
    "moves": {"forward": 1, "lateral": 1, "diagonal": 1, "stay": 1}, "last_episode_ticks": None,
}  # fmt: skip
TICK: dict[str, Any] = {
    "type": "tick", "tick": 4, "sequence": 0, "episode": 1, "status": "running", "decision": DECISION,
    "vehicles": {"av-1": [4, 2]}, "moved": {}, "turned": {}, "narration": None, "events": [],
    "metrics": METRICS, "digest": "d", "event": "e.1",
}  # fmt: skip


def test_names_and_keys_that_are_new_are_passed_over() -> None:
    decision = {**DECISION, "move": "backward", "weight": 7, "mood": "calm"}
    told = {**TICK, "status": "parked", "decision": decision, "weather": {"rain": 1}}
    message = read_message(told, resumed=False)
    assert isinstance(message, Tick)
    assert message.decision is not None
    assert (message.status, message.decision.move, message.decision.weight) == ("parked", "backward", 7)
    assert message.raw == told
    assert message.decision.raw["mood"] == "calm"


def test_a_kind_of_message_that_is_new_is_a_message() -> None:
    message = read_message({"type": "weather", "rain": 1}, resumed=False)
    assert type(message) is Message
    assert message.raw["rain"] == 1


def test_actions_of_a_newer_service_are_read_as_they_come() -> None:
    actions = [{"do": "honk", "times": 2}]
    parsed = {"text": "honk twice", "actions": actions, "source": "oracle", "corrections": []}
    assert list(read(answers.Parsed, parsed).actions) == actions


@pytest.mark.parametrize("key", [key for key in TICK if key not in ("type", "vehicles", "moved", "turned")])
def test_a_key_that_is_missing_is_named(key: str) -> None:
    with pytest.raises(UnexpectedAnswer, match=key):
        read_message({name: value for name, value in TICK.items() if name != key}, resumed=False)


def test_the_place_of_a_wrong_value_is_told() -> None:
    wrong = {**TICK, "decision": {**DECISION, "blocked": [{**MOVE, "causes": "p1"}]}}
    with pytest.raises(UnexpectedAnswer, match=r"the message\.decision\.blocked\.0\.causes"):
        read_message(wrong, resumed=False)


def test_equal_answers_are_equal_whatever_else_came_with_them() -> None:
    one, other = (read_message({**TICK, "new": number}, resumed=False) for number in range(2))
    assert one == other
    assert one.raw != other.raw


def test_what_is_not_read_has_nothing_raw() -> None:
    assert answers.Parsed(text="", actions=(), source="grammar", corrections=()).raw == {}
    assert issubclass(Hello, Message)
