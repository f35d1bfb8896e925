"""What corrects an earlier utterance: "no, three" after "add five potholes" was done.

Nothing done is ever changed by a later word for it. Where it is known what was done, and what that would
have been with the correction in it, both are offered: to take it back and do it anew, or to do it as
well. Otherwise the refusal says that "undo" comes first. Leaves out corrections in the same breath:
those are `repairs`.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol

from service.actions import Action, Undo
from service.grammar.data import LanguageData
from service.grammar.makes import REPAIR
from service.grammar.parse_types import Ambiguous, Choice, Parse, Refused, Understood
from service.grammar.repairs import DROPPED
from service.grammar.sentences import Unsayable
from service.grammar.topic import ALONE, Topic
from service.grammar.work_budget import Work

_CHANGES = frozenset(("add", "remove", "set_count", "set", "adjust", "prefer"))
"""Actions that can be taken back one by one."""

_ON_TOP = frozenset(("add", "remove", "adjust"))
"""Those that come on top of what was done before; the others stand in its place anyway."""


class Tongue(Protocol):
    """What reading a correction takes from its language."""

    data: LanguageData

    def read(self, text: str, topic: Topic, work: Work, *, asking: bool) -> Parse:
        """Another sentence read."""

    def sentence(self, actions: Sequence[Action]) -> str:
        """One sentence that means exactly these actions. Raises `Unsayable`."""


def takes_back(data: LanguageData) -> frozenset[str]:
    """The words that a correction may begin with."""
    found: set[str] = set()
    for words, senses in data.lexicon.phrases_of(REPAIR):
        if any(sense.concept == REPAIR and sense.value != DROPPED for sense in senses):
            found.update(word for word in words[:2] if word.isalpha())
    return frozenset(found)


def corrected(
    tongue: Tongue, text: str, plain: str, topic: Topic, parsed: Parse, work: Work, *, sure: bool
) -> Parse:
    """The answer to a sentence that begins with such a word; `sure`: one that always takes something back."""
    if isinstance(parsed, Refused) and parsed.reason == "not_understood":
        if (actions := _as_it_should_have_been(tongue, plain, topic, work)) is not None:
            return _question(tongue, text, actions) or _refusal(tongue, text, parsed)
        return _refusal(tongue, text, parsed) if sure else parsed
    if (
        isinstance(parsed, Understood)
        and sure
        and _on_top(topic.actions, parsed.actions)
        and not topic.undone
    ):
        return _question(tongue, text, parsed.actions) or parsed
    return parsed


def _as_it_should_have_been(
    tongue: Tongue, plain: str, topic: Topic, work: Work
) -> tuple[Action, ...] | None:
    """What was done last, as it would be with the correction in it; None where that cannot be told."""
    done = topic.actions
    if not done or topic.undone or any(action.do not in _CHANGES for action in done):
        return None
    try:
        said = tongue.sentence(done)
    except Unsayable:
        return None
    parsed = tongue.read(f"{said}, {plain}", ALONE, work, asking=False)
    if not isinstance(parsed, Understood) or len(parsed.actions) != len(done) or parsed.actions == done:
        return None
    return parsed.actions


def _question(tongue: Tongue, text: str, actions: tuple[Action, ...]) -> Ambiguous | None:
    """Whether what was done shall be taken back before this is done."""
    try:
        choices = tuple(
            Choice(tongue.sentence(each), each) for each in ((Undo(do="undo"), *actions), actions)
        )
    except Unsayable:
        return None
    return Ambiguous(text, tongue.data.messages["instead"], choices)


def _refusal(tongue: Tongue, text: str, parsed: Refused) -> Refused:
    """The refusal that says what can be done instead."""
    message = tongue.data.messages["earlier"].format(phrase=text.strip())
    return Refused(text, parsed.reason, message, parsed.unparsed, parsed.understood, parsed.suggestions)


def _on_top(done: Sequence[Action], new: Sequence[Action]) -> bool:
    """Whether the same is done once more, to the same kind of thing or to the same setting."""
    return any(a.do in _ON_TOP and a.do == b.do and _about(a) == _about(b) for a in done for b in new)


def _about(action: Any) -> object:
    return getattr(action, "kind", None) or getattr(action, "parameter", None)
