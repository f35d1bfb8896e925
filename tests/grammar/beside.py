"""The test files that stand beside the data, and what they hold."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import yaml

from service.actions import dump
from service.grammar import Ambiguous, Language, Understood
from service.resources import prompts_folder

FOLDER = prompts_folder() / "language" / "en"
HERE = Path(__file__).parent / "data"


def beside(key: str) -> list[Any]:
    """All entries under a key, of all test files."""
    entries: list[Any] = []
    for path in sorted(FOLDER.rglob("*.test.yaml")):
        data = yaml.load(path.read_bytes(), Loader=getattr(yaml, "CSafeLoader", yaml.SafeLoader))
        entries.extend(data.get(key, []))
    return entries


def meaning(language: Language, text: str) -> list[dict[str, Any]] | str:
    """The actions of a sentence, `[]` when it is refused, `"ask"` when it is asked about."""
    parsed = language.parse(text)
    if isinstance(parsed, Understood):
        return dump(parsed.actions)
    return "ask" if isinstance(parsed, Ambiguous) else []
