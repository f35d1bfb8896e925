"""What holds of every answer, whatever was asked: it is brief, whole and well-formed."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from sim.types import Kind
from tests.support.recorded_drives import Record

MOST_WORDS = 60
HOLLOW = re.compile(
    r"[{}]|(?<!^)(?<![.!?:] )\bNone\b|(?<!^)(?<![.!?:] )\b(?:True|False)\b|\bnan\b|\binf\b|\b\w+_\w+\b"
)
ONE_OF_MANY = re.compile(
    r"(?<![\d.,/^])\b1 (?:of them were|more (?:ticks|moves)|"
    r"(?:ticks|moves|rows|lanes|cars|vehicles|pedestrians|potholes|barriers|things|stops|cells|roads|drives|"
    r"times|near misses|crashes|lane changes|sensors|seconds|metres|people|reports|events|others)\b)"
)
NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?")
YES = re.compile(r"^Yes\b")
NO = re.compile(r"^No\b")


@dataclass(frozen=True)
class Told:
    """An answer to a canonical sentence about a recorded drive."""

    record: Record
    kind: str
    """of question (`prompts/questions/en/kinds.yaml`)"""
    question: str
    supposes: str | None
    answer: dict[str, Any]
    slots: dict[str, str]
    """what was put into the slots of its sentence"""

    @property
    def thing_kind(self) -> Kind | None:
        """The kind of things that the question names; None where it names none."""
        return next((each for word, each in KINDS_CALLED.items() if word in self.question), None)

    @property
    def text(self) -> str:
        """What is said."""
        return str(self.answer["text"])

    def __getitem__(self, key: str) -> Any:
        return self.answer[key]

    def has(self, *keys: str) -> bool:
        """Whether the answer has facts beside its text: one that refuses has none."""
        return all(key in self.answer for key in keys)

    @property
    def numbers(self) -> list[float]:
        """The numbers of the text."""
        return numbers_of(self.text)

    @property
    def yes(self) -> bool | None:
        """What it begins with; None for neither yes nor no."""
        return True if YES.match(self.text) else False if NO.match(self.text) else None

    def between(self, pattern: str) -> list[float] | None:
        """The numbers that a pattern's groups match in the text; None where it does not match."""
        found = re.search(pattern, self.text)
        if found is None:
            return None
        return [float(each) for each in found.groups() if each is not None and NUMBER.fullmatch(each)]


Wrong = str | None
"""What is wrong with an answer; None where nothing is."""
Judge = Callable[[Told], Iterator[str]]
"""Yields what is wrong."""


def numbers_of(text: str) -> list[float]:
    """The numbers in a text."""
    return [float(each) for each in NUMBER.findall(text)]


def formal(told: Told) -> Iterator[str]:
    """What is wrong with the words of any answer."""
    text = told.text
    words = len(text.split())
    if words > MOST_WORDS and told.kind not in LONG:
        yield f"{words} words"
    if found := HOLLOW.search(text):
        yield f"hollow: {found[0]}"
    if found := ONE_OF_MANY.search(text):
        yield f"one of many: {found[0]}"
    if not text or text != text.strip() or "  " in text or text[-1] not in '.!?)"”':
        yield "no sentence"
    if re.search(r"\.\.|,,|: :|\s[,.;:](?:\s|$)|\( | \)|\(\)", text):
        yield "punctuation"


KINDS_CALLED = {
    "car": Kind.VEHICLE,
    "pedestrian": Kind.PEDESTRIAN,
    "pothole": Kind.POTHOLE,
    "barrier": Kind.BARRIER,
}
"""Words of a question that name a kind."""
LONG = frozenset(("help", "settings_list", "styles_list", "explained"))
"""Kinds of which an answer may be longer: lists of all there is, and several answers at once."""


def differ(what: str, told: Any, found: Any) -> Iterator[str]:
    """That two values differ; figures by more than their rounding do."""
    if isinstance(told, float | int) and isinstance(found, float | int) and not isinstance(found, bool):
        if abs(told - found) > 1e-6:
            yield f"{what}: {told}, not {found}"
    elif told != found:
        yield f"{what}: {told}, not {found}"


def near(what: str, told: float, found: float, within: float) -> Iterator[str]:
    """That a rounded figure is another one."""
    if abs(told - found) > within + 1e-9:
        yield f"{what}: {told}, not {found:.3f}"


def listed(what: str, told: Sequence[Any], found: Sequence[Any]) -> Iterator[str]:
    """That two lists differ."""
    if list(told) != list(found):
        yield f"{what}: {list(told)[:12]}, not {list(found)[:12]}"
