"""Strangers: what each of them tries, and that it gets nothing and changes nothing."""

from __future__ import annotations

import asyncio
import json
import re
from collections.abc import AsyncIterator
from typing import Any

import httpx
import pytest
from pydantic import SecretStr
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed, InvalidStatus

from service.app import create_app
from service.problems import QuotaExceeded, TooManyWrongKeys
from service.security.api_key import Key
from service.security.cross_site import same_site
from service.security.guard import WRONG_KEYS_PER_MINUTE, Guard, exposure_problem
from service.security.hosts import Hosts, is_loopback
from service.security.quotas import Quotas
from service.security.rate_limit import MAX_CLIENTS, RateLimiter
from service.security.ws_tickets import GOOD_FOR_S, MOST, Tickets
from service.settings import Settings
from service.store import MemoryStore
from tests.support.fakes import FewSentences, HandClock
from tests.support.live_server import Running, running
from tests.support.strangers import BEARER, KEY, SESSIONS, asked, assert_refused

# Keys


@pytest.mark.parametrize(
    "headers",
    [
        {},
        {"Authorization": ""},
        {"Authorization": "Bearer"},
        {"Authorization": "Bearer wrong"},
        {"Authorization": f"Basic {KEY}"},
        {"Authorization": KEY},
        {"Authorization": f"Bearer {KEY}x"},
        {"Authorization": f"Bearer {KEY[:-1]}"},
        {"Authorization": f"Bearer {KEY.upper()}"},
        {"Authorization": b"Bearer \xff\xfe"},
        {"X-Api-Key": KEY},
        {"Cookie": f"key={KEY}"},
    ],
)
async def test_no_key_and_wrong_keys_get_nothing(headers: dict[str, Any]) -> None:
    async with asked(api_key=KEY) as client:
        for method, path in (
            ("GET", SESSIONS),
            ("POST", SESSIONS),
            ("GET", "/metrics"),
            ("POST", "/api/v1/tickets"),
        ):
            body = {} if method == "POST" else None
            answer = await client.request(method, path, json=body, headers=headers, params={"key": KEY})
            assert_refused(answer, 401, "key-needed")
            assert answer.headers["www-authenticate"] == "Bearer"
            assert KEY not in answer.text
        assert (await client.get(SESSIONS, headers=BEARER)).json()["items"] == []


async def test_who_tries_keys_is_slowed_and_others_are_not() -> None:
    async with asked(api_key=KEY) as client:
        for _ in range(WRONG_KEYS_PER_MINUTE):
            wrong = await client.get(SESSIONS, headers={"Authorization": "Bearer wrong"})
            assert_refused(wrong, 401, "key-needed")
        slowed = await client.get(SESSIONS, headers=BEARER)
        assert_refused(slowed, 429, "too-many-wrong-keys")
        assert 1 <= int(slowed.headers["retry-after"]) <= 2
    guard = Guard(Settings(api_key=SecretStr(KEY)))
    for _ in range(WRONG_KEYS_PER_MINUTE):
        assert not guard.matches("10.0.0.1", "wrong")
    with pytest.raises(TooManyWrongKeys):
        guard.matches("10.0.0.1", KEY)
    assert guard.matches("10.0.0.2", KEY)


async def test_asking_without_a_key_is_no_try() -> None:
    async with asked(api_key=KEY) as client:
        for _ in range(WRONG_KEYS_PER_MINUTE + 5):
            assert_refused(await client.get(SESSIONS), 401, "key-needed")
        assert (await client.get(SESSIONS, headers=BEARER)).status_code == 200


async def test_the_key_lets_in_and_what_tells_nothing_is_open() -> None:
    async with asked(api_key=KEY) as client:
        assert (await client.post(SESSIONS, json={}, headers=BEARER)).status_code == 201
        for path in ("/", "/docs", "/healthz", "/readyz"):
            assert (await client.get(path)).status_code == 200, path


async def test_without_a_key_none_is_asked_for() -> None:
    async with asked() as client:
        assert (await client.post(SESSIONS, json={})).status_code == 201


def test_no_key_is_every_key_and_an_empty_one_is_none() -> None:
    assert not Key(None).required
    assert not Key(SecretStr("")).required
    assert Key(SecretStr("é")).matches("é")
    assert not Key(SecretStr("é")).matches("e")


@pytest.mark.parametrize(
    ("host", "key", "refused"),
    [
        ("127.0.0.1", None, False),
        ("127.8.8.8", None, False),
        ("::1", None, False),
        ("localhost", None, False),
        ("0.0.0.0", None, True),
        ("::", None, True),
        ("192.168.1.2", None, True),
        ("road.example", None, True),
        ("127.0.0.1.example", None, True),
        ("0.0.0.0", "", True),
        ("0.0.0.0", KEY[:15], True),
        ("127.0.0.1", "x", False),
        ("0.0.0.0", KEY, False),
    ],
)
def test_strangers_are_not_let_near_without_a_key(host: str, key: str | None, refused: bool) -> None:
    said = exposure_problem(Settings(host=host, api_key=None if key is None else SecretStr(key)))
    assert (said is not None) == refused
    if said is not None:
        assert "ROADTALK_API_KEY" in said
        assert "\n" not in said
    assert is_loopback(host) == (host in ("127.0.0.1", "127.8.8.8", "::1", "localhost"))


# Hosts and pages


@pytest.mark.parametrize(
    "host",
    [
        "evil.example",
        "evil.example:8000",
        "127.0.0.1.evil.example",
        "localhost.evil.example",
        "127.0.0.1@evil",
        "",
        "x y",
        "[::1",
        "127.0.0.1:port",
        "127.0.0.1/evil",
        "0.0.0.0",
    ],
)
@pytest.mark.parametrize("path", ["/", "/docs", SESSIONS, "/metrics", "/healthz"])
async def test_a_rebinding_host_is_refused(host: str, path: str) -> None:
    async with asked() as client:
        assert_refused(await client.get(path, headers={"Host": host}), 421, "foreign-host")


@pytest.mark.parametrize(
    "host", ["127.0.0.1", "127.0.0.1:8000", "localhost:1", "LOCALHOST", "[::1]:80", "road.example"]
)
async def test_names_that_are_ours(host: str) -> None:
    async with asked(allowed_hosts=" road.example, other.example") as client:
        assert (await client.get(SESSIONS, headers={"Host": host})).status_code == 200


def test_the_address_a_connection_came_in_at_is_ours() -> None:
    scope = {"server": ("192.168.1.2", 8000)}
    assert Hosts("").answers_to("192.168.1.2:8000", scope)
    assert not Hosts("").answers_to("192.168.1.3:8000", scope)


@pytest.mark.parametrize(
    "origin",
    ["http://evil.example", "null", "http://127.0.0.1.evil.example", "http://127.0.0.1:9", "", "http://["],
)
async def test_pages_of_other_sites_change_nothing(origin: str) -> None:
    async with asked() as client:
        path = (await client.post(SESSIONS, json={"seed": 1})).headers["location"]
        before = (await client.get(f"{path}/state")).json()
        said = {"Origin": origin}
        assert_refused(await client.post(SESSIONS, json={}, headers=said), 403, "cross-site")
        assert_refused(await client.delete(path, headers=said), 403, "cross-site")
        spoken = await client.post(f"{path}/commands", json={"text": "add two cars"}, headers=said)
        assert_refused(spoken, 403, "cross-site")
        assert (await client.get(f"{path}/state")).json() == before
        assert len((await client.get(SESSIONS)).json()["items"]) == 1
    assert not same_site(origin, "127.0.0.1")


async def test_our_own_page_may() -> None:
    async with asked() as client:
        assert (
            await client.post(SESSIONS, json={}, headers={"Origin": "http://127.0.0.1"})
        ).status_code == 201


FOREIGN = (
    {"Sec-Fetch-Site": "cross-site"},
    {"Sec-Fetch-Site": "same-site"},
    {"Sec-Fetch-Site": "Cross-Site", "Sec-Fetch-Mode": "no-cors", "Sec-Fetch-Dest": "image"},
    {"Sec-Fetch-Site": "cross-site", "Sec-Fetch-Mode": "navigate", "Sec-Fetch-Dest": "document"},
    {"Origin": "http://evil.example"},
    {"Origin": "http://127.0.0.1:9", "Sec-Fetch-Site": "same-site"},
    {"Origin": "null"},
)
OWN: tuple[dict[str, str], ...] = (
    {},
    {"Sec-Fetch-Site": "same-origin", "Sec-Fetch-Mode": "cors"},
    {"Sec-Fetch-Site": "none", "Sec-Fetch-Mode": "navigate"},
    {"Origin": "http://127.0.0.1", "Sec-Fetch-Site": "same-origin"},
)
OPEN = ("/healthz", "/readyz")


@pytest.mark.parametrize("headers", FOREIGN)
async def test_pages_of_other_sites_have_nothing_asked(headers: dict[str, str]) -> None:
    async with asked() as client:
        document = (await client.get("/openapi.json")).json()["paths"]
        asking = {path: item["get"] for path, item in document.items() if "get" in item}
        assert len(asking) > 20
        for path, operation in asking.items():
            # No such session: whatever is let in is answered at once, streams too.
            url = re.sub(r"\{[^}]*\}", "none", path)
            answer = await client.get(url, headers=headers)
            if path in OPEN:
                assert answer.status_code == 200, path
                assert "403" not in operation["responses"], path
                continue
            assert_refused(answer, 403, "cross-site")
            assert "403" in operation["responses"], path
            assert (await client.head(url, headers=headers)).status_code == 403, path


@pytest.mark.parametrize("headers", OWN)
async def test_our_own_page_scripts_and_whoever_types_may_ask(headers: dict[str, str]) -> None:
    async with asked() as client:
        document = (await client.get("/openapi.json")).json()["paths"]
        for path in (path for path, item in document.items() if "get" in item):
            answer = await client.get(re.sub(r"\{[^}]*\}", "none", path), headers=headers)
            assert answer.status_code in (200, 404, 422), path


async def test_links_from_anywhere_lead_to_the_page() -> None:
    link = {"Sec-Fetch-Site": "cross-site", "Sec-Fetch-Mode": "navigate", "Sec-Fetch-Dest": "document"}
    async with asked() as client:
        for path in ("/", "/?session=1&tick=3", "/docs"):
            assert (await client.get(path, headers=link)).status_code == 200, path


# Sockets


@pytest.fixture
async def keyed() -> AsyncIterator[tuple[Running, httpx.AsyncClient, str]]:
    settings = Settings(database="memory:", api_key=SecretStr(KEY))
    app = create_app(settings, store=MemoryStore(), language=FewSentences(), clock=HandClock())
    async with (
        running(app, settings) as service,
        httpx.AsyncClient(base_url=service.http, headers=BEARER, timeout=60) as client,
    ):
        made = await client.post(SESSIONS, json={"seed": 1})
        yield service, client, f"{service.ws}{made.headers['location']}/stream"


async def first(url: str, *messages: object, **more: Any) -> str:
    """The type of what a socket is told first, or the code it is closed with."""
    async with connect(url, **more) as socket:
        for message in messages:
            await socket.send(json.dumps(message))
        try:
            return str(json.loads(await asyncio.wait_for(socket.recv(), 60))["type"])
        except ConnectionClosed as closed:
            return str(closed.rcvd.code if closed.rcvd else None)


async def test_a_socket_says_who_it_is(keyed: tuple[Running, httpx.AsyncClient, str]) -> None:
    _, client, url = keyed
    assert await first(url, {"type": "auth", "key": KEY}) == "hello"
    assert await first(url, additional_headers=BEARER) == "hello"
    answer = await client.post("/api/v1/tickets", json={})
    assert answer.headers["cache-control"] == "no-store"
    ticket = {"type": "auth", "ticket": answer.json()["ticket"]}
    assert await first(url, ticket) == "hello"
    assert await first(url, ticket) == "4401", "a ticket is good once"


@pytest.mark.parametrize(
    "message",
    [
        {"type": "auth"},
        {"type": "auth", "key": "wrong"},
        {"type": "auth", "key": None, "ticket": "wrong"},
        {"type": "auth", "key": KEY, "more": 1},
        {"type": "auth", "key": [KEY]},
        {"type": "command", "id": "1", "text": "add two cars"},
        {"type": "ping"},
        [],
        None,
    ],
)
async def test_sockets_without_a_key_hear_nothing(
    keyed: tuple[Running, httpx.AsyncClient, str], message: object
) -> None:
    _, client, url = keyed
    before = (await client.get(url.replace("ws://", "http://").replace("/stream", "/state"))).json()
    assert await first(f"{url}?key={KEY}&ticket={KEY}", message) == "4401"
    assert (await client.get(url.replace("ws://", "http://").replace("/stream", "/state"))).json() == before


@pytest.mark.parametrize(
    ("headers", "status"), [({"Origin": "http://evil.example"}, 403), ({"Host": "evil.example"}, 421)]
)
async def test_a_cross_site_or_rebound_socket_does_not_open(
    keyed: tuple[Running, httpx.AsyncClient, str], headers: dict[str, str], status: int
) -> None:
    service, _, url = keyed
    name, value = next(iter(headers.items()))
    if name == "Origin":
        with pytest.raises(InvalidStatus) as refused:
            await first(url, origin=value, additional_headers=BEARER)
    else:
        # The name is the other site's, the address is this machine's: that is what rebinding does.
        with pytest.raises(InvalidStatus) as refused:
            await first(
                url.replace("127.0.0.1", value),
                host="127.0.0.1",
                port=service.port,
                additional_headers=BEARER,
            )
    assert refused.value.response.status_code == status


def test_tickets_grow_old_and_are_not_hoarded() -> None:
    now = [0.0]
    tickets = Tickets(lambda: now[0])
    old, oldest = tickets.issue(), tickets.issue()
    assert tickets.take(old)
    now[0] = GOOD_FOR_S
    assert not tickets.take(oldest)
    kept = tickets.issue()
    for _ in range(MOST):
        newest = tickets.issue()
    assert (tickets.take(kept), tickets.take(newest)) == (False, True)


# How much, how often


async def test_who_changes_too_often_is_told_when_to_try_again() -> None:
    async with asked(changes_per_minute=3) as client:
        path = (await client.post(SESSIONS, json={"seed": 1})).headers["location"]
        for _ in range(2):
            assert (await client.post(f"{path}/step", json={"ticks": 1})).status_code == 200
        refused = await client.post(f"{path}/step", json={"ticks": 1})
        assert_refused(refused, 429, "too-many-changes")
        assert 1 <= int(refused.headers["retry-after"]) <= 20
        assert (await client.get(f"{path}/state")).json()["tick"] == 2


@pytest.mark.parametrize(("proxies", "last"), [(None, 429), ("10.0.0.1", 429), ("127.0.0.1", 200)])
async def test_whom_a_request_is_from_is_told_by_named_proxies_only(proxies: str | None, last: int) -> None:
    settings = Settings(changes_per_minute=2, trusted_proxies=proxies)
    app = create_app(settings, store=MemoryStore())
    async with running(app, settings) as at, httpx.AsyncClient(base_url=at.http, timeout=60) as client:
        path = (await client.post(SESSIONS, json={"seed": 1})).headers["location"]
        for number in range(3):
            said = {"X-Forwarded-For": f"203.0.113.{number}"}
            answer = await client.post(f"{path}/step", json={"ticks": 1}, headers=said)
        assert answer.status_code == last


def test_each_client_has_a_bucket_and_few_are_remembered() -> None:
    now = [0.0]
    buckets = RateLimiter(2, lambda: now[0])
    assert [buckets.take("a") for _ in range(3)] == [0, 0, 30]
    assert buckets.take("b") == 0
    now[0] = 30.0
    assert [buckets.take("a") for _ in range(2)] == [0, 30]
    for number in range(MAX_CLIENTS):
        buckets.take(str(number))
    assert buckets.take("a") == 0, "forgotten"
    assert RateLimiter(None).take("a") == 0


async def test_one_client_has_so_many_sessions_and_so_much_road() -> None:
    async with asked(max_client_sessions=2) as client:
        paths = [(await client.post(SESSIONS, json={})).headers["location"] for _ in range(2)]
        assert_refused(await client.post(SESSIONS, json={}), 429, "over-quota")
        assert (await client.delete(paths[0])).status_code == 204
        assert (await client.post(SESSIONS, json={"seed": -1})).status_code == 422
        assert (await client.post(SESSIONS, json={})).status_code == 201
    async with asked(max_client_cells=100) as client:
        road = {"config": {"rows": 30, "columns": 6}}
        assert (await client.post(SESSIONS, json=road)).status_code == 201
        assert_refused(await client.post(SESSIONS, json=road), 429, "over-quota")


def test_quotas_count_what_is_being_made() -> None:
    quotas = Quotas(1, None)
    with quotas.reserve("a"):
        with pytest.raises(QuotaExceeded, match="sessions"), quotas.reserve("a"):
            pass
        with quotas.reserve("b"):
            pass
    with quotas.reserve("a") as reservation:
        reservation.use("x", 5)
    with pytest.raises(QuotaExceeded), quotas.reserve("a"):
        pass
    quotas.release("nobody's")
    quotas.release("x")
    with quotas.reserve("a"):
        pass
