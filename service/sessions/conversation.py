"""Conversation memory: what "it", "those", "again" and "two more" refer to in a session.

It is made from outcomes, so a replay restores it; questions are not stored, so after a restart "it" no longer
refers to what was last explained. Things that left the road cannot be referred to, nor can things of an
earlier episode, since an undo gives ids again.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Mapping
from copy import copy
from dataclasses import asdict
from functools import cache
from typing import Any, TypeAlias

from pydantic import TypeAdapter

from service import actions as contract
from service.actions import Action, Ask, Chat, Drop, Redo, Undo
from service.actions.table import traits_of
from service.grammar.topic import Phrases, Topic
from service.sessions.facts import (
    Answerable,
    Asked,
    Fact,
    Undone,
    performed_actions,
    spread_facts,
)
from service.sessions.present import Present
from service.sessions.referred import changes_number, explained, named, options_told, tick_told
from service.sessions.utterance import Outcome, Utterance
from sim.actions import (
    Add,
    Copy,
    MoveThings,
    Rearranging,
    Remove,
    Replace,
    Reset,
    SetCount,
    Swap,
    Where,
)
from sim.session.edits import Applied
from sim.state import SimState
from sim.types import kind_of
from sim.world import World

MAX_REMEMBERED = 200
"""Largest number of added things that are remembered in order."""

Episode: TypeAlias = tuple[int, int]
"""The number of an episode and its first tick."""


class Conversation:
    """The memory of one session."""

    def __init__(self) -> None:
        self._things: tuple[str, ...] = ()
        self._before: tuple[str, ...] = ()
        self._added: deque[str] = deque(maxlen=MAX_REMEMBERED)
        self._actions: tuple[Action, ...] = ()
        self._said = ""
        self._steps = 0
        self._latest_steps: tuple[int, ...] = ()
        """steps of undo of the latest two changes"""
        self._tick: int | None = None
        self._explained: Ask | None = None
        self._offered: tuple[Action, ...] = ()
        self._away: tuple[int, ...] = ()
        """how many things each of them took off the road or moved"""
        self._listed: tuple[str, ...] = ()
        self._batch: tuple[str, ...] = ()
        """those of them that were told or added last, by one request"""
        self._told = False
        """whether an answer told them"""
        self._taken: tuple[str, ...] = ()
        """ids of what the latest change of things took off the road: after an undo they are "it" """
        self._said_actions: tuple[Action, ...] = ()
        """the last request as it was said: a goal, not what it came to"""
        self._changed: tuple[Action, ...] = ()
        self._changed_steps = 0
        """the last request that was no question, and its steps of undo"""
        self._asked: tuple[Action, ...] = ()
        """the last question"""
        self._undone = False
        self._kind: str | None = None
        self._removed = False
        self._where: Where | None = None
        self._episode: Episode | None = None
        self._durable: Conversation | None = None
        """the memory without unstored talk, where that differs"""
        self._ids: tuple[Mapping[int, str], Mapping[int, str], frozenset[str]] | None = None
        """the ids of what was on the road when they were last asked for, with what they were read from"""

    @property
    def explained(self) -> Ask | None:
        """The question that was answered last, with the tick that its answer is about."""
        return self._explained

    @property
    def durable(self) -> Conversation:
        """A copy of what a restart would restore."""
        twin = copy(self._durable or self)
        twin._added = twin._added.copy()
        return twin

    def record(self, outcome: Outcome, *, transient: bool = False, step: bool = False) -> None:
        """Record what an outcome did or answered.

        `transient`: it is not stored; `step`: it is a new step of undo.
        """
        if transient:
            self._durable = self._durable or self.durable
        elif self._durable is not None:
            self._durable.record(outcome, step=step)
        actions = performed_actions(outcome.utterance.actions, outcome.facts)
        facts = tuple(spread_facts(outcome.facts))
        if all(isinstance(action, Chat) for action in actions):
            return
        self._record_request(outcome.utterance.text, actions, facts, step=step)
        if self._actions == actions:
            self._said_actions = outcome.utterance.actions
        if others := [fact for fact in facts if not isinstance(fact, Answerable)]:
            # After anything but an undo "again" is about that.
            last = others[-1]
            self._undone = isinstance(last, Undone) and not last.again
            if isinstance(last, Undone) and self._taken:
                self._things = self._taken  # what was taken away is there again, or gone again
        amounts = [fact for fact in facts if isinstance(fact, Applied) and _moves_things(fact)]
        if amounts:
            if any(isinstance(fact, Undone) for fact in facts):
                self._listed = tuple(name for name in self._listed if name not in self._batch)
            self._before = self._things
            self._things = (
                self._taken
            ) = ()  # "them" are all that the utterance added, not what its last part did
            if any(fact.added for fact in amounts):
                self._begin_batch()
        elif any(isinstance(fact, Applied) and changes_number(fact.action) for fact in facts):
            self._kind = None  # "one more" is one more lane
        for fact in amounts:
            self._record_change(fact)
        if outcome.answer is not None or any(not isinstance(fact, Answerable) for fact in facts):
            self._explained = None if outcome.answer is None else explained(outcome.answer, actions)
        if len(self._batch) > 1:
            self._listed = self._batch  # things added together are counted by themselves
        self._tick = None if outcome.answer is None else tick_told(outcome.answer, actions)
        chosen = outcome.answer is None and outcome.utterance.actions[0] in self._offered
        self._offered = (
            self._offered
            if chosen
            else ()
            if outcome.answer is None
            else options_told(outcome.answer, actions)
        )
        if outcome.answer is not None:
            self._record_answer(outcome.answer, facts)

    def _record_request(
        self, text: str | None, actions: tuple[Action, ...], facts: tuple[Fact, ...], *, step: bool
    ) -> None:
        """Record what was asked for; of a correction, what was done in the place of what it took back."""
        begins_with_undo = len(actions) > 1 and isinstance(actions[0], Undo)
        own = actions[1:] if begins_with_undo else actions
        if any(isinstance(action, Undo | Redo | Drop) for action in own):
            if not all(isinstance(action, Drop) for action in own):
                self._steps = self._changed_steps = 0
                self._latest_steps = self._away = ()
            return
        taken_back = sum(fact.steps for fact in facts[:1] if isinstance(fact, Undone))
        self._actions, self._steps = own, 1 + taken_back if step else 0
        self._said_actions = ()
        self._said = "" if begins_with_undo else text or ""
        if all(traits_of(action).is_question for action in own):
            self._asked = own
        if step:
            self._changed, self._changed_steps = own, self._steps
        if step:
            kept = () if taken_back else self._latest_steps
            self._latest_steps = (*kept, self._steps)[-2:]
            changed = [fact for fact in facts if isinstance(fact, Applied)]
            away = sum(len(fact.removed) + len(fact.moved) for fact in changed)
            self._away = (*(() if taken_back else self._away), away)[-2:]

    def record_refused(self, utterance: Utterance) -> None:
        """Record a request that could not be done: "no, radar" is meant instead, and nothing is undone."""
        if any(isinstance(action, Undo | Redo | Drop | Chat) for action in utterance.actions):
            return
        self._durable = self._durable or self.durable
        self._actions = self._said_actions = utterance.actions
        self._said, self._steps, self._offered, self._tick = utterance.text or "", 0, (), None
        self._undone = False

    def _begin_batch(self) -> None:
        """What was added one after another is counted on; what an answer told begins a list of its own."""
        kept = () if self._told else self._listed
        self._listed, self._batch, self._told = kept[-MAX_REMEMBERED:], (), False

    def _record_change(self, fact: Applied) -> None:
        action = fact.action
        if not isinstance(action, Add | Remove | SetCount | Rearranging):
            self._forget_things()
            return
        self._set_episode(fact.state.world)
        self._things += tuple(thing.id for thing in fact.added)
        moved = tuple(each.thing.id for each in fact.moved)
        # What was there already is spoken of as well.
        self._things += moved or (named((action,)) if isinstance(action, MoveThings) else ())
        added = tuple(thing.id for thing in fact.added)
        self._listed = (*(name for name in self._listed if name not in added), *added)
        self._batch += added
        for thing in fact.added:
            if thing.id in self._added:
                self._added.remove(thing.id)  # undone, and given again
            self._added.append(thing.id)
        if isinstance(action, Remove):
            self._taken += tuple(thing.id for thing in fact.removed)
            self._things += tuple(name for name in self._before if kind_of(name) == action.kind)
        self._removed = isinstance(action, Remove) or (bool(fact.removed) and not fact.added)
        if isinstance(action, MoveThings):
            self._kind = None  # "another to lane 2" is not one more
        elif not isinstance(action, Swap) and action.kind != "everything":
            self._kind = action.by if isinstance(action, Replace) else action.kind
        self._where = _fixed_place(_place_of(action), fact)

    def _record_answer(self, answer: Mapping[str, Any], facts: tuple[Fact, ...]) -> None:
        told = tuple(cause["id"] for cause in answer.get("causes", ()) if cause.get("id"))
        seen = tuple(thing["id"] for thing in answer.get("seen", ()))
        asked = [fact for fact in facts if isinstance(fact, Asked)]
        if asked and seen and asked[-1].ask.count == 1 and seen[0] in self._listed:
            self._before, self._things = self._things, seen  # one of those that were told before
            return
        if not asked or not (told or seen):
            return
        self._set_episode(asked[-1].timeline.state.world)
        self._listed = self._batch = told or seen
        self._told = True
        if told or asked[-1].ask.kind is not None:  # all that is seen is too much for "them"
            self._before, self._things = self._things, told or seen

    def _set_episode(self, world: World) -> None:
        """Forget all things unless they belong to the episode of this world."""
        if self._episode != _episode(world):
            self._forget_things()
            self._episode = _episode(world)

    def _forget_things(self) -> None:
        self._things = ()
        self._before = ()
        self._listed = self._batch = ()
        self._added.clear()

    def to_json(self) -> dict[str, Any]:
        """The memory as JSON values."""
        return {
            "things": [*self._things],
            "before": [*self._before],
            "added": [*self._added],
            "actions": contract.dump(self._actions),
            "said": self._said,
            "steps": self._steps,
            "changed": contract.dump(self._changed),
            "changed_steps": self._changed_steps,
            "latest_steps": [*self._latest_steps],
            "away": [*self._away],
            "listed": [*self._listed],
            "batch": [*self._batch],
            "told": self._told,
            "taken": [*self._taken],
            "undone": self._undone,
            "kind": self._kind,
            "removed": self._removed,
            "where": None if self._where is None else asdict(self._where),
            "episode": self._episode,
        }

    @classmethod
    def from_json(cls, values: Mapping[str, Any]) -> Conversation:
        """The memory from JSON values. Raises `ValueError`, `TypeError` or `LookupError`."""
        new, where = cls(), values["where"]
        new._things, new._before = tuple(values["things"]), tuple(values.get("before", ()))
        new._added.extend(values["added"])
        new._actions = contract.load(values["actions"])
        new._said, new._steps, new._listed = values["said"], values["steps"], tuple(values["listed"])
        new._changed = contract.load(values["changed"]) if values.get("changed") else ()
        new._changed_steps = values.get("changed_steps", 0)
        new._batch, new._told = tuple(values.get("batch", ())), bool(values.get("told"))
        new._taken = tuple(values.get("taken", ()))
        new._latest_steps = tuple(values.get("latest_steps", ()))
        new._away = tuple(values.get("away", ()))
        new._undone, new._removed, new._kind = values["undone"], values["removed"], values["kind"]
        if where is not None:
            new._where = _places().validate_python(where)
        if values["episode"] is not None:
            number, start = values["episode"]
            new._episode = number, start
        return new

    def topic(self, state: SimState, phrases: Phrases, names: Iterable[str] = ()) -> Topic:
        """What a sentence said now may refer to; `names` are those of bookmarks."""
        world = state.world
        there = self._ids_on(world) if self._episode == _episode(world) else frozenset[str]()
        kinds: set[str | None] = {str(kind_of(name)) for name in self._things if name in there}
        kinds = kinds or {self._kind}
        return Topic(
            things=tuple(name for name in self._things if name in there),
            before=tuple(name for name in self._before if name in there and name not in self._things),
            added=tuple(name for name in self._added if name in there),
            actions=self._actions,
            request=self._said_actions or self._actions,
            asked=self._asked,
            said=self._said,
            steps=self._steps,
            changed=self._changed,
            changed_steps=self._changed_steps,
            steps_before=self._latest_steps[0] if len(self._latest_steps) > 1 else 0,
            away=self._away,
            named=named(self._actions),
            listed=self._listed if there else (),
            batch=self._batch if there else (),
            gone=frozenset(name for name in self._listed if name not in there),
            undone=self._undone,
            kind=self._kind,
            tick=self._tick,
            offered=self._offered,
            others=self._count_others(there, kinds),
            removed=self._removed,
            where=self._where,
            phrases=phrases,
            names=frozenset(name.casefold() for name in names),
            columns=world.road.columns,
            step_seconds=state.config.step_seconds,
            now=Present(state),
        )

    def _ids_on(self, world: World) -> frozenset[str]:
        """The ids of all things on a road; kept, since a world is asked for many times before it changes."""
        known = self._ids
        if known is None or known[0] is not world.movers or known[1] is not world.hazards:
            found = frozenset((*world.movers.values(), *world.hazards.values()))
            known = self._ids = world.movers, world.hazards, found
        return known[2]

    def _count_others(self, there: frozenset[str], kinds: set[str | None]) -> int:
        """How many things of some kinds there are beside those spoken of."""
        if kinds == {None}:
            return 0
        return sum(name.rpartition("-")[0] in kinds for name in there.difference(self._things))


def _episode(world: World) -> Episode:
    return world.episode, world.episode_start


def _moves_things(fact: Applied) -> bool:
    return isinstance(fact.action, Add | Remove | SetCount | Rearranging | Reset)


def _place_of(action: Add | Remove | SetCount | Rearranging) -> Where | None:
    """Where an action put things, or took them from."""
    match action:
        case MoveThings(to=to) | Copy(to=to):
            return to
        case Add(where=where) | Remove(where=where) | Replace(where=where):
            return where
        case _:
            return None


@cache
def _places() -> TypeAdapter[Where]:
    return TypeAdapter(Where)  # at the first use: building it takes as long as a small import


def _fixed_place(where: Where | None, fact: Applied) -> Where | None:
    """The place of an action as lane, row or cell, which stays when the vehicle moves; None without."""
    if where is None or (where.distance_m, where.cells, where.nearest, where.id, where.of) == (None,) * 5:
        return where
    cells = {thing.cell for thing in (*fact.added, *fact.removed, *(each.thing for each in fact.moved))}
    rows = {row for _, row in cells}
    if len(cells) == 1:
        return Where(lane=where.lane, cell=cells.pop())
    return Where(lane=where.lane, row=rows.pop()) if len(rows) == 1 else None
