"""The language model behind any OpenAI-compatible server, by pydantic-ai.

It asks for plain text, since many servers know neither tools nor schemas, and reads the actions out of
it. Whatever goes wrong on the way becomes a sentence for a person. The library is imported here and
in `transport` only, and this module only where a model is configured.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable
from typing import Final
from urllib.parse import urlsplit

import httpx2
import structlog
from openai import AsyncOpenAI, OpenAIError
from pydantic_ai.direct import model_request
from pydantic_ai.exceptions import AgentRunError
from pydantic_ai.messages import ModelRequest, SystemPromptPart, TextPart, UserPromptPart
from pydantic_ai.models.openai import OpenAIChatModel
from pydantic_ai.profiles.openai import OpenAIModelProfile
from pydantic_ai.providers.openai_compatible import OpenAICompatibleProvider
from pydantic_ai.settings import ModelSettings
from pydantic_core import to_json

from service.actions import Action
from service.llm.answer_parser import parse_answer
from service.llm.claims import Claims
from service.llm.failures import ModelFailure
from service.llm.prompts import load_prompt
from service.llm.protocol import Facts, Interpretation
from service.llm.transport import GuardedTransport
from service.rate_limit import TokenBucket
from service.refusals import refusals
from service.settings import Settings

_LOG = structlog.get_logger(__name__)
_OWN_HOST: Final = "api.openai.com"
"""The one server with another parameter for the number of tokens; its newer models refuse the old one."""


class OpenAIModel:
    """A language model at the address and with the limits that the settings name."""

    def __init__(self, settings: Settings, *, clock: Callable[[], float] = time.monotonic) -> None:
        """`clock` is for the limit a minute. Raises `PromptError`."""
        base_url, model = settings.llm_base_url, settings.llm_model
        if base_url is None or not model:
            raise ValueError("a language model needs an address and a name")
        self._settings = settings
        self._interpret, self._rephrase = load_prompt("interpret"), load_prompt("rephrase")
        self._claims = Claims.load()
        bucket = TokenBucket(settings.llm_per_minute, clock)
        self._http = httpx2.AsyncClient(
            transport=GuardedTransport(base_url, settings.llm_api_key, bucket),
            follow_redirects=False,
            trust_env=False,
            timeout=None,
        )
        # The key is the transport's. The library gets none, so that none can be in what it shows or logs.
        client = AsyncOpenAI(
            api_key="none",
            base_url=base_url,
            http_client=self._http,
            max_retries=0,
            timeout=None,
        )
        own = urlsplit(base_url).hostname == _OWN_HOST
        profile = OpenAIModelProfile(openai_chat_supports_max_completion_tokens=own)
        provider = OpenAICompatibleProvider("endpoint", openai_client=client, profile=profile)
        self._model = OpenAIChatModel(model, provider=provider)
        self._limits = ModelSettings(temperature=0.0, max_tokens=settings.llm_max_tokens)

    @property
    def name(self) -> str:
        """The model and the versions of the prompts."""
        prompts = [self._interpret, self._rephrase]
        versions = ", ".join(f"{prompt.name} {prompt.version}" for prompt in prompts)
        return f"{self._settings.llm_model} ({versions})"

    async def interpret(self, text: str) -> Interpretation:
        """Actions, or one sentence on why there are none."""
        try:
            async with asyncio.timeout(self._settings.llm_timeout_s):
                return Interpretation(await self._actions(text))
        except TimeoutError:
            failure = ModelFailure("timeout", seconds=self._settings.llm_timeout_s)
        except ModelFailure as error:
            failure = error
        _LOG.info("language model not used", reason=failure.reason, model=self.name)
        return Interpretation(explanation=refusals().model(failure.reason, failure.parts), failure=failure)

    async def rephrase(self, text: str, facts: Facts) -> str:
        """The text in the model's words, if these claim the same; else the text."""
        if not self._settings.llm_rephrase:
            return text
        try:
            async with asyncio.timeout(self._settings.llm_timeout_s):
                answer = await self._ask(self._rephrase.text, _message("explanation", text))
        except (TimeoutError, ModelFailure):
            return text
        words = " ".join(answer.split())
        return words if self._claims.is_faithful(words, text, facts) else text

    async def aclose(self) -> None:
        """Close the connections."""
        await self._http.aclose()

    async def _actions(self, text: str) -> tuple[Action, ...]:
        """What the model reads in a sentence, asked twice at most. Raises `ModelFailure`."""
        prompt, said = self._interpret, _message("said", text)
        try:
            return parse_answer(await self._ask(prompt.text, said), text)
        except ModelFailure as failure:
            if not failure.again:
                raise
        # The unfit answer is not sent along: some servers want turns to alternate, and it may be hostile.
        return parse_answer(await self._ask(prompt.text, f"{said}\n{prompt.again}"), text)

    async def _ask(self, system: str, user: str) -> str:
        """One request, and the text of its answer. Raises `ModelFailure`."""
        message = ModelRequest(parts=[SystemPromptPart(content=system), UserPromptPart(content=user)])
        try:
            answer = await model_request(
                self._model, [message], model_settings=self._limits, instrument=False
            )
        except (AgentRunError, OpenAIError, httpx2.HTTPError) as error:
            raise _failure_in(error) from error
        return "".join(part.content for part in answer.parts if isinstance(part, TextPart))


def _message(name: str, text: str) -> str:
    """A user's words as data: one JSON object, which no words can end early."""
    return to_json({name: text.encode(errors="replace").decode()}).decode()


def _failure_in(error: BaseException) -> ModelFailure:
    """What the transport said, out of the errors the libraries put around it."""
    inner: BaseException | None = error
    while inner is not None and not isinstance(inner, ModelFailure):
        inner = inner.__cause__ or inner.__context__
    return inner or ModelFailure("no_answer")
