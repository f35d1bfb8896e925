"""What the models of answers are made of.

An answer is a frozen dataclass. The service makes and documents it, the client reads it, so it is described
once. Known values of a name (`MoveName`, `KindName`) are documented, yet any text is read: a client keeps
working when a newer service answers more.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Generic, Literal, TypeVar

from pydantic import Field
from pydantic_core import core_schema

from sim.types import HAZARDS, MOVERS, Kind, Mode, Move, Outcome

Json = Mapping[str, Any]
T = TypeVar("T")


class Model:
    """Base of all: documented by the text below each field, and documented to hold nothing more."""

    __slots__ = ()
    __pydantic_config__: ClassVar[Any] = {
        "extra": "forbid",
        "use_attribute_docstrings": True,
        "defer_build": True,  # a service that starts documents nothing yet
    }


class Answered(Model):
    """Base of what is answered or sent as a whole. A client finds all of it, as it came, in `raw`."""

    __slots__ = ("_raw",)

    @property
    def raw(self) -> Json:
        """The JSON object that this was read from; empty where it was not read."""
        raw: Json = getattr(self, "_raw", {})
        return raw

    def read_from(self, raw: Json) -> None:
        """Keeps the JSON object that this was read from."""
        object.__setattr__(self, "_raw", raw)

    @classmethod
    def __get_pydantic_core_schema__(cls, source: Any, handler: Any) -> core_schema.CoreSchema:
        return core_schema.no_info_wrap_validator_function(_keep_raw, handler(source))


def _keep_raw(value: Any, read: Callable[[Any], Any]) -> Any:
    made = read(value)
    if isinstance(value, dict):
        made.read_from(value)
    return made


class Items(Answered, Generic[T]):
    """Base of answers that are a list: they can be iterated over."""

    __slots__ = ()
    if TYPE_CHECKING:
        items: tuple[T, ...]

    def __iter__(self) -> Iterator[T]:
        return iter(self.items)

    def __len__(self) -> int:
        return len(self.items)


class Page(Items[T]):
    """Base of a part of a list; send `after` for what follows, if there is `more`."""

    __slots__ = ()
    if TYPE_CHECKING:
        after: Any
        more: bool


class DocumentedAs:
    """Documents a field as a narrower type than the one it is read as."""

    def __init__(self, kind: Any) -> None:
        self.kind = kind

    def __get_pydantic_core_schema__(self, source: Any, handler: Any) -> core_schema.CoreSchema:
        # JSON schemas are made from the first; clients read Python values, by the second.
        return core_schema.json_or_python_schema(handler.generate_schema(self.kind), handler(source))


KindName = Annotated[str, DocumentedAs(Kind)]
EgoKind = Annotated[str, DocumentedAs(Literal[Kind.AV])]
MoverKind = Annotated[str, DocumentedAs(Literal[MOVERS])]
HazardKind = Annotated[str, DocumentedAs(Literal[HAZARDS])]
ModeName = Annotated[str, DocumentedAs(Mode)]
MoveName = Annotated[str, DocumentedAs(Move)]
OutcomeName = Annotated[str, DocumentedAs(Outcome)]
Side = Annotated[str, DocumentedAs(Literal["left", "right"])]

TickNumber = Annotated[int, Field(ge=0, le=2**53 - 1)]
Tick = Annotated[TickNumber, Field(description="Ticks since the session began.")]
Cell = Annotated[tuple[int, int], Field(description="[column, row], row 0 at the goal")]
"""Column and row; row 0 is at the goal, column 0 is lane 1."""
