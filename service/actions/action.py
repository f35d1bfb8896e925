"""Actions that hold other actions (questions, taught phrases), and the union of all actions.

Grammar, language model, voice and typed REST calls all produce an `Action`. Actions that change a world are
`sim.actions`. Pydantic validates plain dataclasses; `None` means "not said" and is left out of JSON.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields
from typing import Annotated, Any, Literal, TypeAlias, get_args

from annotated_types import Ge, Gt, Le, MaxLen, MinLen
from pydantic import ConfigDict, Discriminator, TypeAdapter
from pydantic_core import to_json

from service.actions.evaluation import Advise, Evaluate, EvaluationTalk, FindWorst
from service.actions.facts import FactName, Term
from service.actions.goals import Goal, Style
from service.actions.parameters import MAX_PARAMETERS, PhraseParameter, figure
from service.actions.question_names import (
    BlameName,
    Choosable,
    DetailName,
    HistoryName,
    MetricName,
    MomentName,
    OtherName,
    OutlookName,
    PartName,
    PastMoveName,
    PlannersName,
    PolicyName,
    QuestionName,
    ScaleName,
    SeedsName,
    SideName,
    SightName,
    SoFarName,
    SoonerName,
    WantName,
    WorldName,
)
from service.actions.questions import (
    COUNTED,
    HISTORY_KEYS,
    OF_A_KIND,
    QUESTIONS,
    WHAT_KEYS,
    WHATS,
    QuestionTraits,
)
from service.actions.steering import (
    STRICT,
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
    Ticks,
    Undo,
)
from sim.actions import Cancel, Parameter, PlaceableKind, Set, Trigger, Where, WorldAction
from sim.config import CHOICES
from sim.planner_names import PlannerName
from sim.sensor_names import SensorName
from sim.types import Move

Phrase = Annotated[str, MinLen(1), MaxLen(80)]
MAX_MEANT = 50
"""How many actions a what-if or a taught phrase may hold."""
MAX_AHEAD = 100
"""Ticks after which it may be asked where another road user is."""
MAX_PLANNERS = 8
"""How many planners one question may name."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Which(Where):
    """A road user that is asked about: the nearest one of a kind at a place, or one by its id."""

    kind: PlaceableKind | None = None

    __pydantic_config__ = STRICT

    def __post_init__(self) -> None:
        if self.kind is None and self.id is None:
            raise ValueError("say 'kind' or 'id'")


@dataclass(frozen=True, slots=True, kw_only=True)
class Ask:
    """A question; which keys belong to which `about` is the contract's table."""

    do: Literal["ask"] = "ask"
    about: QuestionName
    move: Move | None = None
    instead: Move | None = None
    """the move that another one is compared with"""
    tick: Annotated[int, Ge(0)] | None = None
    change: Annotated[tuple[Action, ...], MinLen(1), MaxLen(MAX_MEANT)] | None = None
    kind: PlaceableKind | None = None
    metric: MetricName | None = None
    parameter: Parameter | Choosable | None = None
    value: int | float | str | None = None
    """the value that a setting is asked to have: answered by yes or no first"""
    term: Term | None = None
    fact: FactName | None = None
    what: (
        HistoryName
        | OtherName
        | OutlookName
        | BlameName
        | PlannersName
        | MomentName
        | PolicyName
        | SoonerName
        | SideName
        | ScaleName
        | SeedsName
        | PastMoveName
        | SoFarName
        | SightName
        | WorldName
        | None
    ) = None
    until: Annotated[int, Ge(0)] | None = None
    """the last tick of a stretch that begins at `tick`"""
    ticks: Ticks | None = None
    """how far back a question about the past goes, instead of from `tick`"""
    seconds: Annotated[float, Gt(0), Le(100_000)] | None = None
    """the same in seconds"""
    count: Annotated[int, Ge(1), Le(1000)] | None = None
    """how many of the latest changes are meant, or moments looked for; 1 of a kind of things: the nearest; of
    a what if, how many times it is done: moves, one a tick; of another one, after how many ticks"""
    how: DetailName | None = None
    which: Which | None = None
    planners: Annotated[tuple[PlannerName, ...], MinLen(1), MaxLen(MAX_PLANNERS)] | None = None
    """the planners that are asked about, where not all of them"""
    planner: PlannerName | None = None
    want: WantName | None = None
    part: PartName | None = None
    lane: Annotated[int, Ge(1)] | None = None
    """the lane in which what is counted was decided, from 1 at the left"""

    __pydantic_config__ = STRICT

    def __post_init__(self) -> None:
        traits = QUESTIONS.get(self.about, QuestionTraits())
        for key in _ASK_KEYS:
            said = getattr(self, key) is not None
            if said and key not in traits.may:
                raise ValueError(f"'{key}' does not belong to a question about {self.about}")
            if not said and key in traits.must:
                raise ValueError(f"a question about {self.about} needs '{key}'")
        if self.about == "setting" and self.parameter in get_args(Choosable):
            raise ValueError(f"'{self.parameter}' has options and no value")
        if self.about == "scene" and self.count is not None and (self.count != 1 or self.kind is None):
            raise ValueError("a question about the scene counts one thing, the nearest of a kind")
        if self.about == "history":
            self._check_counted()
        if self.about == "outlook" and self.kind is not None and self.what not in OF_A_KIND:
            raise ValueError(
                "of the time ahead, other road users and what is dangerous are asked of a kind of things"
            )
        if self.about in ("outlook", "what_if") and (self.lane is None) is (self.what in _OF_A_LANE):
            raise ValueError("of a lane it is asked why it is not taken, and what if it had been driven in")
        if self.what == "stays_free" and self.move not in _BESIDE_OR_AHEAD:
            raise ValueError("the space ahead, on the left or on the right stays free")
        if self.about == "sight":
            self._check_sight()
        if self.about == "what_if" and (self.kind is None) is (self.what in get_args(ScaleName)):
            raise ValueError("of a kind of things it is asked what if there were half or twice as many")
        supposed = self.what in _SUPPOSED
        if self.about == "what_if" and sum((self.change is not None, self.move is not None, supposed)) != 1:
            raise ValueError("say exactly one of 'change' and 'move', or what is supposed of the drive")
        if (
            self.about == "other"
            and self.count is not None
            and (self.what != "going" or self.count > MAX_AHEAD)
        ):
            raise ValueError("'count' is of where another one goes, within some ticks")
        if self.what in get_args(SoFarName) and not self._varies_settings():
            raise ValueError(
                "of the drive so far another planner, sensor, weather or time of day is supposed,"
                " or courtesy or sensor noise 0"
            )
        if self.what in get_args(PastMoveName) and self.move is None:
            raise ValueError("of a move that was made it is said which is supposed instead")
        if self.about == "what_if" and self.count is not None and self.change is None:
            raise ValueError("'count' says how many times a 'change' is made")
        if self.what is not None:
            self._check_what(self.what)
        if sum(each is not None for each in (self.tick, self.ticks, self.seconds)) > 1:
            raise ValueError("say one of 'tick', 'ticks' and 'seconds'")
        _refuse_kinds(
            "it cannot be asked what if to", self.change or (), (Ask, Chat, Teach, Forget, Trigger, Cancel)
        )

    def _varies_settings(self) -> bool:
        """Whether a change is of settings that a drive can be driven again with, each named once."""
        change = self.change or ()
        settings = [each for each in change if isinstance(each, Set)]
        named = [each.parameter for each in settings if isinstance(each.value, str)]
        named += [each.parameter for each in settings if each.parameter in _SUPPOSED_OFF and each.value == 0]
        known = set(named) <= {"planner", "sensor", "weather", "time_of_day", *_SUPPOSED_OFF}
        return bool(change) and len(set(named)) == len(change) and known and self.count is None

    def _check_sight(self) -> None:
        """Raise `ValueError` where a kind of things or a sensor does not belong to what is asked."""
        if self.what == "detection" and self.kind is None and self.value is None:
            raise ValueError("detection is asked of a kind of things or of a sensor")
        if self.kind is not None and self.what not in _OF_A_KIND:
            raise ValueError(f"of sensing, {', '.join(_OF_A_KIND)} alone are asked of a kind of things")
        named = self.value in get_args(SensorName) and self.value != "perfect"
        if self.value is not None and not (self.what in _OF_A_SENSOR and named):
            raise ValueError(f"of one sensor, {', '.join(_OF_A_SENSOR)} are asked, and it is one that errs")

    def _is_no_stretch(self) -> bool:
        return self.what not in ("stopped", "moving", *(("sighted",) if self.want == "share" else ()))

    def _check_counted(self) -> None:
        """Raise `ValueError` where a condition does not belong to what is counted over a drive."""
        named = {key for key in _CONDITIONS if getattr(self, key) is not None}
        if odd := sorted(named - COUNTED.get(str(self.what), frozenset())):
            raise ValueError(f"'{odd[0]}' does not belong to a question about {self.what}")
        if self.want in ("longest", "share") and self._is_no_stretch():
            raise ValueError("only stops and what is between them are long or short, or a share of the time")
        if (
            self.what == "lanes_used"
            and self.want is not None
            and (self.want, self.lane) != ("whether", self.lane or 0)
        ):
            raise ValueError("of one lane it is asked whether it was used")
        if self.what == "closest_call" and self.count is not None and self.kind is not None:
            raise ValueError("say 'count' or 'kind'")
        if self.what == "sighted" and self.want == "list":
            raise ValueError("of what was detected the first or the last is told, or whether")
        if self.which is not None and (self.what not in _OF_A_THING or self.kind is not None):
            raise ValueError("'which' is of what was detected, and says its kind")
        if self.what == "ended" and self.metric not in ("crashes", "successes"):
            raise ValueError("ends are crashes or successes")
        if self.what == "made" and self.move == Move.STAY:
            raise ValueError("a move that is made leads somewhere: stays are stops")
        if self.what == "lane_changes" and self.move in (Move.STAY, Move.FORWARD):
            raise ValueError("a lane is changed to a side")
        if self.what == "ended" and self.kind is not None and self.metric != "crashes":
            raise ValueError("only crashes are asked of a kind of things")
        if self.what == "ended" and self.part in ("first_half", "second_half"):
            raise ValueError("an episode ends in no half of it")
        if self.part is not None and any(each is not None for each in (self.tick, self.ticks, self.seconds)):
            raise ValueError("say ticks or a 'part'")
        if self.parameter is not None or self.value is not None:
            values = CHOICES.get(str(self.parameter), ())
            if self.parameter not in ("weather", "time_of_day") or self.value not in values:
                raise ValueError("what is counted is asked of a weather or a time of day")

    def _check_what(self, what: str) -> None:
        """Raise `ValueError` unless `what` belongs to the question and all is named that it needs."""
        if what not in WHATS[self.about]:
            raise ValueError(f"'{what}' does not belong to a question about {self.about}")
        if self.about == "other":
            return  # its keys do not depend on what is asked
        keys: Mapping[Any, tuple[frozenset[str], ...]] = (
            HISTORY_KEYS if self.about == "history" else WHAT_KEYS
        )
        named = frozenset(key for key in _BESIDE_WHAT if getattr(self, key) is not None)
        if named not in keys[what]:
            ways = " or ".join(" and ".join(sorted(each)) or "nothing more" for each in keys[what])
            raise ValueError(f"a question about {what} names {ways}")
        if self.tick is not None and self.until is not None and self.until < self.tick:
            raise ValueError("a stretch of ticks ends after it begins")


_ASK_KEYS = tuple(each.name for each in fields(Ask) if each.name not in ("do", "about"))
"""All that a question may name."""
_BESIDE_WHAT = ("move", "tick", "until", "ticks", "seconds", "planners", "planner")
"""Keys that some values of `what` need, and others must not have."""

_BESIDE_OR_AHEAD = (Move.FORWARD, Move.LEFT, Move.RIGHT)
"""The moves into whose cells it is asked whether they stay free."""
_OF_A_THING = ("sighted", "last_detected", "places_before")
"""What of the past is asked of one thing."""
_OF_A_SENSOR = ("weathers", "sensor_fault", "effect", "range", "detection", "would_see", "by_device")
"""What of sensing may be asked of one sensor."""
_OF_A_KIND = ("detection", "belief", "would_see", "first_device", "missed")
"""What of sensing may be asked of a kind of things."""
_SUPPOSED_OFF = ("courtesy", "sensor_noise")
"""What may be supposed not to have been since the start."""
_SUPPOSED = tuple(
    what for names in (PolicyName, SoonerName, SideName, ScaleName, SeedsName) for what in get_args(names)
)
"""What may be supposed of a drive without a change or a move."""
_OF_A_LANE = ("lane", "to_lane")
"""What of the time ahead, and of what is supposed, is asked of a lane."""
_CONDITIONS = ("kind", "want", "part", "lane", "parameter", "value", "metric")
"""Keys that narrow down what is counted over a drive."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Teach:
    """From now on, a phrase means these actions."""

    do: Literal["teach"] = "teach"
    phrase: Phrase
    meaning: Annotated[tuple[Action, ...], MinLen(1), MaxLen(MAX_MEANT)]
    parameters: Annotated[tuple[PhraseParameter, ...], MinLen(1), MaxLen(MAX_PARAMETERS)] | None = None
    """the numbers that are said with the phrase; the meaning is then an example"""

    __pydantic_config__ = STRICT

    def __post_init__(self) -> None:
        _refuse_kinds("a phrase cannot mean to", self.meaning, (Chat, Teach, Forget))
        if self.parameters is not None:
            self._check(self.parameters)

    def _check(self, parameters: tuple[PhraseParameter, ...]) -> None:
        """Raise `ValueError` where a parameter is no word of the phrase, or stands for no figure."""
        words = self.phrase.casefold().split()
        names = [each.name.casefold() for each in parameters]
        if len(set(names)) < len(names):
            raise ValueError("two parameters have one name")
        if words[:1] == names[:1] or any(words.count(name) != 1 for name in names):
            raise ValueError("a parameter is one word of the phrase, and not its first")
        told = dump(self.meaning)
        if any(figure(told, path) is None for each in parameters for path in each.figures):
            raise ValueError("a parameter stands for figures of the meaning")


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
    | Goal
    | Style
    | Pause
    | Resume
    | Undo
    | Redo
    | Step
    | Rewind
    | Show
    | Hide
    | Ask
    | Chat
    | Evaluate
    | EvaluationTalk
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
    values: list[dict[str, Any]] = ACTIONS.dump_python(actions, mode="json", exclude_none=True, by_alias=True)
    return values
