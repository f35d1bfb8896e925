"""Corrections of an earlier utterance: "no, three" after "add five potholes" was done.

Where the corrected request is known, the last one is taken back and done anew, which is one step of undo. A
whole request that would come on top of the last one ("no, add three") is asked about: instead of it, or as
well. Otherwise the refusal says to undo first. Corrections within one utterance are in `repairs`; sentences
that lean on the one before otherwise, in `follow_up`.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol

from service.actions import Action
from service.actions.table import traits_of
from service.grammar.data import LanguageData
from service.grammar.parse_types import Ambiguous, Choice, Parse, Refused, Understood
from service.grammar.repairs import DROPPED
from service.grammar.said_before import can_be_corrected, done_anew, said_before
from service.grammar.sentences import Unsayable
from service.grammar.span_patterns import REPAIR
from service.grammar.topic import ALONE, Topic
from service.grammar.work_budget import WorkBudget


class LanguageReader(Protocol):
    """What reading a correction takes from its language."""

    data: LanguageData

    def read(self, text: str, topic: Topic, work: WorkBudget, *, asking: bool) -> Parse:
        """Another sentence read."""

    def sentence(self, actions: Sequence[Action]) -> str:
        """One sentence that means exactly these actions. Raises `Unsayable`."""


def opening_words(data: LanguageData) -> frozenset[str]:
    """The words that a correction may begin with."""
    found: set[str] = set()
    for words, senses in data.lexicon.phrases_of(REPAIR):
        if any(sense.concept == REPAIR and sense.value != DROPPED for sense in senses):
            found.update(word for word in words[:2] if word.isalpha())
    return frozenset(found)


def answer_correction(
    language: LanguageReader,
    text: str,
    plain: str,
    topic: Topic,
    parsed: Parse,
    work: WorkBudget,
    *,
    sure: bool,
) -> Parse:
    """The answer to a sentence that begins as a correction does; `sure`: with words that are nothing else."""
    if isinstance(parsed, Refused) and parsed.reason == "not_understood":
        if (actions := _redo_with_correction(language, plain, topic, work)) is not None:
            return Understood(text, done_anew(topic, actions))
        return _refusal(language, text, parsed) if sure else parsed
    if (
        isinstance(parsed, Understood)
        and sure
        and _on_top(topic.actions, parsed.actions)
        and topic.steps
        and not topic.undone
    ):
        return _question(language, text, topic, parsed.actions) or parsed
    return parsed


def _redo_with_correction(
    language: LanguageReader, plain: str, topic: Topic, work: WorkBudget
) -> tuple[Action, ...] | None:
    """The last actions with the correction applied; None where that is not known."""
    done = topic.actions
    if not can_be_corrected(topic) or not all(traits_of(action).amendable for action in done):
        return None
    said = said_before(language, topic, work)
    if said is None:
        return None
    parsed = language.read(f"{said}, {plain}", ALONE, work, asking=False)
    if not isinstance(parsed, Understood) or len(parsed.actions) != len(done) or parsed.actions == done:
        return None
    # Of several alike it is not known which one is corrected.
    alike = len(done) > 1 and len({(each.do, _about(each)) for each in done}) == 1
    if alike and any(before == after for before, after in zip(done, parsed.actions, strict=True)):
        return None
    return parsed.actions


def _question(
    language: LanguageReader, text: str, topic: Topic, actions: tuple[Action, ...]
) -> Ambiguous | None:
    """Whether what was done shall be taken back before this is done."""
    try:
        choices = tuple(
            Choice(language.sentence(each), each) for each in (done_anew(topic, actions), actions)
        )
    except Unsayable:
        return None
    return Ambiguous(text, language.data.messages["instead"], choices)


def _refusal(language: LanguageReader, text: str, parsed: Refused) -> Refused:
    """The refusal that says what can be done instead."""
    message = language.data.messages["earlier"].format(phrase=text.strip())
    return Refused(text, parsed.reason, message, parsed.unparsed, parsed.understood, parsed.suggestions)


def _on_top(done: Sequence[Action], new: Sequence[Action]) -> bool:
    """Whether the same is done once more, to the same kind of thing or to the same setting."""
    return any(traits_of(a).additive and a.do == b.do and _about(a) == _about(b) for a in done for b in new)


def _about(action: Any) -> object:
    return getattr(action, "kind", None) or getattr(action, "parameter", None)
