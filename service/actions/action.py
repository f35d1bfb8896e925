"""Actions that hold other actions (questions, taught phrases), and the union of all actions.

Grammar, language model, voice and typed REST calls all produce an `Action`. Actions that change a world are
`sim.actions`. Pydantic validates plain dataclasses; `None` means "not said" and is left out of JSON.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Annotated, Any, Literal, TypeAlias, get_args

from annotated_types import Ge, Le, MaxLen, MinLen
from pydantic import ConfigDict, Discriminator, TypeAdapter
from pydantic_core import to_json

from service.actions.evaluation import Advise, Evaluate, FindWorst
from service.actions.steering import (
    STRICT,
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
from sim.actions import PlaceableKind, WorldAction
from sim.types import Move

Phrase = Annotated[str, MinLen(1), MaxLen(80)]
MAX_MEANT = 50
"""How many actions a what-if or a taught phrase may hold."""
MetricName = Literal["crashes", "successes", "success_rate", "steps", "moves", "distance"]
QuestionName = Literal[
    "why",
    "why_not",
    "what_if",
    "next",
    "scene",
    "status",
    "metrics",
    "confidence",
    "maintenance",
    "help",
    "changes",
    "pending",
]


@dataclass(frozen=True, slots=True)
class QuestionTraits:
    """What a kind of question takes, and what it costs; `service.narration.answers` says who answers it."""

    may: tuple[str, ...] = ()
    """keys that it may name"""
    must: tuple[str, ...] = ()
    """those of them that it must name"""
    runs_episodes: bool = False
    """whether whole episodes are run to answer it, so that it is answered in a thread"""


QUESTIONS: Mapping[QuestionName, QuestionTraits] = {
    "why": QuestionTraits(("move", "tick")),
    "why_not": QuestionTraits(("move", "tick"), ("move",), runs_episodes=True),
    "what_if": QuestionTraits(("change",), ("change",), runs_episodes=True),
    "next": QuestionTraits(),
    "scene": QuestionTraits(("kind",)),
    "status": QuestionTraits(),
    "metrics": QuestionTraits(("metric",)),
    "confidence": QuestionTraits(runs_episodes=True),
    "maintenance": QuestionTraits(),
    "help": QuestionTraits(),
    "changes": QuestionTraits(("count", "tick")),
    "pending": QuestionTraits(),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Ask:
    """A question; which keys belong to which `about` is the contract's table."""

    do: Literal["ask"] = "ask"
    about: QuestionName
    move: Move | None = None
    tick: Annotated[int, Ge(0)] | None = None
    change: Annotated[tuple[Action, ...], MinLen(1), MaxLen(MAX_MEANT)] | None = None
    kind: PlaceableKind | None = None
    metric: MetricName | None = None
    count: Annotated[int, Ge(1), Le(1000)] | None = None

    __pydantic_config__ = STRICT

    def __post_init__(self) -> None:
        traits = QUESTIONS.get(self.about, QuestionTraits())
        for key in ("move", "tick", "change", "kind", "metric", "count"):
            said = getattr(self, key) is not None
            if said and key not in traits.may:
                raise ValueError(f"'{key}' does not belong to a question about {self.about}")
            if not said and key in traits.must:
                raise ValueError(f"a question about {self.about} needs '{key}'")
        _refuse_kinds("it cannot be asked what if to", self.change or (), (Ask, Teach, Forget))


@dataclass(frozen=True, slots=True, kw_only=True)
class Teach:
    """From now on, a phrase means these actions."""

    do: Literal["teach"] = "teach"
    phrase: Phrase
    meaning: Annotated[tuple[Action, ...], MinLen(1), MaxLen(MAX_MEANT)]

    __pydantic_config__ = STRICT

    def __post_init__(self) -> None:
        _refuse_kinds("a phrase cannot mean to", self.meaning, (Teach, Forget))


@dataclass(frozen=True, slots=True, kw_only=True)
class Forget:
    """A taught phrase means nothing any more."""

    do: Literal["forget"] = "forget"
    phrase: Phrase

    __pydantic_config__ = STRICT


def _refuse_kinds(why: str, actions: Iterable[Action], kinds: tuple[type, ...]) -> None:
    """Raise `ValueError` where an action is of a kind that must not stand inside another."""
    for action in actions:
        if isinstance(action, kinds):
            raise ValueError(f"{why} {action.do}")


Action: TypeAlias = Annotated[
    WorldAction
    | Pause
    | Resume
    | Undo
    | Redo
    | Step
    | Rewind
    | Show
    | Hide
    | Ask
    | Evaluate
    | FindWorst
    | Advise
    | Save
    | Load
    | Record
    | Teach
    | Forget
    | Drop,
    Discriminator("do"),
]

ACTION_TYPES: tuple[type, ...] = get_args(get_args(Action)[0])
"""Every class of action."""

# Built when first used: it takes a quarter of what importing this does.
ACTIONS: TypeAdapter[tuple[Action, ...]] = TypeAdapter(
    tuple[Action, ...], config=ConfigDict(defer_build=True)
)


def load(values: Any) -> tuple[Action, ...]:
    """Actions from JSON values. Raises `pydantic.ValidationError`, naming each bad field.

    Strictly: `"5"` and `true` are no numbers. (Strictness over Python values would ask for
    dataclasses where JSON has objects, hence the way through JSON.)
    """
    return ACTIONS.validate_json(to_json(values), strict=True)


def dump(actions: tuple[Action, ...]) -> list[dict[str, Any]]:
    """Actions as JSON values, in the contract's form: what was not said is absent."""
    values: list[dict[str, Any]] = ACTIONS.dump_python(actions, mode="json", exclude_none=True)
    return values
