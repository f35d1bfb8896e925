"""Finds defects of a language's data: most of them whenever it is loaded, all of them by `Language.check()`.

A defect is a phrase with two values of one concept, a phrase that is there already, a frame that nothing can
reach, a concept that no frame takes, a concept that a frame takes and drops, an example saying that does not
parse, or a question with fewer than two choices. Whether the words are good English is not checked.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

from service.grammar.accounting import MARKERS
from service.grammar.data import LanguageData
from service.grammar.fragments import BEGINS_NEGATION
from service.grammar.frame_use import dropped
from service.grammar.frames import Frame
from service.grammar.lanes_from_right import FROM_RIGHT
from service.grammar.lattice import GLUE, NAME, NUMBER, UNIT
from service.grammar.lexicon import SECOND
from service.grammar.noun_phrases import COLON, NOUN, QUANTITY
from service.grammar.old_values import FROM, OLD_VALUE
from service.grammar.parse_types import Ambiguous, Parse, Understood
from service.grammar.paths import ALLOWS, NEGATION, SEPARATOR, SPEAKER
from service.grammar.pointing import POINTING
from service.grammar.seconds_in_ticks import IN_TICKS
from service.grammar.time_clauses import TIME

ENGINE_CONCEPTS = frozenset(
    {GLUE, NAME, NUMBER, UNIT, SECOND, COLON, QUANTITY, ALLOWS, NEGATION, SEPARATOR, SPEAKER}
    | {"interjection", "tag", "name_end", "name_tail", "quotes", "unsupported", "captures"}
    | {"what_if", "if", "then_what", "what_if_tail", "teach", "means", "supposed_drive"}
    | {
        "refers",
        "taught",
        "taught_with_numbers",
        "repeated",
        "repair",
        "contrast",
        "order",
        "simultaneous",
        "chat",
        "chat_filler",
        "detail",
        "spoken_tick",
        "had_been",
        "scenario_name_end",
        "would_have",
        FROM_RIGHT,
        BEGINS_NEGATION,
        FROM,
        OLD_VALUE,
        TIME,
    }
    | POINTING
    | MARKERS
)
"""Concepts the engine itself gives a use."""

AMOUNT_FORMS = frozenset(
    {
        "counted",
        "more",
        "exact",
        "nearest",
        "fewer",
        "all",
        "any",
        "any_one",
        "none",
        "those",
        "that",
        "the_one",
        "the_many",
    }
    | {"the_counted", "bare_one", "bare_many", "more_bare", "more_bare_one", "fewer_bare", "post"}
    | {"those_counted", "asked", "half", "too_many", "too_few"}
    | {"id", "last", "last_counted"}
)
DIMENSIONS = frozenset(
    {"number", "length", "speed", "seconds", "fraction", "times", "rate", "real_times", IN_TICKS}
)


def flaws(data: LanguageData) -> list[str]:
    """The defects that can be seen without reading a sentence; looked for whenever a language is loaded."""
    empty = (defect for frame in data.frames for defect in _empty(frame))
    return [*data.lexicon.collisions, *data.lexicon.repeats, *_unreachable(data), *_unused(data), *empty]


def defects(data: LanguageData, parse: Callable[[str], Parse]) -> list[str]:
    """Every defect found, as sentences; empty when the data are fit."""
    sayings = (defect for frame in data.frames for defect in _sayings(frame, parse))
    return [*flaws(data), *dropped(data.frames, data.free), *sayings]


def _known(data: LanguageData, concept: str) -> bool:
    name, _, form = concept.partition(".")
    nouns = {f"{NOUN}{name}.one", f"{NOUN}{name}.many"}
    amount = form in AMOUNT_FORMS and bool(nouns & data.lexicon.concepts.keys())
    return amount or concept in data.lexicon.concepts or concept in DIMENSIONS or concept in ENGINE_CONCEPTS


def _unreachable(data: LanguageData) -> Iterator[str]:
    """Frames that need what no phrase means, and concepts taken that do not exist."""
    for frame in data.frames:
        for group in frame.needs:
            if not any(_known(data, concept) for concept in group):
                yield f"frame {frame.name} needs {' or '.join(sorted(group))}, which nothing says"
        for concept in sorted(frame.accepted):
            if not _known(data, concept):
                yield f"frame {frame.name} takes {concept}, which nothing says"


def _unused(data: LanguageData) -> Iterator[str]:
    """Concepts that phrases have and no frame takes."""
    taken = {concept for frame in data.frames for concept in frame.accepted}
    names = {concept.partition(".")[0] for concept in taken}
    for concept in data.lexicon.concepts:
        noun = concept.startswith(NOUN) and concept.split(".")[1] in names
        if not noun and concept not in taken and concept not in ENGINE_CONCEPTS:
            yield f"nothing takes the concept {concept}"


def _sayings(frame: Frame, parse: Callable[[str], Parse]) -> Iterator[str]:
    """Example sayings that would not be understood: each may be offered to a person."""
    for say in frame.says:
        parsed = parse(say)
        if not isinstance(parsed, Understood | Ambiguous):
            yield f"frame {frame.name}: its saying {say!r} is not understood"


def _empty(frame: Frame) -> Iterator[str]:
    """Frames that do nothing, or ask without a choice."""
    if not frame.actions and frame.ask is None and not (frame.leaves_out or frame.only_negated):
        yield f"frame {frame.name} has neither actions nor a question"
    if frame.ask is not None and len(frame.ask.choices) < 2:
        yield f"frame {frame.name} asks, but offers fewer than two choices"
