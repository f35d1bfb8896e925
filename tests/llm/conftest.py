"""A server to ask, and the real model behind the typed door asking it."""

from __future__ import annotations

from collections.abc import AsyncIterator, Callable
from contextlib import AsyncExitStack
from dataclasses import dataclass
from typing import Any

import pytest

from service.llm.openai import OpenAIModel
from service.settings import Settings
from tests.llm.server import Endpoint, serving

KEY = "sk-very-secret-key"


@dataclass
class Seconds:
    """A clock that moves by hand."""

    now: float = 1_000.0

    def __call__(self) -> float:
        return self.now


Making = Callable[..., OpenAIModel]


@pytest.fixture(autouse=True)
def _no_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    """What this machine has set is nobody's business, and may not be sent anywhere."""
    for name in Settings.model_fields:
        monkeypatch.delenv(f"ROADTALK_{name.upper()}", raising=False)
    monkeypatch.setenv("OPENAI_API_KEY", "sk-of-the-environment")
    monkeypatch.setenv("OPENAI_ORG_ID", "org-of-the-environment")
    monkeypatch.setenv("OPENAI_PROJECT_ID", "project-of-the-environment")
    monkeypatch.setenv("OPENAI_BASE_URL", "http://127.0.0.1:9/elsewhere")
    for name in ("HTTP_PROXY", "HTTPS_PROXY", "ALL_PROXY"):
        monkeypatch.setenv(name, "http://127.0.0.1:9")
        monkeypatch.setenv(name.lower(), "http://127.0.0.1:9")


@pytest.fixture
async def endpoint() -> AsyncIterator[Endpoint]:
    async with serving() as one:
        yield one


@pytest.fixture
async def making(endpoint: Endpoint) -> AsyncIterator[Making]:
    """Makes models that ask the endpoint; they are closed at the end."""
    async with AsyncExitStack() as stack:

        def make(clock: Seconds | None = None, **more: Any) -> OpenAIModel:
            settings = Settings(
                **{
                    "llm_base_url": endpoint.url,
                    "llm_model": "small",
                    "llm_api_key": KEY,
                    "llm_timeout_s": 30,
                }
                | more
            )
            model = OpenAIModel(settings, clock=clock or Seconds())
            stack.push_async_callback(model.aclose)
            return model

        yield make


@pytest.fixture
def model(making: Making) -> OpenAIModel:
    return making()
