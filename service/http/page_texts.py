"""The page's words as JSON: `prompts/interface/<language>/page.yaml`, flattened to dotted keys.

A text is a string, or a table of plural forms (`one`, `few`, `other`, …) chosen by `count` in the browser.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Final

from service.contract.encode.json import encoded
from service.http.static import StaticFile
from service.resources import prompts_folder

FILE: Final = "page.yaml"
PLURALS: Final = frozenset({"zero", "one", "two", "few", "many", "other"})

Texts = dict[str, str | dict[str, str]]


def page_languages() -> list[str]:
    """Languages that the page can be read in."""
    return sorted(path.parent.name for path in (prompts_folder() / "interface").glob(f"*/{FILE}"))


def page_texts(code: str) -> Texts:
    """Texts of one language by dotted key. Raises `ValueError` where something is not a text."""
    return _flat((prompts_folder() / "interface" / code / FILE).read_text(encoding="utf-8"))


class StaticTexts(StaticFile):
    """The texts of one language at one address."""

    def __init__(self, code: str) -> None:
        super().__init__(prompts_folder() / "interface" / code / FILE)
        self._kind = "application/json"

    def content(self) -> bytes:
        """The texts as JSON."""
        return encoded(_flat(self.file.read_text(encoding="utf-8")))


def _flat(source: str) -> Texts:
    import yaml  # only for who opens the page

    return dict(_entries((), yaml.safe_load(source)))


def _entries(keys: tuple[str, ...], value: Any) -> Iterator[tuple[str, str | dict[str, str]]]:
    name = ".".join(keys)
    if isinstance(value, str):
        yield name, value
    elif not isinstance(value, dict) or not all(isinstance(key, str) for key in value):
        raise ValueError(f"{name}: neither a text nor a table of texts: {value!r}")
    elif "other" in value and value.keys() <= PLURALS:
        yield name, value
    else:
        for key, each in value.items():
            yield from _entries((*keys, key), each)
