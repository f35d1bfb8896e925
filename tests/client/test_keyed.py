"""A service with a key: by argument or from the environment, over REST, socket, events and tickets."""

from __future__ import annotations

import json
from collections.abc import Iterator

import pytest
from websockets.sync.client import connect

from service.client import AsyncClient, Client, Hello, NotAllowed
from service.client.call import KEY_VARIABLE
from tests.support.service_process import ServiceProcess

KEY = "open-sesame"


@pytest.fixture(scope="module")
def keyed(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ServiceProcess]:
    service = ServiceProcess(tmp_path_factory.mktemp("keyed") / "roadtalk.db")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(KEY_VARIABLE, KEY)
        service.start()
    yield service
    service.kill()


def test_with_the_key_everything_is_open(keyed: ServiceProcess) -> None:
    with Client(keyed.url, api_key=KEY) as client:
        session = client.create(seed=11, paused=True)
        assert isinstance(next(session.watch()), Hello)
        assert isinstance(next(session.follow()), Hello)
        assert next(session.pictures(side=64)).tick == 0
        assert session.film(side=64).media_type == "image/gif"


def test_the_key_is_found_in_the_environment(keyed: ServiceProcess, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(KEY_VARIABLE, KEY)
    with Client(keyed.url) as client:
        assert isinstance(next(client.create(seed=11, paused=True).watch()), Hello)
    with Client(keyed.url, api_key="another") as client, pytest.raises(NotAllowed):
        client.list()
    with Client(keyed.url, api_key="") as client, pytest.raises(NotAllowed):
        client.list()


@pytest.mark.parametrize("key", ["", "another"])
def test_without_the_key_nothing_is_told(keyed: ServiceProcess, key: str) -> None:
    with Client(keyed.url, api_key=KEY) as owner:
        name = owner.create(seed=11, paused=True).id
    with Client(keyed.url, api_key=key) as client:
        session = client.session(name)
        assert client.health().status == "ok"
        for attempt in (session.info, session.step, client.ticket, lambda: next(session.follow())):
            with pytest.raises(NotAllowed):
                attempt()
    with Client(keyed.url, api_key="another") as client, pytest.raises(NotAllowed, match="key"):
        next(client.session(name).watch())


async def test_the_same_awaited(keyed: ServiceProcess) -> None:
    async with AsyncClient(keyed.url, api_key=KEY) as client:
        session = await client.create(seed=11, paused=True)
        assert isinstance(await anext(session.watch()), Hello)
        assert isinstance(await anext(session.follow()), Hello)
    async with AsyncClient(keyed.url, api_key="another") as client:
        with pytest.raises(NotAllowed):
            await client.list()
        with pytest.raises(NotAllowed):
            await anext(client.session(session.id).watch())


def test_a_ticket_lets_one_socket_in(keyed: ServiceProcess) -> None:
    with Client(keyed.url, api_key=KEY) as client:
        session, ticket = client.create(seed=11, paused=True), client.ticket()
    address = f"{keyed.url.replace('http', 'ws', 1)}/api/v1/sessions/{session.id}/stream"
    first = json.dumps({"type": "auth", "ticket": ticket.ticket})
    assert ticket.ticket not in repr(ticket)
    with connect(address) as socket:
        socket.send(first)
        assert json.loads(socket.recv())["type"] == "hello"
    with connect(address) as socket:
        socket.send(first)
        with pytest.raises(Exception, match="4401"):
            socket.recv()
