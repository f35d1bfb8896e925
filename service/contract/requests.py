"""What callers send. Unknown keys and values of another type are refused.

The language contract's actions are `service.actions`; what is answered is in `answers`.
"""

from __future__ import annotations

import warnings
from typing import Annotated, Any, Literal, TypeVar

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, WithJsonSchema
from pydantic.warnings import UnsupportedFieldAttributeWarning

from service.actions import Action, load
from service.actions.evaluation import MapAxis, Varied
from service.contract.model import Tick
from service.contract.text import Name, StorableText, check_letters
from service.http.config_schema import CONFIG_SCHEMA
from sim.actions import PlaceableKind, Weather

ConfigParts = Annotated[dict[str, Any], WithJsonSchema(CONFIG_SCHEMA)]


def _strictly(values: Any) -> Any:
    """Actions as `service.actions.load` reads them: `"5"` and `true` are no numbers."""
    if not isinstance(values, list):
        return values
    actions = list(load(values))
    check_letters(values)
    return actions


Value = TypeVar("Value")
Strictly = Annotated[Value, BeforeValidator(_strictly)]

_LANGUAGE = "In which language; `GET /language` names them. Default: the session's."

AT_TICK = (
    "The past tick that is looked at: a question that names no tick of its own is asked of it, and the "
    "answer says which moment it is about. Orders are done now all the same. Default: now."
)

MAX_ACTIONS = 100
"""Actions that may be sent at once."""


# FastAPI gives the field of a body an alias that pydantic has no use for, and silences the warning when it
# builds the field. A field whose schema is built later warns all the same.
warnings.filterwarnings("ignore", "The 'alias' attribute", UnsupportedFieldAttributeWarning)


class Sent(BaseModel):
    """What callers send: unknown keys and values of another type are refused."""

    model_config = ConfigDict(extra="forbid", strict=True, defer_build=True)


class RecordedEntry(Sent):
    """One accepted change of a recording."""

    sequence: int = Field(ge=1)
    tick: Tick
    text: StorableText | None
    actions: Strictly[list[Action]] = Field(max_length=MAX_ACTIONS)
    digest: str | None = Field(
        None, max_length=64, description="What the world after it must be; not said by older recordings."
    )


class Recording(Sent):
    """A session as one small file."""

    format: Literal["roadtalk-recording"]
    version: Literal[1]
    rules: int | None = Field(
        None, ge=1, description="Of which version; recordings from before there were several name none."
    )
    name: Name | None = None
    config: ConfigParts
    entries: list[RecordedEntry] = Field(max_length=20_000)
    tick: Tick = Field(description="Where it ends.")
    language: str | None = Field(None, max_length=16, description="Of its log; en where none is named.")
    digest: str = Field(description="What the world at its end must be.", max_length=64)
    seal: str | None = Field(
        None,
        max_length=64,
        description="Of the service that made it, which takes it although it is longer than others may be.",
    )


class NewName(Sent):
    """What a session is called from now on."""

    name: Name | None = Field(description="Null takes the name away.")


class NewSession(Sent):
    """How a session begins. Everything may be left out; without a seed one is drawn and told."""

    name: Name | None = None
    scenario: StorableText | None = Field(None, description="A sentence that describes a road.")
    config: ConfigParts | None = None
    seed: int | None = Field(None, ge=0, le=2**53 - 1)
    planner: str | None = None
    paused: bool | None = Field(
        None, description="Default: running, or paused when replayed from a recording."
    )
    recording: Recording | None = Field(None, description="Replay this; alone but for name and paused.")
    language: str | None = Field(
        None,
        max_length=16,
        description="Of its log, narration and replies, and of `scenario`; `GET /language` names them. "
        "Default: a recording's own, else en. A link that names a session keeps that session's.",
    )
    link: str | None = Field(
        None, max_length=4_096, description="Open this; alone but for name and paused. See `link`."
    )


class NewFork(Sent):
    """How another session goes on from a tick of this one."""

    at_tick: Tick | None = Field(None, description="Default: now.")
    actions: Strictly[list[Action]] | None = Field(
        None, max_length=MAX_ACTIONS, description="Done there first, together or the fork is not made."
    )
    name: Name | None = None
    paused: bool | None = Field(None, description="Default: as this session is.")


class NewEvaluation(Sent):
    """Many episodes to run, in words or in figures."""

    text: StorableText | None = Field(
        None,
        description="As a sentence, such as `run 500 episodes with A*`. Beside it: session, seed, language.",
    )
    find: Literal["worst"] | None = Field(
        None,
        description="Search for worlds that one planner fails although they can be driven; numbers of things "
        "and layouts are drawn. Default: run episodes.",
    )
    runs: int | None = Field(
        None,
        description="Episodes of each planner, up to 1,000,000; default 100. Of a search: worlds, up to "
        "100,000; default 1,000.",
    )
    planners: list[str] | None = Field(
        None,
        min_length=1,
        max_length=6,
        description="Compared on the same roads, each with the first. Default: the road's.",
    )
    scenario: StorableText | None = Field(None, description="A sentence that describes the roads.")
    config: ConfigParts | None = Field(None, description="What the roads are drawn from.")
    vary: Varied | None = Field(
        None,
        description="Values that are compared, such as `weather` of `clear` and `fog`: each combination is "
        "run from the same seeds, and all are compared with the first.",
    )
    map: list[MapAxis] | None = Field(
        None,
        min_length=2,
        max_length=2,
        description="A success map over two of these numbers of things, with `runs` episodes in each cell. "
        "`vary` may give their values, 2 to 12 each.",
    )
    file: dict[str, Any] | None = Field(
        None,
        description="A scenario file, as JSON (see `roadtalk scenario schema`). Beside it: runs, planners, "
        "seed, language.",
    )
    scenario_name: str | None = Field(
        None,
        min_length=1,
        max_length=80,
        description="A scenario that comes with Roadtalk, such as `rush-hour`, or with `session` a moment "
        "that was saved there. Beside it: runs, planners, vary, map, seed, language.",
    )
    session: str | None = Field(
        None, max_length=64, description="Roads as in this session; alone or with a text, runs, planners."
    )
    road: Literal["this"] | None = Field(
        None, description="The session's own road from this moment on, in place of roads that are drawn."
    )
    seed: int | None = Field(
        None, ge=0, le=2**53 - 1, description="Of the first episode. Default: the session's, else 0."
    )
    language: str | None = Field(None, max_length=16, description=f"Of the text and the report. {_LANGUAGE}")


class RewindTo(Sent):
    """Where to go back to."""

    tick: Tick


class Said(Sent):
    """Something said to a session."""

    text: StorableText = Field(description="At most 500 characters, unless the service is set otherwise.")
    dry_run: bool = Field(False, description="Say what would be done, and do nothing.")
    language: str | None = Field(None, max_length=16, description=_LANGUAGE)
    at_tick: Tick | None = Field(None, description=AT_TICK)


class TypedActions(Sent):
    """Actions of the language contract, no language involved; done together or not at all."""

    actions: Strictly[list[Action]] = Field(min_length=1, max_length=MAX_ACTIONS)
    dry_run: bool = Field(False, description="Say what would be done, and do nothing.")
    at_tick: Tick | None = Field(None, description=AT_TICK)


class StepTicks(Sent):
    """How many ticks to run."""

    ticks: int = Field(1, ge=1, le=1_000)


class Question(Sent):
    """A question, and nothing but one."""

    question: StorableText
    language: str | None = Field(None, max_length=16, description=_LANGUAGE)
    at_tick: Tick | None = Field(None, description=AT_TICK)


class Text(Sent):
    """A sentence to be understood."""

    text: StorableText
    language: str = Field("en", max_length=16, description="In which language; `GET /language` names them.")


class AdviceQuestion(Sent):
    """A hazard ahead, as a sentence or in figures."""

    text: StorableText | None = Field(
        None, description="As a sentence; then without hazard, distance and speed."
    )
    hazard: PlaceableKind | None = None
    distance_m: float | None = Field(None, description="From 0.1 to 1,000.")
    speed_kmh: float | None = Field(None, description="From 1 to 300.")
    weather: Weather | None = Field(None, description="Default: clear.")
    language: str = Field("en", max_length=16, description="In which language; `GET /language` names them.")
