"""The form of a scenario file, and what is wrong with one that is none, with line and field.

A file is YAML or JSON (which YAML includes). The vocabulary of what happens on the road is that of the typed
actions; `rules` are the scripted part, as events with a start trigger are in ASAM OpenSCENARIO.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated, Any, Final, Literal

import yaml
from pydantic import BaseModel, ConfigDict, Field, ValidationError, WithJsonSchema, model_validator

from service.http.config_schema import CONFIG_SCHEMA
from sim.actions import Add, Copy, MoveThings, Remove, Replace, SetCount, Swap, Trigger
from sim.config import Config, ConfigError, Problem
from sim.planner_names import PlannerName
from sim.session.saved_config import new_config

FORMAT: Final = "roadtalk-scenario"
VERSION: Final = 1
MAX_BYTES: Final = 256_000

Setup = Annotated[Add | Remove | SetCount | MoveThings | Swap | Replace | Copy, Field(discriminator="do")]
"""What may be done to a road before it is driven."""
_GIVEN: Final = frozenset(("seed", "planner"))
"""Settings that have a place of their own."""


class ScenarioFile(BaseModel):
    """A scenario: one road (with a seed), or the roads of a configuration (without)."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=False)

    format: Literal["roadtalk-scenario"]
    version: Literal[1]
    name: str = Field(pattern=r"^[a-z0-9]+(-[a-z0-9]+)*$", max_length=64, description="In words joined by -.")
    reason: str = Field(min_length=1, max_length=1_000, description="Why it exists: what it shows or tests.")
    config: Annotated[dict[str, Any], WithJsonSchema(CONFIG_SCHEMA)] = Field(
        default_factory=dict, description="What differs from an ordinary road."
    )
    seed: int | None = Field(
        None, ge=0, le=2**53 - 1, description="Of its road. Left out: every episode draws a road of its own."
    )
    planner: PlannerName | None = Field(None, description="The one that drives unless another is named.")
    setup: list[Setup] = Field(
        default_factory=list, max_length=100, description="Done at tick 0, in this order; needs a seed."
    )
    rules: list[Trigger] = Field(
        default_factory=list, max_length=20, description="Rules that stand from tick 0: the scripted part."
    )

    @model_validator(mode="before")
    @classmethod
    def _check_config(cls, values: Any) -> Any:
        config = values.get("config") if isinstance(values, Mapping) else None
        for name in sorted(_GIVEN & set(config or ())) if isinstance(config, Mapping) else ():
            raise ValueError(f"config.{name} is given beside config, as '{name}'")
        return values

    @model_validator(mode="after")
    def _check_setup(self) -> ScenarioFile:
        if self.setup and self.seed is None:
            raise ValueError("'setup' is done to one road: give its 'seed'")
        return self

    def to_config(self) -> Config:
        """The configuration, with seed and planner. Raises `ConfigError`."""
        parts = {**self.config, "seed": self.seed or 0}
        if self.planner is not None:
            parts["planner"] = self.planner
        return new_config(parts)

    def to_values(self) -> dict[str, Any]:
        """As JSON values: the file, without what is as usual."""
        values = self.model_dump(mode="json", exclude_none=True)
        return {name: value for name, value in values.items() if value not in ({}, [])}


@dataclass(frozen=True, slots=True)
class Flaw:
    """One thing wrong with a file."""

    line: int
    """from 1"""
    field: str
    """such as `rules.0.when.fact`; empty for the whole file"""
    message: str

    def __str__(self) -> str:
        return f"line {self.line}{f', {self.field}' if self.field else ''}: {self.message}"


class ScenarioError(ValueError):
    """A file that is no scenario."""

    def __init__(self, flaws: Sequence[Flaw]) -> None:
        super().__init__("\n".join(map(str, flaws)))
        self.flaws = tuple(flaws)


def read_scenario(text: str) -> ScenarioFile:
    """The scenario of a file's text. Raises `ScenarioError` with every flaw that was found."""
    if len(text.encode("utf-8", "surrogatepass")) > MAX_BYTES:
        raise ScenarioError([Flaw(1, "", f"it has more than {MAX_BYTES:,} bytes")])
    try:
        node = yaml.compose(text, Loader=yaml.SafeLoader)
        _check_keys(node)
        values = yaml.safe_load(text)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        told = getattr(error, "problem", None) or str(error)
        raise ScenarioError([Flaw(1 if mark is None else mark.line + 1, "", str(told))]) from error
    except RecursionError as error:
        raise ScenarioError([Flaw(1, "", "it is nested too deeply")]) from error
    if not isinstance(values, dict):
        raise ScenarioError([Flaw(1, "", f"it is no object with 'format: {FORMAT}'")])
    try:
        found = ScenarioFile.model_validate(values)
        found.to_config()
    except ValidationError as error:
        raise ScenarioError(_flaws(node, error.errors())) from error
    except ConfigError as error:
        raise ScenarioError([_config_flaw(node, each) for each in error.problems]) from error
    return found


def _config_flaw(node: Any, problem: Problem) -> Flaw:
    path = (problem.field,) if problem.field in _GIVEN else ("config", problem.field)
    return Flaw(_line(node, path), ".".join(path), str(problem))


def _check_keys(node: Any) -> None:
    """Refuses anchors, which make small files large, and keys that are given twice."""
    seen: set[int] = set()
    for each in _nodes(node, seen):
        if isinstance(each, yaml.MappingNode):
            names = [key.value for key, _ in each.value]
            for at, name in enumerate(names):
                if name in names[:at]:
                    raise ScenarioError(
                        [Flaw(each.value[at][0].start_mark.line + 1, str(name), "it is given twice")]
                    )


def _nodes(node: Any, seen: set[int]) -> Iterator[Any]:
    if node is None:
        return
    if id(node) in seen:
        raise ScenarioError([Flaw(node.start_mark.line + 1, "", "aliases (*) are not used here")])
    seen.add(id(node))
    yield node
    children: list[Any] = []
    if isinstance(node, yaml.MappingNode):
        children = [part for pair in node.value for part in pair]
    elif isinstance(node, yaml.SequenceNode):
        children = list(node.value)
    for child in children:
        yield from _nodes(child, seen)


def _flaws(node: Any, errors: Sequence[Mapping[str, Any]]) -> list[Flaw]:
    """What pydantic found, where it stands in the text: one flaw for each field.

    Of an object that may be one of several actions, what is said of the others is left out.
    """
    others = {
        each["loc"][:-1] for each in errors if each["type"] == "literal_error" and each["loc"][-1] == "do"
    }
    found: dict[tuple[int, str], list[str]] = {}
    unknown: list[tuple[Any, ...]] = []
    for each in errors:
        path = tuple(each["loc"])
        if any(path[: len(other)] == other for other in others):
            unknown.append(path)
            continue
        known = _known(node, path)
        missing = each["type"] == "missing"
        field = ".".join(map(str, (*known, *(path[-1:] if missing else ()))))
        message = str(each["msg"]).removeprefix("Value error, ")
        found.setdefault((_line(node, known), field), []).append(message[:1].lower() + message[1:])
    for path in unknown:
        known = _known(node, path)
        while known and known[-1] != "do" and _child(_at(node, known), "do") is None:
            known = known[:-1]
        known = known if known[-1:] == ("do",) else (*known, "do")
        place = _line(node, known), ".".join(map(str, known))
        if not any(field.startswith(place[1].removesuffix("do")) for _, field in found):
            found[place] = ["it is no action that may stand here"]
    outer = {
        place for place in found if place[1] and any(name.startswith(f"{place[1]}.") for _, name in found)
    }
    inner = found.keys() - outer
    return [Flaw(*place, " or ".join(dict.fromkeys(found[place]))) for place in sorted(inner)]


def _at(node: Any, path: Sequence[Any]) -> Any:
    for part in path:
        node = _child(node, part)
    return node


def _known(node: Any, path: Sequence[Any]) -> tuple[Any, ...]:
    """The parts of a path that stand in the text."""
    known: list[Any] = []
    for part in path:
        child = _child(node, part)
        if child is not None:
            known.append(part)
            node = child
    return tuple(known)


def _line(node: Any, path: Sequence[Any]) -> int:
    line = 1 if node is None else node.start_mark.line + 1
    for part in path:
        key, child = _key(node, part), _child(node, part)
        if child is None:
            break
        node = child
        line = (child if key is None else key).start_mark.line + 1
    return int(line)


def _key(node: Any, part: Any) -> Any:
    if not isinstance(node, yaml.MappingNode):
        return None
    return next((key for key, _ in node.value if key.value == str(part)), None)


def _child(node: Any, part: Any) -> Any:
    if isinstance(node, yaml.MappingNode):
        return next((value for key, value in node.value if key.value == str(part)), None)
    if isinstance(node, yaml.SequenceNode) and isinstance(part, int) and part < len(node.value):
        return node.value[part]
    return None
