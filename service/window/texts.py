"""The window's words: `prompts/interface/<language>/window.yaml`, in one language for the whole program."""

from __future__ import annotations

from functools import cache
from typing import Any

from service.resources import DEFAULT_LANGUAGE, prompts_folder
from service.yaml_files import read_yaml
from sim.render.labels import set_labels

FILE = "window.yaml"

_chosen = [DEFAULT_LANGUAGE]


def languages() -> list[str]:
    """The codes of the languages that the window speaks."""
    return sorted(path.parent.name for path in (prompts_folder() / "interface").glob(f"*/{FILE}"))


def choose_language(code: str) -> None:
    """Speak this language from now on. Raises `ValueError` where there is none of this code."""
    if code not in languages():
        raise ValueError(code)
    _chosen[0] = code
    set_labels(table("drawn"))


def language() -> str:
    """The code of the language."""
    return _chosen[0]


def text(*keys: str, **parts: object) -> str:
    """A text, filled."""
    return str(table(*keys)).format(**parts)


def table(*keys: str) -> Any:
    """What stands under keys: a text, a list or a table."""
    found = _texts(language())
    for key in keys:
        found = found[key]
    return found


@cache
def _texts(code: str) -> Any:
    return read_yaml(prompts_folder() / "interface" / code / FILE)
