"""The language and its words, read beside the first picture: they take a second."""

from __future__ import annotations

import threading
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from service.window.texts import language

if TYPE_CHECKING:
    from service.interpreter.languages import Languages
    from service.sessions.narrator_protocol import NarratorProtocol


class LoadError(Exception):
    """The language is not there, or unfit; the message says what."""


@dataclass(frozen=True, slots=True)
class Loaded:
    """What a game needs to understand and to answer."""

    languages: Languages
    words: NarratorProtocol


def load() -> Loaded:
    """Read it all, here and now. Raises `LanguageDataError` and `FileNotFoundError` for unfit data."""
    from service.actions import Hide, Show
    from service.grammar import Language
    from service.interpreter.languages import Languages
    from service.narration import Narrator
    from service.sessions.availability import refusal_of

    code = language()

    def offered(action: object) -> bool:
        return isinstance(action, Show | Hide) or refusal_of(action) is None  # type: ignore[arg-type]

    grammar = Language.load(code, offered=offered)
    grammar.suggestions.nearest("", ())  # ready before anyone is refused
    languages = Languages({code: grammar})
    guide = languages.guide(code)
    if guide is not None:
        from service.grammar.topic import ALONE

        guide.completions_here("a", None, ALONE, [])
    return Loaded(languages, Narrator.load(code))


@dataclass
class Loading:
    """Reading it in a thread of its own."""

    _found: list[Loaded] = field(default_factory=list)
    _failed: list[LoadError] = field(default_factory=list)
    _thread: threading.Thread | None = None

    def begin(self) -> None:
        """Begin, once."""
        if self._thread is None:
            self._thread = threading.Thread(target=self._work, name="loading", daemon=True)
            self._thread.start()

    def _work(self) -> None:
        try:
            self._found.append(load())
        except (ImportError, OSError, ValueError, KeyError) as error:
            self._failed.append(LoadError(f"The language cannot be read: {error}"))

    def ready(self) -> Loaded | None:
        """What was read, or None while it is being read. Raises `LoadError`."""
        if self._failed:
            raise self._failed[0]
        return self._found[0] if self._found else None

    def wait(self) -> Loaded:
        """What was read, waiting for it. Raises `LoadError`."""
        self.begin()
        assert self._thread is not None
        self._thread.join()
        loaded = self.ready()
        assert loaded is not None
        return loaded
