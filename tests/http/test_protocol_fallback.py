"""Where uvicorn lacks what the protocol classes need, the service runs on uvicorn's own."""

from __future__ import annotations

import httpx
import pytest
import uvicorn
from websockets.asyncio.client import connect

from service.app import create_app
from service.cli.serve import server_config
from service.http import protocol
from service.settings import Settings
from service.store import MemoryStore
from tests.support.fakes import FewSentences, HandClock
from tests.support.live_server import running

TABLES = ("HTTP_ATTRIBUTES", "CYCLE_ATTRIBUTES", "WEBSOCKET_ATTRIBUTES")


def test_this_uvicorn_has_all_that_is_needed() -> None:
    assert protocol.missing_attributes() == []
    assert set(protocol.protocol_options()) == {"http", "ws"}


@pytest.mark.parametrize("table", TABLES)
def test_an_attribute_that_is_missing_is_found(table: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(protocol, table, frozenset((*getattr(protocol, table), "no_such_attribute")))
    (missing,) = protocol.missing_attributes()
    assert missing.endswith(".no_such_attribute")
    assert protocol.protocol_options() == protocol.FALLBACK


def test_a_class_that_has_gone_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "uvicorn.protocols.http.httptools_impl", None)
    assert protocol.protocol_options() == protocol.FALLBACK


async def test_without_them_everything_is_served(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(protocol, "HTTP_ATTRIBUTES", frozenset(("no_such_attribute",)))
    settings = Settings(database="memory:")
    app = create_app(settings, store=MemoryStore(), language=FewSentences(), clock=HandClock())
    config = server_config(app, settings)
    assert isinstance(config, uvicorn.Config)
    assert config.http == "h11"
    async with running(app, settings) as at, httpx.AsyncClient(base_url=at.http, timeout=60) as client:
        path = (await client.post("/api/v1/sessions", json={"seed": 7})).headers["location"]
        assert (await client.get(f"{path}/state")).json()["tick"] == 0
        async with connect(f"{at.ws}{path}/stream") as socket:
            assert '"hello"' in str(await socket.recv())
            await socket.send('{"type": "command", "id": "1", "text": "add two cars"}')
            while '"result"' not in str(await socket.recv()):
                pass
