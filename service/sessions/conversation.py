"""What has been spoken of in a session: what "it", "those", "again" and "two more" are about.

Made from outcomes, so a replayed session remembers what was done to it; what was merely asked is not
stored, and after a restart "it" is no longer what was last explained. Things that have left the
road are not spoken of any more.
"""

from __future__ import annotations

from collections import deque

from service.actions import Action, Redo, Undo
from service.language.topic import Phrases, Topic
from service.sessions.facts import Fact, Undone
from service.sessions.utterance import Outcome
from sim.actions import Add, Remove, SetCount, Where
from sim.edit import Applied
from sim.world import World

REMEMBERED = 200
"""How many added things are remembered by the order they came in."""


class Conversation:
    """The memory of one session's talk."""

    def __init__(self) -> None:
        self._things: tuple[str, ...] = ()
        self._added: deque[str] = deque(maxlen=REMEMBERED)
        self._actions: tuple[Action, ...] = ()
        self._undone = False
        self._kind: str | None = None
        self._removed = False
        self._where: Where | None = None

    def note(self, outcome: Outcome) -> None:
        """Remember what was done, or told about."""
        actions = outcome.utterance.actions
        if not any(isinstance(action, Undo | Redo) for action in actions):
            self._actions = actions
        changing = [fact for fact in outcome.facts if isinstance(fact, Applied | Undone)]
        if changing:
            last = changing[-1]
            self._undone = isinstance(last, Undone) and not last.again
        for fact in outcome.facts:
            self._note_things(fact)
        if outcome.answer is not None:
            told = tuple(cause["id"] for cause in outcome.answer.get("causes", ()) if cause.get("id"))
            self._things = told or self._things

    def _note_things(self, fact: Fact) -> None:
        if not isinstance(fact, Applied) or not isinstance(fact.action, Add | Remove | SetCount):
            return
        ids = tuple(thing.id for thing in fact.added)
        self._things = ids
        self._added.extend(ids)
        self._removed = isinstance(fact.action, Remove) or bool(fact.removed)
        if fact.action.kind != "everything":
            self._kind = fact.action.kind
        self._where = None if isinstance(fact.action, SetCount) else fact.action.where

    def topic(self, world: World, phrases: Phrases) -> Topic:
        """What a sentence said now may refer to."""
        there = {*world.movers.values(), *world.hazards.values()}
        return Topic(
            things=tuple(name for name in self._things if name in there),
            added=tuple(name for name in self._added if name in there),
            actions=self._actions,
            undone=self._undone,
            kind=self._kind,
            removed=self._removed,
            where=self._where,
            phrases=phrases,
        )
