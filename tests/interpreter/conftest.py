"""Talking to the whole service in English as it is, over REST; the clock is moved by hand."""

from __future__ import annotations

from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import AsyncExitStack
from functools import cache
from typing import Any

import httpx
import pytest

from service.app import create_app
from service.grammar import Language
from service.grammar.topic import Topic
from service.llm import LanguageModel
from service.sessions.availability import refusal_of
from service.settings import Settings
from service.store import MemoryStore, Store
from tests.support.fakes import HandClock

Json = dict[str, Any]


@cache
def english() -> Language:
    """The language, read once: it is immutable."""
    return Language.load("en", offered=lambda action: refusal_of(action) is None)


class Talk:
    """A service, and one session of it that is talked to."""

    def __init__(self, client: httpx.AsyncClient, app: Any, stack: AsyncExitStack, path: str = "") -> None:
        self.client = client
        self.app = app
        self.path = path
        self._stack = stack

    async def stop(self) -> None:
        """End the service, as for a restart."""
        await self._stack.aclose()

    async def begin(self, **config: Any) -> Talk:
        """Another session of the same service, the same road each time."""
        answer = await self.client.post("/api/v1/sessions", json={"seed": 7, "paused": True, **config})
        assert answer.status_code == 201, answer.text
        return Talk(self.client, self.app, self._stack, answer.headers["location"])

    async def post(self, text: str, **more: Any) -> httpx.Response:
        return await self.client.post(f"{self.path}/commands", json={"text": text, **more})

    async def say(self, text: str, **more: Any) -> Json:
        """Something that is done."""
        answer = await self.post(text, **more)
        assert answer.status_code == 200, (text, answer.text)
        return answer.json()  # type: ignore[no-any-return]

    async def refused(self, text: str, slug: str = "not-understood", **more: Any) -> Json:
        """Something that is refused, and changes nothing."""
        before = await self.state()
        answer = await self.post(text, **more)
        problem: Json = answer.json()
        assert problem.get("type") == f"/problems/{slug}", (text, answer.text)
        assert await self.state() == before
        return problem

    async def act(self, *actions: Json) -> httpx.Response:
        return await self.client.post(f"{self.path}/actions", json={"actions": actions})

    async def state(self) -> Json:
        return (await self.client.get(f"{self.path}/state")).json()  # type: ignore[no-any-return]

    async def ids(self) -> set[str]:
        """Everything on the road but the vehicle."""
        state = await self.state()
        return {thing["id"] for thing in (*state["movers"], *state["hazards"])}

    async def guide(self, **query: str) -> Json:
        answer = await self.client.get("/api/v1/language", params=query)
        assert answer.status_code == 200, answer.text
        return answer.json()  # type: ignore[no-any-return]

    async def completions(self, prefix: str) -> list[str]:
        guide = await self.guide(prefix=prefix, session=self.id)
        return guide["completions"]  # type: ignore[no-any-return]

    @property
    def id(self) -> str:
        return self.path.rsplit("/", 1)[1]

    @property
    def topic(self) -> Topic:
        """What a sentence said now may refer to."""
        context = self.app.state.context
        return context.interpreter.topic(context.manager.live_sessions[self.id])  # type: ignore[no-any-return]


Opening = Callable[..., Awaitable[Talk]]


@pytest.fixture
async def opening() -> AsyncIterator[Opening]:
    """Opens services, each with a session; closed at the end."""
    async with AsyncExitStack() as stack:

        async def open_one(
            store: Store | None = None,
            model: LanguageModel | None = None,
            settings: Settings | None = None,
            *,
            every_language: bool = False,
            **config: Any,
        ) -> Talk:
            app = create_app(
                settings or Settings(database="memory:"),
                store=store or MemoryStore(),
                language=None if every_language else english(),
                clock=HandClock(),
                model=model,
            )
            own = await stack.enter_async_context(AsyncExitStack())
            await own.enter_async_context(app.router.lifespan_context(app))
            transport = httpx.ASGITransport(app)
            client = await own.enter_async_context(
                httpx.AsyncClient(transport=transport, base_url="http://service")
            )
            return await Talk(client, app, own).begin(**config)

        yield open_one


@pytest.fixture
async def talk(opening: Opening) -> Talk:
    """A service and a session of it."""
    return await opening()
