"""Which shard gets a request, by its path and its key alone."""

from __future__ import annotations

import pytest

from service.cluster.places import Place, Places
from service.cluster.routing import Several, route
from service.sharding import shard_of


@pytest.mark.parametrize("path", ["", "/state", "/stream", "/events/stream", "/nowhere"])
@pytest.mark.parametrize("kind", ["sessions", "evaluations", "answers"])
def test_all_of_a_session_is_in_one_shard(kind: str, path: str) -> None:
    for number in range(20):
        found = route("GET", f"/api/v1/{kind}/id-{number}{path}", None, 5)
        assert found == shard_of(f"id-{number}", 5)


def test_a_key_decides_only_where_no_session_does() -> None:
    assert route("POST", "/api/v1/sessions", "key", 5) == shard_of("key", 5)
    assert route("POST", "/api/v1/sessions/one/commands", "key", 5) == shard_of("one", 5)


@pytest.mark.parametrize(
    ("method", "path", "found"),
    [
        ("GET", "/api/v1/sessions", Several.ALL),
        ("HEAD", "/healthz", Several.ALL),
        ("GET", "/readyz", Several.ALL),
        ("GET", "/metrics", Several.ALL),
        ("DELETE", "/healthz", Several.ANY),
        ("POST", "/api/v1/sessions", Several.ANY),
        ("GET", "/api/v1/saved", Several.ANY),
        ("GET", "/", Several.ANY),
        ("GET", "/api/v1/sessionsx/one", Several.ANY),
    ],
)
def test_other_requests(method: str, path: str, found: Several) -> None:
    assert route(method, path, None, 3) is found


def test_new_sessions_take_turns_among_those_that_are_up() -> None:
    places = Places(3)
    assert places.any_up() in range(3)
    for number in (0, 2):
        places.set(number, Place("127.0.0.1", 1, 1, "1"))
    assert [places.any_up() for _ in range(6)].count(1) == 0
    assert {places.any_up() for _ in range(6)} == {0, 2}
