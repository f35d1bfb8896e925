"""Utterances and their outcomes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from service.actions import Action
from service.sessions.facts import Fact, Stepped
from sim.events import Event
from sim.session.edits import Change
from sim.state import SimState, StepResult


@dataclass(frozen=True, slots=True, kw_only=True)
class Utterance:
    """Actions to be done together, and the text they were said as (None for typed actions)."""

    actions: tuple[Action, ...]
    text: str | None = None
    supposes: tuple[str | None, ...] = ()
    """for each action what it was said to be about, beyond its keys (`Asked.supposes`); empty for nothing"""
    preface: str = ""
    """what its reply begins with: as what it was read"""
    language: str | None = None
    """the language in which it is answered or refused; None is the session's"""
    at_tick: int | None = None
    """the past tick that is looked at while it is said: its questions are about that"""


@dataclass(frozen=True, slots=True)
class ReachabilityNotice:
    """Whether the vehicle can still arrive on the road that an utterance led to, in words."""

    event: Event
    text: str
    run: SimState
    """the state it is about"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """What an utterance did, or would do (dry run)."""

    utterance: Utterance
    facts: tuple[Fact, ...]
    reply: str
    answer: dict[str, Any] | None
    sequence: int
    changes: tuple[Change, ...]
    before: SimState | None = None
    """the state in which it was said"""
    done: str = ""
    """the reply without the notice, as a replay would make it"""
    notice: ReachabilityNotice | None = None

    @property
    def ticks(self) -> list[StepResult]:
        """The ticks that steps ran."""
        return [tick for fact in self.facts if isinstance(fact, Stepped) for tick in fact.ticks]

    @property
    def only_steps(self) -> bool:
        """Whether the utterance did nothing but run ticks."""
        return all(isinstance(fact, Stepped) for fact in self.facts)
