"""Whole conversations, turn by turn: what each turn does, asks or refuses, and that a replay ends the same.

They are data (`tests/data/conversations`): a turn says something and `does` actions, `asks` a question or
`refuses` with a kind of problem; `why` is for readers.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from service.store import MemoryStore
from service.yaml_files import read_yaml
from tests.interpreter.conftest import Opening

FOLDER = Path(__file__).parents[1] / "data" / "conversations"
CONVERSATIONS: dict[str, Any] = {path.stem: read_yaml(path) for path in sorted(FOLDER.glob("*.yaml"))}

DURABLE = ("digest", "tick", "playback_speed", "undo", "redo", "config")


@pytest.mark.parametrize("name", CONVERSATIONS)
async def test_every_turn_is_right_and_a_replay_ends_in_the_same_state(opening: Opening, name: str) -> None:
    conversation, store = CONVERSATIONS[name], MemoryStore()
    language = conversation["language"]
    talk = await opening(store=store, every_language=language != "en", language=language)
    for turn in conversation["turns"]:
        before = (await talk.state())["digest"]
        answer = await talk.post(turn["say"])
        told = answer.json()
        if "does" in turn:
            assert answer.status_code == 200, (turn, told)
            assert told["actions"] == turn["does"], turn
            continue
        assert answer.status_code in (409, 422), (turn, told)
        assert (await talk.state())["digest"] == before
        if "asks" in turn:
            assert (told["type"], told["detail"]) == ("/problems/ambiguous", turn["asks"])
            session = (await talk.client.get(talk.path)).json()
            assert session["pending"] == told["pending"]
        else:
            assert told["type"] == f"/problems/{turn['refuses']}", (turn, told)
    end, spoken = await talk.state(), talk.topic
    await talk.stop()
    again = await opening(store=store, every_language=language != "en")
    again.path = talk.path
    restored = await again.state()
    assert {key: restored.get(key) for key in DURABLE} == {key: end.get(key) for key in DURABLE}
    session = (await again.client.get(again.path)).json()
    assert session["pending"] is None
    for part in ("added", "kind", "removed", "where"):
        assert getattr(again.topic, part) == getattr(spoken, part), part


def test_there_are_conversations_of_each_kind() -> None:
    turns = [turn for each in CONVERSATIONS.values() for turn in each["turns"]]
    assert len(CONVERSATIONS) >= 20
    for kind in ("does", "asks", "refuses"):
        assert sum(kind in turn for turn in turns) >= 10
