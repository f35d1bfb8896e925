"""What the service answers, as frozen dataclasses.

Made from the documented answers and held against them by a test. Keys that are not known here are
kept in `raw`, so that a newer service can say more; a key that is missing is `UnexpectedAnswer`.
"""

from __future__ import annotations

import functools
import json
import types
from collections.abc import Iterator, Mapping
from dataclasses import MISSING, dataclass, field, fields, is_dataclass
from pathlib import Path
from typing import Any, Generic, TypeVar, Union, get_args, get_origin, get_type_hints

from service.client import html
from service.client.errors import UnexpectedAnswer

Cell = tuple[int, int]
"""Column and row; row 0 is at the goal."""

Json = Mapping[str, Any]
T = TypeVar("T")


@dataclass(frozen=True, kw_only=True)
class Result:
    """Something answered; `raw` is all of it, as it came."""

    raw: Json = field(default_factory=dict, repr=False, compare=False)


@dataclass(frozen=True)
class Vehicle:
    """An autonomous vehicle."""

    id: str
    cell: Cell
    kind: str = "av"


@dataclass(frozen=True)
class Mover:
    """An obstacle vehicle or a pedestrian."""

    id: str
    kind: str
    cell: Cell
    heading: str
    disabled: bool


@dataclass(frozen=True)
class Hazard:
    """A pothole or a barrier."""

    id: str
    kind: str
    cell: Cell


@dataclass(frozen=True)
class CrashCause:
    """What a crash was with."""

    kind: str
    how: str
    ids: tuple[str, ...]
    cell: Cell


@dataclass(frozen=True)
class Metrics:
    """Figures over a session's episodes."""

    episodes: int
    successes: int
    crashes: int
    stuck: int
    success_rate: float | None
    steps: int
    moves: Mapping[str, int]
    distance_m: float
    last_episode_ticks: int | None


@dataclass(frozen=True, kw_only=True)
class State(Result):
    """The world at a tick."""

    session: str
    tick: int
    time_s: float
    episode: int
    episode_tick: int
    status: str
    cause: CrashCause | None
    columns: int
    rows: int
    visible_rows: int
    step_seconds: float
    paused: bool
    mode: str
    planner: str
    vehicles: tuple[Vehicle, ...]
    movers: tuple[Mover, ...]
    hazards: tuple[Hazard, ...]
    metrics: Metrics
    digest: str
    sequence: int

    def things(self) -> list[Vehicle | Mover | Hazard]:
        """Everything on the road, the autonomous vehicles last."""
        return [*self.hazards, *self.movers, *self.vehicles]

    def count(self, kind: str) -> int:
        """How many things of a kind are on the road: `state.count("pothole")`."""
        return sum(thing.kind == kind for thing in self.things())

    def _repr_html_(self) -> str:
        """The road near the vehicle, for notebooks."""
        return html.road(self)


@dataclass(frozen=True)
class Option:
    """One move as the planner saw it."""

    move: str
    cell: Cell | None
    verdict: str
    cost: float | None
    reason: str
    causes: tuple[str, ...]


@dataclass(frozen=True, kw_only=True)
class Decision(Result):
    """What was decided in the world of a tick; it leads to the next."""

    tick: int
    planner: str
    move: str
    asked: str | None
    options: tuple[Option, ...]
    narration: str
    weight: int

    def _repr_html_(self) -> str:
        """Every move and what spoke for or against it, for notebooks."""
        rows = [(option.move, option.verdict, option.cost, option.reason) for option in self.options]
        return html.table(self.narration, ("move", "verdict", "cost", "reason"), rows)


@dataclass(frozen=True, kw_only=True)
class BriefDecision(Result):
    """A decision as a tick message tells it, without its options."""

    tick: int
    planner: str
    move: str
    reason: str
    causes: tuple[str, ...]
    weight: int


@dataclass(frozen=True)
class LogEvent:
    """One line of the log."""

    number: int
    tick: int
    type: str
    text: str
    ids: tuple[str, ...]
    cell: Cell | None


@dataclass(frozen=True, kw_only=True)
class SessionInfo(Result):
    """A session as it stands."""

    id: str
    name: str | None
    created_at: str
    paused: bool
    mode: str
    tick: int
    episode: int
    status: str
    sequence: int
    seed: int
    config: Json
    sentence: str | None
    links: Mapping[str, str]


@dataclass(frozen=True, kw_only=True)
class SessionSummary(Result):
    """A session in a list."""

    id: str
    name: str | None
    created_at: str
    seed: int
    live: bool
    tick: int
    links: Mapping[str, str]


@dataclass(frozen=True)
class Page(Generic[T]):
    """Part of a list; send `after` for what follows, if there is `more`."""

    items: tuple[T, ...]
    after: Any
    more: bool

    def __iter__(self) -> Iterator[T]:
        return iter(self.items)

    def __len__(self) -> int:
        return len(self.items)


@dataclass(frozen=True)
class Change:
    """One figure that differs."""

    path: str
    before: Any
    after: Any


@dataclass(frozen=True)
class Correction:
    """A word that was read as another."""

    wrote: str = field(metadata={"key": "from"})
    read: str = field(metadata={"key": "to"})


@dataclass(frozen=True, kw_only=True)
class Answer(Result):
    """The answer to a question. What else there is depends on the question, and stands in `raw`."""

    question: str
    about: str
    tick: int
    text: str


@dataclass(frozen=True, kw_only=True)
class CommandResult(Result):
    """What was done."""

    text: str | None
    actions: tuple[Json, ...]
    changes: tuple[Change, ...]
    reply: str
    answer: Answer | None
    source: str
    sequence: int
    corrections: tuple[Correction, ...]
    dry_run: bool

    def _repr_html_(self) -> str:
        """The reply and what differs, for notebooks."""
        rows = [(change.path, change.before, change.after) for change in self.changes]
        return html.table(self.reply, ("what", "before", "after"), rows)


@dataclass(frozen=True, kw_only=True)
class ConfigChanged(Result):
    """What new settings did."""

    changes: tuple[Change, ...]
    reply: str
    sequence: int


@dataclass(frozen=True, kw_only=True)
class StepResult(Result):
    """Ticks that were run."""

    ticks: int
    decisions: tuple[Decision, ...]
    state: State

    def _repr_html_(self) -> str:
        """The road afterwards, for notebooks."""
        return html.road(self.state)


@dataclass(frozen=True, kw_only=True)
class Parsed(Result):
    """What a sentence means."""

    text: str
    actions: tuple[Json, ...]
    source: str
    corrections: tuple[Correction, ...]


@dataclass(frozen=True, kw_only=True)
class Health(Result):
    """How the service does."""

    status: str
    version: str
    sessions: int
    watchers: int


@dataclass(frozen=True, kw_only=True)
class Recording(Result):
    """A session as one small file; `raw` is the file."""

    format: str
    version: int
    name: str | None
    tick: int
    digest: str
    entries: tuple[Json, ...]

    def save(self, path: str | Path) -> Path:
        """Write it; `roadtalk replay` and `Client.create(recording=...)` take it again."""
        written = Path(path)
        written.write_text(json.dumps(self.raw, ensure_ascii=False) + "\n", encoding="utf-8")
        return written


@dataclass(frozen=True)
class Frame:
    """A picture."""

    data: bytes = field(repr=False)
    media_type: str

    def save(self, path: str | Path) -> Path:
        """Write it."""
        written = Path(path)
        written.write_bytes(self.data)
        return written

    def _repr_html_(self) -> str:
        return html.picture(self.data, self.media_type)


def read(kind: Any, value: Any, where: str = "the answer") -> Any:
    """A JSON value as `kind`. Raises `UnexpectedAnswer`, saying where."""
    if kind is Any:
        return value
    origin, inner = get_origin(kind), get_args(kind)
    if origin in (Union, types.UnionType):
        known = [each for each in inner if each is not type(None)]
        return None if value is None else read(known[0], value, where)
    if origin is tuple:
        _check(isinstance(value, list), where, "a list", value)
        if inner[-1] is Ellipsis:
            return tuple(read(inner[0], item, f"{where}.{number}") for number, item in enumerate(value))
        _check(len(value) == len(inner), where, f"{len(inner)} values", value)
        return tuple(
            read(each, item, f"{where}.{number}")
            for number, (each, item) in enumerate(zip(inner, value, strict=True))
        )
    if origin is not None and issubclass(origin, Mapping):
        _check(isinstance(value, dict), where, "an object", value)
        return {key: read(inner[1], item, f"{where}.{key}") for key, item in value.items()}
    if is_dataclass(kind):
        return _object(kind, value, where)
    expected = (int, float) if kind is float else kind
    right = isinstance(value, expected) and (kind is bool or not isinstance(value, bool))
    _check(right, where, kind.__name__, value)
    return value


def read_page(kind: type[T], value: Any) -> Page[T]:
    """A JSON page of `kind`."""
    _check(isinstance(value, dict) and isinstance(value.get("items"), list), "the answer", "a page", value)
    items = tuple(read(kind, item, f"items.{number}") for number, item in enumerate(value["items"]))
    return Page(items, value.get("after"), bool(value.get("more")))


def _object(kind: Any, value: Any, where: str) -> Any:
    _check(isinstance(value, dict), where, "an object", value)
    given: dict[str, Any] = {}
    for name, key, hint, optional in _members(kind):
        if name == "raw":
            given[name] = value
        elif key in value:
            given[name] = read(hint, value[key], f"{where}.{key}")
        elif not optional:
            raise UnexpectedAnswer(f"{where} has no {key}")
    return kind(**given)


@functools.cache
def _members(kind: Any) -> list[tuple[str, str, Any, bool]]:
    """Name, JSON key, type and whether it may be left out, of each field."""
    hints = get_type_hints(kind)
    return [
        (
            each.name,
            each.metadata.get("key", each.name),
            hints[each.name],
            each.default is not MISSING or each.default_factory is not MISSING,
        )
        for each in fields(kind)
    ]


def _check(right: bool, where: str, expected: str, value: Any) -> None:
    if not right:
        raise UnexpectedAnswer(f"{where} should be {expected}, and is {str(value)[:60]!r}")
