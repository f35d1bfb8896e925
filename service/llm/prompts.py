"""The prompts and the words of explanations, read from `prompts/llm`.

A prompt is a Markdown file with a head: its `version`, and `again`, the words added when an answer could
not be read. No word of a user is ever put into one: what was said travels in a message of its own.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import yaml

from service.llm.failures import PromptError
from service.llm.schema import schema
from service.resources import prompts_folder

SCHEMA_MARK: Final = "{{actions}}"
"""The placeholder for the description of the actions in a prompt."""


@dataclass(frozen=True, slots=True)
class Prompt:
    """One prompt, ready to be sent."""

    name: str
    version: int
    text: str
    again: str


def llm_folder() -> Path:
    """Where the files are."""
    return prompts_folder() / "llm"


def load_prompt(name: str, folder: Path | None = None) -> Prompt:
    """A prompt by its name. Raises `PromptError`."""
    path = (folder or llm_folder()) / f"{name}.md"
    text = _text(path)
    begin, head, body = text.split("---\n", 2) if text.count("---\n") >= 2 else ("", "", "")
    values = _values(head, path) if not begin else {}
    version, again = values.get("version"), values.get("again", "")
    if not isinstance(version, int) or not isinstance(again, str) or not body.strip():
        raise PromptError(f"{path} must begin with a head that has a version, and have a text")
    return Prompt(name, version, body.strip().replace(SCHEMA_MARK, schema()), again.strip())


def load_claims(folder: Path | None = None) -> dict[str, Any]:
    """The words of an explanation: `numbers`, `groups` that claim, `neutral`. Raises `PromptError`."""
    path = (folder or llm_folder()) / "claims.yaml"
    values = _values(_text(path), path)
    kinds = {name: type(part) for name, part in values.items()}
    if kinds != {"numbers": dict, "groups": dict, "neutral": list}:
        raise PromptError(f"{path} must have numbers, groups and neutral words")
    return values


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8")
    except OSError as error:
        raise PromptError(f"{path} cannot be read: {error.strerror}") from None


def _values(text: str, path: Path) -> dict[Any, Any]:
    try:
        values = yaml.safe_load(text)
    except yaml.YAMLError as error:
        raise PromptError(f"{path} is not YAML: {error}") from None
    if not isinstance(values, dict):
        raise PromptError(f"{path} must hold names and values")
    return values
