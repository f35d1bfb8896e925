"""The optional language model: asked when the grammar refuses, and never trusted.

Importing this package loads no model library; `create_model` does, and only if a model is configured.
"""

from __future__ import annotations

from service.llm.protocol import Facts, Interpretation, LanguageModel
from service.settings import Settings

__all__ = ["Facts", "Interpretation", "LanguageModel", "MissingExtraError", "create_model"]

_LIBRARIES = ("pydantic_ai", "openai", "httpx2")
"""The packages of the extra `llm`."""


class MissingExtraError(RuntimeError):
    """A language model is configured, but the library for it is not installed."""


def create_model(settings: Settings) -> LanguageModel | None:
    """The configured language model; None without an address or a model name.

    Raises `MissingExtraError` where the extra `llm` is not installed, and `PromptError` for broken prompts:
    both at the start, not when the model is first needed.
    """
    if settings.llm_base_url is None or not settings.llm_model:
        return None
    try:
        from service.llm.openai import OpenAIModel
    except ModuleNotFoundError as error:
        if (error.name or "").partition(".")[0] not in _LIBRARIES:
            raise
        raise MissingExtraError(
            "A language model is configured (ROADTALK_LLM_BASE_URL, ROADTALK_LLM_MODEL), but the extra "
            "'llm' is not installed. Install roadtalk[llm], or take these settings away."
        ) from None
    return OpenAIModel(settings)
