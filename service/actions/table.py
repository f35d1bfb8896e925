"""The table of actions: what each of them is, in one place.

All other modules read this table: sessions (transactions, undo, dry runs, availability), the interpreter, the
grammar and the language model. A new action is a dataclass, a row here, a handler
(`service.sessions.action_handlers`; actions that change the world have one: `sim.session.edits.apply`), the
words for it (`prompts/language`, `prompts/sayings`) and a test. An action without a row fails the import.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Final, cast

from service.actions.action import ACTION_TYPES, Action, Ask, Forget, Teach
from service.actions.evaluation import Advise, Evaluate, EvaluationTalk, FindWorst
from service.actions.goals import Goal, Style
from service.actions.steering import (
    Chat,
    Drop,
    Hide,
    Load,
    Pause,
    Record,
    Redo,
    Resume,
    Rewind,
    Save,
    Show,
    Step,
    Undo,
)
from sim.actions import (
    Add,
    Adjust,
    Cancel,
    Copy,
    Drive,
    MoveThings,
    Prefer,
    Remove,
    Replace,
    Reset,
    Scenario,
    Set,
    SetCount,
    SetMode,
    Swap,
    Trigger,
    WorldAction,
)

PLAYBACK_SPEED: Final = "playback_speed"
"""The one parameter that is no setting of a world: how fast the clock plays a session."""


class ModelUse(StrEnum):
    """What a language model may make of a sentence that the grammar refused."""

    NEVER = "never"
    """not even offered"""
    CONFIRMED = "confirmed"
    """offered as a sentence to be confirmed, whatever the settings say"""
    UNCONFIRMED = "unconfirmed"
    """done at once where the settings allow unconfirmed changes"""
    ALWAYS = "always"
    """done at once: it changes no session"""


class WhatIf(StrEnum):
    """What becomes of an action inside a what-if question."""

    IMAGINED = "imagined"
    """part of the imagined run, where it is available"""
    NO_EFFECT = "no_effect"
    """allowed and without effect, since it leaves the road as it is"""
    REFUSED = "refused"
    """refused in words: an imagined run has no past to go back to"""
    INVALID = "invalid"
    """not valid: questions and phrases stand in no other action"""


@dataclass(frozen=True, slots=True, kw_only=True)
class ActionTraits:
    """What one kind of action is."""

    offered: bool = True
    """whether this version does it; the rest is understood and refused in words"""
    changes_session: bool = True
    """whether it is stored when nothing else is said with it"""
    changes_world: bool = False
    """whether it is an entry in the log of the road, done by `sim.session.edits`"""
    undo_step: bool = False
    """whether it is a step of undo"""
    is_question: bool = False
    """whether it is answered and does nothing"""
    changes_aliases: bool = False
    """whether it changes taught phrases, which belong to their owner and to no session"""
    runs_ticks: bool = False
    """whether ticks are run for it"""
    takes_decisions: bool = False
    """whether planners decide again for it"""
    searches: bool = False
    """whether it may take seconds, so that it is done in a thread and not tried beforehand"""
    stands_for_others: bool = False
    """whether it is stored as the actions that it came to"""
    tried: bool = False
    """whether it is quick enough to be tried on a copy, to know if it is possible now"""
    model: ModelUse = ModelUse.NEVER
    what_if: WhatIf = WhatIf.IMAGINED
    separates_settings: bool = False
    """whether a setting may be one thing before it and another after it: time passes, or something is told"""
    amendable: bool = False
    """whether a correction ("no, three") can do it anew, after an undo where it is a step of undo"""
    additive: bool = False
    """whether saying it again comes on top of what was done before"""
    small_talk: bool = False
    """whether it is only manners, which say nothing beside a request"""
    idempotent: bool = False
    """whether saying it twice in a row for emphasis is saying it once"""
    loses: bool = False
    """whether something that is there may be gone afterwards: never suggested for something unrelated"""
    gathers: bool = False
    """whether several requests may say its parts: "run 200 episodes and compare A* with DWA" is one action"""


def _world(
    model: ModelUse,
    *,
    tried: bool = False,
    amendable: bool = False,
    additive: bool = False,
    gathers: bool = False,
    what_if: WhatIf = WhatIf.IMAGINED,
    loses: bool = False,
) -> ActionTraits:
    """An action that changes the world, which is always a step of undo."""
    return ActionTraits(
        changes_world=True,
        undo_step=True,
        model=model,
        tried=tried,
        amendable=amendable,
        additive=additive,
        gathers=gathers,
        what_if=what_if,
        loses=loses,
    )


def _view() -> ActionTraits:
    return ActionTraits(
        changes_session=False, model=ModelUse.ALWAYS, what_if=WhatIf.NO_EFFECT, amendable=True
    )


_TABLE: Final[Mapping[type, ActionTraits]] = {
    Add: _world(ModelUse.UNCONFIRMED, tried=True, amendable=True, additive=True),
    Remove: _world(ModelUse.UNCONFIRMED, tried=True, amendable=True, additive=True, loses=True),
    SetCount: _world(ModelUse.UNCONFIRMED, tried=True, amendable=True, loses=True),
    MoveThings: _world(ModelUse.UNCONFIRMED, tried=True, amendable=True, additive=True),
    Swap: _world(ModelUse.UNCONFIRMED, tried=True, amendable=True, additive=True),
    Replace: _world(ModelUse.UNCONFIRMED, tried=True, amendable=True, loses=True),
    Copy: _world(ModelUse.UNCONFIRMED, tried=True, amendable=True, additive=True),
    Scenario: _world(ModelUse.CONFIRMED, gathers=True, loses=True),
    Reset: _world(ModelUse.CONFIRMED, loses=True),
    SetMode: _world(ModelUse.UNCONFIRMED, tried=True, amendable=True),
    Drive: _world(ModelUse.UNCONFIRMED, amendable=True, additive=True),
    Set: _world(ModelUse.UNCONFIRMED, amendable=True),
    Adjust: _world(ModelUse.UNCONFIRMED, amendable=True, additive=True),
    Prefer: _world(ModelUse.UNCONFIRMED, amendable=True),
    Trigger: _world(ModelUse.NEVER, what_if=WhatIf.INVALID),
    Cancel: _world(ModelUse.NEVER, tried=True, what_if=WhatIf.INVALID),
    Goal: ActionTraits(
        undo_step=True,
        searches=True,
        stands_for_others=True,
        model=ModelUse.CONFIRMED,
        what_if=WhatIf.REFUSED,
    ),
    Style: ActionTraits(undo_step=True, stands_for_others=True, tried=True, model=ModelUse.UNCONFIRMED),
    Pause: ActionTraits(tried=True, model=ModelUse.UNCONFIRMED, idempotent=True, amendable=True),
    Resume: ActionTraits(tried=True, model=ModelUse.UNCONFIRMED, idempotent=True, amendable=True),
    Step: ActionTraits(
        runs_ticks=True, takes_decisions=True, separates_settings=True, model=ModelUse.UNCONFIRMED
    ),
    Undo: ActionTraits(
        tried=True,
        runs_ticks=True,
        takes_decisions=True,
        model=ModelUse.UNCONFIRMED,
        what_if=WhatIf.REFUSED,
        loses=True,
    ),
    Redo: ActionTraits(
        tried=True,
        runs_ticks=True,
        takes_decisions=True,
        model=ModelUse.UNCONFIRMED,
        what_if=WhatIf.REFUSED,
    ),
    Rewind: ActionTraits(
        tried=True,
        runs_ticks=True,
        undo_step=True,
        separates_settings=True,
        model=ModelUse.CONFIRMED,
        what_if=WhatIf.REFUSED,
        loses=True,
    ),
    Show: _view(),
    Hide: _view(),
    Ask: ActionTraits(
        changes_session=False,
        is_question=True,
        amendable=True,
        separates_settings=True,
        model=ModelUse.ALWAYS,
        what_if=WhatIf.INVALID,
    ),
    Chat: ActionTraits(changes_session=False, small_talk=True, model=ModelUse.ALWAYS, what_if=WhatIf.INVALID),
    Advise: ActionTraits(
        changes_session=False,
        is_question=True,
        amendable=True,
        model=ModelUse.ALWAYS,
        what_if=WhatIf.NO_EFFECT,
    ),
    Evaluate: ActionTraits(
        changes_session=False,
        searches=True,
        separates_settings=True,
        model=ModelUse.CONFIRMED,
        what_if=WhatIf.NO_EFFECT,
        gathers=True,
    ),
    EvaluationTalk: ActionTraits(changes_session=False, model=ModelUse.CONFIRMED, what_if=WhatIf.NO_EFFECT),
    FindWorst: ActionTraits(
        changes_session=False,
        separates_settings=True,
        model=ModelUse.CONFIRMED,
        what_if=WhatIf.NO_EFFECT,
        gathers=True,
    ),
    Save: ActionTraits(separates_settings=True, model=ModelUse.NEVER, what_if=WhatIf.NO_EFFECT),
    Load: ActionTraits(
        tried=True,
        undo_step=True,
        separates_settings=True,
        model=ModelUse.NEVER,
        what_if=WhatIf.REFUSED,
        loses=True,
    ),
    Record: ActionTraits(offered=False, model=ModelUse.CONFIRMED, what_if=WhatIf.NO_EFFECT),
    Teach: ActionTraits(changes_aliases=True, model=ModelUse.NEVER, what_if=WhatIf.INVALID),
    Drop: ActionTraits(changes_session=False, model=ModelUse.ALWAYS, what_if=WhatIf.NO_EFFECT),
    Forget: ActionTraits(changes_aliases=True, model=ModelUse.NEVER, what_if=WhatIf.INVALID),
}

if missing := set(ACTION_TYPES) ^ set(_TABLE):
    raise AssertionError(f"actions without a row in the table, or rows without an action: {missing}")


def verb(kind: type) -> str:
    """The `do` of a class of actions."""
    return cast(str, kind.__dataclass_fields__["do"].default)  # type: ignore[attr-defined]


BY_VERB: Final[Mapping[str, ActionTraits]] = {verb(kind): traits for kind, traits in _TABLE.items()}
"""The traits by `do`, for those that work on JSON values."""


def traits_of(action: Action) -> ActionTraits:
    """The traits of an action."""
    return _TABLE[type(action)]


def types_where(condition: Callable[[ActionTraits], bool]) -> tuple[type, ...]:
    """The classes of the actions for which a condition holds; for `isinstance`."""
    return tuple(kind for kind, traits in _TABLE.items() if condition(traits))


def verbs_where(condition: Callable[[ActionTraits], bool]) -> frozenset[str]:
    """The `do` of the actions for which a condition holds."""
    return frozenset(name for name, traits in BY_VERB.items() if condition(traits))


def is_world_action(action: Action) -> bool:
    """Whether an action changes the world; playback speed is set by the same classes and does not."""
    return _TABLE[type(action)].changes_world and not sets_playback_speed(action)


def sets_playback_speed(action: Action) -> bool:
    """Whether an action is about the clock's speed, and so about no world."""
    return isinstance(action, Set | Adjust) and action.parameter == PLAYBACK_SPEED


def imagined_actions(actions: tuple[Action, ...]) -> list[WorldAction]:
    """Those of some actions that make a difference in an imagined run."""
    return [
        cast(WorldAction, action)
        for action in spelled_out(actions)
        if is_world_action(action) and traits_of(action).what_if is WhatIf.IMAGINED
    ]


def spelled_out(actions: tuple[Action, ...]) -> tuple[Action, ...]:
    """The actions with what each style stands for in its place. Raises `KeyError` for an unknown style."""
    if not any(isinstance(action, Style) for action in actions):
        return actions
    from service.styles import styles  # which reads actions itself

    return tuple(
        part
        for action in actions
        for part in (styles()[action.style] if isinstance(action, Style) else (action,))
    )
