"""The guide to a language: every intent with examples, and completions of a sentence that was begun.

It is made from the language's own data, so it lists nothing that the grammar does not understand.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property, partial
from typing import cast

from anyio import CapacityLimiter, to_thread

from service.actions import Action, Ask
from service.actions.table import sets_playback_speed
from service.grammar import Language as Grammar
from service.grammar.completion import Completer
from service.grammar.corpus import sentences
from service.grammar.parse_types import Understood
from service.grammar.sentences import Unsayable
from service.grammar.topic import Topic
from service.resources import DEFAULT_LANGUAGE
from service.sessions.availability import refusal_of
from service.sessions.dry_run import is_possible
from service.sessions.scheduler.playback_speed import (
    PlaybackSpeed,
    PlaybackSpeedError,
    change_playback_speed,
)
from service.sessions.session import Session
from service.sessions.transaction import Transaction
from service.sessions.work_estimate import is_large
from sim.actions import Adjust, PlaceableKind, Remove, Set, Where
from sim.config import Config
from sim.session.errors import EditError
from sim.session.settings import change_setting
from sim.types import kind_of

MAX_INLINE_CHARS = 40
"""Longest prefix, in characters, that is completed on the event loop; longer ones in a thread."""

EXAMPLES = 6
"""Number of examples of an intent."""


@dataclass(frozen=True, slots=True)
class Example:
    """A sentence and its actions."""

    text: str
    actions: tuple[Action, ...]


@dataclass(frozen=True, slots=True)
class Intent:
    """One kind of thing that can be said."""

    name: str
    available: bool
    why_not: str | None
    examples: tuple[Example, ...]


class Guide:
    """The guide to one language."""

    def __init__(self, grammar: Grammar, language: str = DEFAULT_LANGUAGE) -> None:
        """`language`: its code; reasons for unavailable intents are in it."""
        self._grammar = grammar
        self._language = language
        self._completing = CapacityLimiter(1)

    @cached_property
    def intents(self) -> tuple[Intent, ...]:
        """Every intent that has an example, available ones first. Takes a tenth of a second, once."""
        by_name: dict[str, list[Example]] = {}
        for text in self._sayings:
            parsed = self._grammar.parse(text)
            if isinstance(parsed, Understood) and len({_name(action) for action in parsed.actions}) == 1:
                by_name.setdefault(_name(parsed.actions[0]), []).append(Example(text, parsed.actions))
        found = [_intent(name, examples, self._language) for name, examples in by_name.items()]
        return tuple(sorted(found, key=lambda intent: not intent.available))

    def completions_here(
        self, prefix: str, session: Session | None, topic: Topic, taught: list[str]
    ) -> list[str]:
        """Sentences that begin with `prefix` and would work (in the session, if one is given); blocking."""
        extra = [*taught, *self._by_id(topic)]
        return self._completer.complete(prefix, topic, extra=extra, possible=partial(_possible, session))

    async def completions(
        self, prefix: str, session: Session | None, topic: Topic, taught: list[str]
    ) -> list[str]:
        """`completions_here`; in a thread for long prefixes, and on large roads, where trying takes long."""
        if len(prefix) <= MAX_INLINE_CHARS and (session is None or not is_large(session.run)):
            return self.completions_here(prefix, session, topic, taught)
        extra = [*taught, *self._by_id(topic)]
        possible = partial(_possible, None) if session is None else _trial(session)

        def complete() -> list[str]:
            return self._completer.complete(prefix, topic, extra=extra, possible=possible)

        return await to_thread.run_sync(complete, limiter=self._completing)

    def _by_id(self, topic: Topic) -> Iterator[str]:
        """Sentences about the things that the conversation is about."""
        for name in reversed(topic.things):
            away = Remove(kind=cast(PlaceableKind, str(kind_of(name))), count=1, where=Where(id=name))
            try:
                yield self._grammar.sentence((away,))
            except Unsayable:
                return

    @cached_property
    def _sayings(self) -> tuple[str, ...]:
        grammar = self._grammar
        said = [say for frame in grammar.data.frames for say in frame.says]
        made = sentences(grammar.sentences) if grammar.data.sentences else ()
        return tuple(dict.fromkeys([*said, *made]))

    @cached_property
    def _completer(self) -> Completer:
        grammar = self._grammar
        made = list(sentences(grammar.sentences)) if grammar.data.sentences else []
        return Completer(grammar, [*made, *self._sayings])


def _possible(session: Session | None, actions: tuple[Action, ...]) -> bool:
    """Whether the actions would work now, in the session if one is given."""
    if session is not None:
        return session.is_possible(actions) and _settable(actions, session.run.config, session.playback_speed)
    return all(refusal_of(action) is None for action in actions)


def _trial(session: Session) -> Callable[[tuple[Action, ...]], bool]:
    """`_possible` in a session as it is now, for another thread."""
    begun, sequence, config = session.begin_transaction(), session.sequence, session.run.config

    def possible(actions: tuple[Action, ...]) -> bool:
        speed = begun.playback_speed
        fresh = Transaction(begun.timeline, begun.paused, begun.undo_stack, speed, begun.language, begun.talk)
        return is_possible(fresh, sequence, actions) and _settable(actions, config, speed)

    return possible


def _name(action: Action) -> str:
    return f"ask {action.about}" if isinstance(action, Ask) else action.do


def _settable(actions: tuple[Action, ...], config: Config, speed: PlaybackSpeed) -> bool:
    """Whether the settings can be set one after another; cheap, unlike a new road."""
    try:
        for action in actions:
            if isinstance(action, Set | Adjust):
                if sets_playback_speed(action):
                    speed = change_playback_speed(speed, action)
                else:
                    config = change_setting(config, action)
    except (EditError, PlaybackSpeedError):
        return False
    return True


def _intent(name: str, examples: list[Example], language: str) -> Intent:
    working = [each for each in examples if all(refusal_of(action) is None for action in each.actions)]
    shown = (working or examples)[:EXAMPLES]
    reasons = [] if working else [refusal_of(action, language) for action in examples[0].actions]
    why_not = next(filter(None, reasons), None)
    return Intent(name, bool(working), why_not, tuple(shown))
