"""A key that stands twice in one object is refused, wherever it stands; nothing else is."""

from __future__ import annotations

import json
from typing import Any

import orjson
import pytest
from hypothesis import given
from hypothesis import strategies as st

from service.http.json import DuplicateKeyError, loads
from tests.support.service import Service


class Pairs(list[tuple[str, Any]]):
    """Members of an object, some perhaps under one key."""


TEXTS = st.text(alphabet='ab:\\"{}u03é ', max_size=5)
VALUES = st.recursive(
    st.none() | st.booleans() | st.integers(-5, 5) | TEXTS,
    lambda inner: st.lists(inner, max_size=3) | st.lists(st.tuples(TEXTS, inner), max_size=3).map(Pairs),
    max_leaves=12,
)


def written(value: Any, *, ascii_only: bool, colon: str) -> str:
    """As JSON; colons in strings as they are, or by number."""
    if isinstance(value, Pairs):
        members = (
            f"{written(key, ascii_only=ascii_only, colon=colon)} : "
            f"{written(each, ascii_only=ascii_only, colon=colon)}"
            for key, each in value
        )
        return "{" + ",".join(members) + "}"
    if isinstance(value, list):
        return "[" + ",".join(written(each, ascii_only=ascii_only, colon=colon) for each in value) + "]"
    said = json.dumps(value, ensure_ascii=ascii_only)
    return said.replace(":", colon) if isinstance(value, str) else said


def twice(value: Any) -> bool:
    if isinstance(value, Pairs):
        keys = [key for key, _ in value]
        return len(set(keys)) < len(keys) or any(twice(each) for _, each in value)
    return isinstance(value, list) and any(map(twice, value))


@given(VALUES, st.booleans(), st.sampled_from([":", "\\u003a", "\\u003A"]), st.booleans())
def test_two_members_of_one_key_are_refused_and_nothing_else(
    value: Any, ascii_only: bool, colon: str, as_bytes: bool
) -> None:
    text = written(value, ascii_only=ascii_only, colon=colon)
    given = text.encode() if as_bytes else text
    if twice(value):
        with pytest.raises(DuplicateKeyError, match="more than once"):
            loads(given)
    else:
        assert loads(given) == orjson.loads(text)


@pytest.mark.parametrize(
    "text",
    ['{"a":1,"a":1}', '{"a":1,"\\u0061":2}', '[{"b":{"a":[],"a":":"}}]', '{"a":"\\u003a","a":"::"}'],
)
def test_such_a_key_is_named(text: str) -> None:
    with pytest.raises(DuplicateKeyError, match='the key "a" stands in one object more than once'):
        loads(text)


def test_what_is_nested_deeply_is_read() -> None:
    for text in ("[" * 500 + "]" * 500, '{"a":' * 300 + "1" + "}" * 300):
        assert loads(text) == orjson.loads(text)
    with pytest.raises(json.JSONDecodeError):
        loads("[" * 100_000)


@pytest.mark.parametrize("path", ["commands", "actions", "ask", "forks", "step"])
async def test_nothing_is_done_by_a_body_that_says_two_things(service: Service, path: str) -> None:
    made = (await service.client.post("/api/v1/sessions", json={"seed": 3, "paused": True})).headers[
        "location"
    ]
    before = (await service.client.get(f"{made}/state")).text
    answer = await service.client.post(
        f"{made}/{path}",
        content=b'{"text":"add a pothole","text":"add two potholes"}',
        headers={"Content-Type": "application/json"},
    )
    assert answer.status_code == 400
    assert answer.json()["type"] == "/problems/malformed"
    assert answer.json()["detail"] == (
        'The body cannot be read as JSON: the key "text" stands in one object more than once.'
    )
    assert (await service.client.get(f"{made}/state")).text == before


async def test_a_new_session_and_a_config_say_each_thing_once(service: Service) -> None:
    headers = {"Content-Type": "application/json"}
    answer = await service.client.post(
        "/api/v1/sessions", content=b'{"config":{"rows":20,"rows":40}}', headers=headers
    )
    assert answer.status_code == 400
    assert '"rows"' in answer.json()["detail"]
    made = await service.session()
    answer = await service.client.patch(
        f"{made}/config", content=b'{"courtesy":0,"courtesy":1}', headers=headers
    )
    assert answer.status_code == 400
    assert '"courtesy"' in answer.json()["detail"]
