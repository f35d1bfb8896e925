"""The service inside the test, and a service that is a process of its own."""

from __future__ import annotations

from collections.abc import AsyncIterator, Iterator
from pathlib import Path

import httpx
import pytest

from service.app import create_app
from service.client import AsyncClient, Client
from service.settings import Settings
from service.store import MemoryStore
from tests.support.fakes import HandClock
from tests.support.service_process import ServiceProcess


@pytest.fixture
async def inside() -> AsyncIterator[AsyncClient]:
    """A client of a service that lives in this test and whose clock stands still."""
    app = create_app(Settings(database="memory:"), store=MemoryStore(), clock=HandClock())
    async with (
        app.router.lifespan_context(app),
        AsyncClient("http://service", transport=httpx.ASGITransport(app)) as client,
    ):
        yield client


@pytest.hookimpl(tryfirst=True)  # before every other test gets its file's group
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """In one worker, with one service."""
    here = Path(__file__).parent
    for item in items:
        if here in item.path.parents:
            item.add_marker(pytest.mark.xdist_group("client"))


@pytest.fixture(scope="session")
def process(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ServiceProcess]:
    """One for all tests that do not end it."""
    service = ServiceProcess(tmp_path_factory.mktemp("service") / "roadtalk.db")
    service.start()
    yield service
    service.kill()


@pytest.fixture
def client(process: ServiceProcess) -> Iterator[Client]:
    """A client of the process."""
    with Client(process.url) as made:
        yield made
