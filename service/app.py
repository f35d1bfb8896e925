"""The one place where the parts of the service are chosen and bound together.

Everything that can be another thing (store, language, words, clock) comes in here, with a real
default that needs no server. Nothing else constructs them.
"""

from __future__ import annotations

import asyncio
import os
from collections.abc import AsyncIterator, Callable
from contextlib import AbstractAsyncContextManager, asynccontextmanager
from typing import Any

from fastapi import FastAPI
from starlette.routing import BaseRoute

from service.evaluations.announce import announcer
from service.evaluations.kinds import EvaluationJobs, FindWorstJobs
from service.http import errors, openapi
from service.http.conditional.answers import KeptAnswers
from service.http.deps import Context
from service.http.metrics import Metrics, time_store
from service.http.middleware.cross_site import CrossSiteCheck
from service.http.middleware.direct_routes import DirectRoutes
from service.http.middleware.head_method import HeadMethod
from service.http.middleware.host_check import HostCheck
from service.http.middleware.request_id import RequestId
from service.http.middleware.security_headers import SecurityHeaders
from service.http.not_found import NO_WEBSOCKET
from service.http.realtime import sse, websocket
from service.http.routes import (
    advice,
    backup,
    bookmarks,
    changes,
    commands,
    config,
    counterfactual,
    create_session,
    decisions,
    docs,
    evaluations,
    events,
    forecast,
    forks,
    frame,
    guide,
    health,
    links,
    long_answers,
    metrics,
    moments,
    pages,
    parse,
    percept,
    questions,
    recording,
    regret,
    rewind,
    sessions,
    state,
    step,
    timeline,
    video,
    ws_tickets,
)
from service.http.routes import language as language_route
from service.interpreter.aliases import Aliases
from service.interpreter.interpreter import Interpreter
from service.interpreter.languages import Language, Languages
from service.jobs import JobRunner
from service.llm import LanguageModel, create_model
from service.narration import Narrator
from service.resources import DEFAULT_LANGUAGE
from service.security.guard import Guard
from service.sessions.manager import SessionManager
from service.sessions.narrator_protocol import NarratorProtocol
from service.sessions.persistence.retention import Retention
from service.sessions.scheduler.clock import Clock
from service.sessions.scheduler.wheel_clock import WheelClock
from service.sessions.services import SessionServices
from service.settings import Settings
from service.sharding import SINGLE, Shard
from service.shutdown import STOP_S, within
from service.store import Store, open_store
from service.version import VERSION
from service.work.long_answers import LongAnswers
from sim.evaluate.executor import Executor
from sim.plan.sandbox.client import without_waiting

RESOURCES = (
    health,  # asked while the service starts: a route is built when it is first tried, so none before it
    state,  # those that are asked most come next, as routes are tried in this order
    commands,
    step,
    questions,
    create_session,
    sessions,
    config,
    decisions,
    events,
    recording,
    frame,
    video,
    parse,
    advice,
    language_route,
    websocket,
    sse,
    ws_tickets,
    forks,
    rewind,
    bookmarks,
    links,
    timeline,
    changes,
    moments,
    forecast,
    percept,
    regret,
    counterfactual,
    long_answers,
    evaluations,
    metrics,
    backup,
)
"""The modules whose `router` the application has."""

_DESCRIPTION = """
A vehicle that drives itself along a road of obstacles and potholes, live; changed and questioned in
plain words.

The guide is at [/guide](/guide). Everything the page does is a call documented here.
Errors are problems (RFC 9457). A session is also
a stream: open a WebSocket on `/api/v1/sessions/{id}/stream`; it sends `hello`, then `tick` and
`changed` messages, and takes `{"type": "command", "id": "1", "text": "add five potholes"}`.

HEAD answers as GET does, without the body. A parameter in the URL that a call does not have is refused.
"""


def create_app(
    settings: Settings | None = None,
    *,
    store: Store | None = None,
    language: Language | None = None,
    narrator: NarratorProtocol | None = None,
    clock: Clock | None = None,
    model: LanguageModel | None = None,
    make_executor: Callable[[], Executor] | None = None,
    shard: Shard = SINGLE,
) -> FastAPI:
    """The service, or one shard of it. Whatever is not given is what the settings name, or the default.

    Raises `StoreError` for a database URL of no known kind, `LanguageDataError` for broken words,
    `MissingExtraError` where a language model is named and the extra for it is missing.
    """
    settings = settings or Settings()
    measured = Metrics()
    store = time_store(store or open_store(settings.database, shard), measured.store)
    clock = clock or WheelClock(late=measured.lateness.observe)
    narrator = narrator or Narrator.load()
    model = model or create_model(settings)
    jobs = JobRunner(store, [EvaluationJobs(), FindWorstJobs()], make_executor, shard)
    manager = SessionManager(SessionServices(store, clock, narrator, settings, jobs, shard))
    jobs.on_done = announcer(manager)
    languages = Languages.load() if language is None else Languages({DEFAULT_LANGUAGE: language})
    aliases = Aliases(store, languages)
    interpreter = Interpreter(
        languages,
        aliases,
        narrator,
        most_chars=settings.max_text_chars,
        model=model,
        confirm=settings.llm_confirm,
        rephrase=settings.llm_rephrase,
    )
    measured.read_from(manager)
    guard, answers = Guard(settings), KeptAnswers(store)
    context = Context(
        settings,
        store,
        clock,
        interpreter,
        narrator,
        manager,
        guard,
        measured,
        answers,
        jobs,
        long_answers=LongAnswers(shard=shard),
    )

    app = FastAPI(
        separate_input_output_schemas=False,
        title="Roadtalk",
        version=VERSION,
        description=_DESCRIPTION,
        lifespan=_lifespan(context, aliases, model),
        docs_url=None,
        openapi_url=None,  # `openapi` serves the document
        redoc_url=None,
        redirect_slashes=False,
        **_telemetry(),
    )
    app.state.context = context
    app.state.aliases = aliases
    routes = [route for resource in RESOURCES for route in resource.router.routes]
    _add_middleware(app, context, routes)
    errors.install(app)
    app.router.routes[:0] = routes
    openapi.install(app)
    docs.install(app)
    pages.install(app)
    guide.install(app)
    app.router.routes.append(NO_WEBSOCKET)
    return app


def _telemetry() -> dict[str, Any]:
    """The option for what FastAPI reports to OpenTelemetry: nothing, unless the environment sets that up.

    Otherwise each request looks for providers in the environment (`python -m bench.commands`). Versions of
    FastAPI that report nothing ignore it.
    """
    on = any(name.startswith(("OTEL_", "FASTAPI_OTEL_")) for name in os.environ)
    return {"telemetry": {"tracing": on, "metrics": on, "logs": on}}


def _add_middleware(app: FastAPI, context: Context, routes: list[BaseRoute]) -> None:
    # The last one added is the outermost.
    app.add_middleware(DirectRoutes, routes=routes)
    app.add_middleware(CrossSiteCheck)
    app.add_middleware(HostCheck, hosts=context.guard.hosts)
    app.add_middleware(SecurityHeaders)
    app.add_middleware(HeadMethod)
    app.add_middleware(RequestId)


def _lifespan(
    context: Context, aliases: Aliases, model: LanguageModel | None
) -> Callable[[FastAPI], AbstractAsyncContextManager[None]]:
    """Opens what the service needs, and closes it within `STOP_S`."""
    manager, store = context.manager, context.store

    async def close(keepers: list[asyncio.Task[None]]) -> None:
        await asyncio.wait(keepers)
        await context.long_answers.close()
        await context.jobs.close()
        await manager.close()
        if model is not None:
            await model.aclose()
        await store.close()

    @asynccontextmanager
    async def lifespan(_: FastAPI) -> AsyncIterator[None]:
        await store.open()
        await manager.open()
        await aliases.open()
        await context.answers.open()
        await context.jobs.open()
        context.clock.start()
        keepers = [
            asyncio.create_task(manager.evictor().run()),
            asyncio.create_task(_retention(context).run()),
        ]
        try:
            with without_waiting():
                yield
        finally:
            for keeper in keepers:
                keeper.cancel()
            context.clock.stop()
            manager.work.stop()
            await within(STOP_S, close(keepers))

    return lifespan


def _retention(context: Context) -> Retention:
    """Deletes what nobody uses; the quotas and the figures hear of it."""

    def expired(session_id: str) -> None:
        context.guard.quotas.release(session_id)
        context.metrics.count_expired()

    return Retention(context.store, context.manager, context.settings, expired)
