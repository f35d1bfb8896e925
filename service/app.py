"""The one place where the parts of the service are chosen and bound together.

Everything that can be another thing (store, language, words, clock) comes in here, with a real
default that needs no server. Nothing else constructs them.
"""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from functools import partial

from anyio import CapacityLimiter
from fastapi import FastAPI
from fastapi.routing import APIRoute

from service.http import errors, openapi
from service.http import not_found as nearby
from service.http.conditional.idempotency import Answers
from service.http.deps import Context
from service.http.middleware import access_control as gate
from service.http.middleware import body_limit as edges
from service.http.middleware import head_method as bodiless
from service.http.middleware import hot_routes as plainly
from service.http.middleware import metrics
from service.http.middleware import state_cache as glance
from service.http.realtime import sse
from service.http.realtime import websocket as stream
from service.http.routes import (
    advice,
    commands,
    config,
    counterfactual,
    forks,
    health,
    links,
    pages,
    parse,
    sessions,
    timeline,
)
from service.http.routes import forecast as insight
from service.http.routes import frame as frames
from service.http.routes import language as language_route
from service.http.routes import state as watching
from service.http.routes import video as film
from service.http.routes import ws_tickets as tickets
from service.http.session_json import PREFIX
from service.interpreter.aliases import Phrasebook
from service.interpreter.interpreter import Listener
from service.interpreter.languages import Language, Languages
from service.llm import LanguageModel, configured
from service.log_format import RequestIds
from service.narration import Narrator
from service.resources import DEFAULT_LANGUAGE
from service.security.guard import Guard
from service.sessions.manager import SessionManager
from service.sessions.narrator_protocol import Words
from service.sessions.scheduler.clock import Clock, WheelClock
from service.sessions.session import Surroundings
from service.settings import Settings
from service.shutdown import STOP_S, within
from service.store import Store, open_store
from service.version import VERSION
from sim.plan.sandbox.client import without_waiting

_DESCRIPTION = """
A vehicle that drives itself along a road of obstacles and potholes, live; changed and questioned in
plain words.

Everything the page does is a call documented here. Errors are problems (RFC 9457). A session is also
a stream: open a WebSocket on `/api/v1/sessions/{id}/stream`; it sends `hello`, then `tick` and
`changed` messages, and takes `{"type": "command", "id": "1", "text": "add five potholes"}`.

HEAD answers as GET does, without the body. A parameter in the URL that a call does not have is refused.
"""


def create_app(
    settings: Settings | None = None,
    *,
    store: Store | None = None,
    language: Language | None = None,
    words: Words | None = None,
    clock: Clock | None = None,
    model: LanguageModel | None = None,
) -> FastAPI:
    """The service. Whatever is not given is what the settings name, or the default.

    Raises `StoreError` for a database URL of no known kind, `LanguageDataError` for broken words,
    `MissingExtraError` where a language model is named and the extra for it is missing.
    """
    settings = settings or Settings()
    counted = metrics.Metrics()
    store = metrics.timed(store or open_store(settings.database), counted.store)
    clock = clock or WheelClock(late=counted.lateness.observe)
    guard = Guard(settings)
    words = words or Narrator.load()
    model = model or configured(settings)
    manager = SessionManager(Surroundings(store, clock, words, settings))
    languages = Languages.load() if language is None else Languages({DEFAULT_LANGUAGE: language})
    phrasebook = Phrasebook(store, languages)
    listener = Listener(
        languages,
        phrasebook,
        words,
        most_chars=settings.max_text_chars,
        model=model,
        confirm=settings.llm_confirm,
        rephrase=settings.llm_rephrase,
    )
    context = Context(settings, store, clock, listener, words, manager, CapacityLimiter(1), Answers(store))

    async def closed(sleeper: asyncio.Task[None]) -> None:
        await asyncio.wait([sleeper])
        await manager.close()
        if model is not None:
            await model.aclose()
        await store.close()

    @asynccontextmanager
    async def lifespan(_: FastAPI) -> AsyncIterator[None]:
        await store.open()
        await manager.open()
        await phrasebook.open()
        await context.answers.open()
        clock.start()
        sleeper = asyncio.create_task(manager.sleeper().run())
        try:
            with without_waiting():
                yield
        finally:
            sleeper.cancel()
            clock.stop()
            await within(STOP_S, closed(sleeper))

    app = FastAPI(
        title="Roadtalk",
        version=VERSION,
        description=_DESCRIPTION,
        lifespan=lifespan,
        docs_url=None,
        redoc_url=None,
        redirect_slashes=False,
        generate_unique_id_function=_operation_id,
    )
    app.state.context = context
    app.state.readers = sse.Readers()
    app.state.guard = guard
    app.state.metrics = counted
    app.add_middleware(glance.Glance, manager=manager)
    app.add_middleware(plainly.Plainly, routes=commands.router.routes)
    app.add_middleware(edges.BodyLimit, most=partial(_body_bytes, settings))
    app.add_middleware(gate.Gate, guard=guard)
    app.add_middleware(edges.SecurityHeaders)
    app.add_middleware(metrics.Counted, metrics=counted)
    app.add_middleware(bodiless.Bodiless)
    app.add_middleware(RequestIds)
    errors.install(app)
    app.state.addresses = addresses = nearby.Addresses()
    for resource in (
        sessions,
        commands,
        config,
        watching,
        frames,
        film,
        parse,
        advice,
        language_route,
        stream,
        sse,
        tickets,
        forks,
        links,
        timeline,
        insight,
        counterfactual,
    ):
        app.include_router(resource.router, prefix=PREFIX)
        addresses.add(resource.router, PREFIX)
    for at_root in (health, metrics):
        app.include_router(at_root.router)
        addresses.add(at_root.router)
    openapi.install(app)
    pages.install(app)
    app.router.default = nearby.told_sockets(app.router.default)
    return app


def _operation_id(route: APIRoute) -> str:
    """Names for generated clients: `sessions_make`, `talking_say`."""
    return f"{route.tags[0]}_{route.name}"


def _body_bytes(settings: Settings, path: str) -> int:
    """How large a body may be: a new session may come with a recording."""
    return settings.max_recording_bytes if path == f"{PREFIX}/sessions" else settings.max_body_bytes
