"""Facts: what each action of an utterance did. Replies, changes and answers are made from them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

from service.actions import Action, Ask, Goal, Style
from service.actions.evaluation import EvaluationWish
from service.sessions.bookmarks import Bookmarked, Jumped
from service.sessions.pending import NO_TALK, Talk
from service.sessions.scheduler.playback_speed import NORMAL, PlaybackSpeed, PlaybackSpeedSet
from service.store import JobRecord
from sim.evaluate import Evaluation
from sim.falsify import Falsification
from sim.goals import Finding
from sim.hazard_advice import Advice
from sim.planner_names import PlannerName
from sim.session.edits import Applied, Change
from sim.session.timeline import Timeline
from sim.state import SimState, StepResult


@dataclass(frozen=True, slots=True)
class Resolved:
    """A goal or a style was done: what it came to, and for a goal what was found."""

    action: Goal | Style
    done: tuple[Applied, ...]
    finding: Finding | None = None


@dataclass(frozen=True, slots=True)
class PauseSet:
    """The clock was stopped or started at a tick; `before` is whether it stood."""

    before: bool
    paused: bool
    tick: int


@dataclass(frozen=True, slots=True)
class Stepped:
    """Ticks were run at once, from `first_tick` on."""

    first_tick: int
    ticks: tuple[StepResult, ...]


@dataclass(frozen=True, slots=True)
class Undone:
    """Changes were undone, or (`again`) redone; `changes` are the differences in the state."""

    again: bool
    changes: tuple[Change, ...]
    steps: int = 1
    """how many steps were undone or redone"""


@dataclass(frozen=True, slots=True)
class Asked:
    """A question, with the timeline as it was at the question's place in the utterance."""

    ask: Ask
    timeline: Timeline
    supposes: str | None = None
    """what the question takes for granted, beyond its keys: a `crash`, or that a `number` is asked for"""
    playback_speed: PlaybackSpeed = NORMAL
    """the clock's, which no timeline has"""
    talk: Talk = NO_TALK
    """the conversation as it was, for questions about it"""
    length: str | None = None
    """`shorter` or `longer`, where an answer is wanted so"""
    viewed: int | None = None
    """the past tick that was looked at when it was asked"""
    paused: bool = False
    """whether the clock stood"""


@dataclass(frozen=True, slots=True)
class Advised:
    """Advice about a hazard; `tick` is None outside of any session."""

    advice: Advice
    tick: int | None = None


@dataclass(frozen=True, slots=True)
class Viewed:
    """A view is shown or hidden for all subscribers; the session itself does not change."""

    view: str
    shown: bool


@dataclass(frozen=True, slots=True)
class Chatted:
    """Small talk of a kind; nothing was done."""

    kind: str


@dataclass(frozen=True, slots=True)
class JobAsked:
    """An evaluation or a search for failures is asked for.

    `job` is its id once it is started, which a replay never does.
    """

    evaluation: Evaluation | Falsification
    job: str | None = None


@dataclass(frozen=True, slots=True)
class JobTold:
    """How an evaluation stands, or its end; `job` is None where there is none, as in a replay."""

    want: EvaluationWish
    planners: tuple[PlannerName, ...] | None = None
    """of whom one was better, where they are named"""
    known: bool = False
    """whether it was looked for"""
    job: JobRecord | None = None
    cancelled: bool = False
    """whether it was under way, and is cancelled now"""


@dataclass(frozen=True, slots=True)
class Dropped:
    """The pending question was dropped; `question` is None where nothing was pending."""

    question: str | None


@dataclass(frozen=True, slots=True)
class AliasChange:
    """A phrase was taught or forgotten, with the sentence that means the same."""

    phrase: str
    sentence: str
    taught: bool
    before: str | None = None
    """the former meaning, as a sentence"""


Answerable: TypeAlias = Asked | Advised
"""Facts that are answered and change nothing."""

Fact: TypeAlias = (
    Applied
    | Resolved
    | PauseSet
    | PlaybackSpeedSet
    | Stepped
    | Undone
    | Bookmarked
    | Jumped
    | Viewed
    | Chatted
    | Dropped
    | JobAsked
    | JobTold
    | Answerable
)


def spread_facts(facts: Sequence[Fact]) -> Iterator[Fact]:
    """The facts as a replay would make them: each goal and style as what it came to, no job started."""
    for fact in facts:
        if isinstance(fact, Resolved):
            yield from fact.done
        elif isinstance(fact, JobAsked):
            yield replace(fact, job=None)
        elif isinstance(fact, JobTold):
            yield JobTold(fact.want, fact.planners)
        else:
            yield fact


def performed_actions(actions: Sequence[Action], facts: Sequence[Fact]) -> tuple[Action, ...]:
    """The actions of an utterance, each goal and style as what it came to; one fact stands for each."""
    performed: list[Action] = []
    for action, fact in zip(actions, facts, strict=True):
        performed += [each.action for each in fact.done] if isinstance(fact, Resolved) else [action]
    return tuple(performed)


def merge_changes(facts: tuple[Fact, ...]) -> tuple[Change, ...]:
    """The differences after all facts together, each path once, in the order of first change."""
    merged: dict[str, Change] = {}
    for fact in spread_facts(facts):
        for change in _changes(fact):
            first = merged.get(change.path, change)
            merged[change.path] = Change(change.path, first.before, change.after)
    return tuple(change for change in merged.values() if change.before != change.after)


def merge_views(facts: tuple[Fact, ...]) -> dict[str, bool]:
    """Which views to show and which to hide; the last fact about a view wins."""
    return {fact.view: fact.shown for fact in facts if isinstance(fact, Viewed)}


def question_timelines(facts: tuple[Fact, ...]) -> list[Timeline]:
    """The timelines that the questions are about."""
    return [fact.timeline for fact in facts if isinstance(fact, Asked)]


def parts_with_events(facts: tuple[Fact, ...]) -> list[tuple[SimState, Applied | StepResult]]:
    """The parts that may have events, each with the state after it, in order."""
    parts: list[tuple[SimState, Applied | StepResult]] = []
    for fact in spread_facts(facts):
        if isinstance(fact, Applied):
            parts.append((fact.state, fact))
        elif isinstance(fact, Stepped):
            parts += [(tick.state, tick) for tick in fact.ticks]
    return parts


def _changes(fact: Fact) -> tuple[Change, ...]:
    match fact:
        case Applied() | Undone():
            return fact.changes
        case PauseSet():
            return (Change("paused", fact.before, fact.paused),)
        case PlaybackSpeedSet():
            return (Change("playback_speed", fact.before, fact.after),)
        case Stepped():
            return (Change("tick", fact.first_tick, fact.first_tick + len(fact.ticks)),)
        case Jumped():
            return (Change("tick", fact.before, fact.tick), *fact.changes)
        case Resolved():
            return tuple(change for each in fact.done for change in each.changes)
        case Asked() | Advised() | Bookmarked() | Viewed() | Chatted() | Dropped() | JobAsked() | JobTold():
            return ()


@dataclass(frozen=True, slots=True)
class SideBySideTexts:
    """Two runs beside each other in words: what differs, and how each of the two ends."""

    difference: str
    real_end: str
    changed_end: str
