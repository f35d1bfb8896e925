"""Reads sentences about the setting spoken of last: "set it to 0.4", "a bit more", "and the courtesy?".

The setting gets its name, so that the sentence is read as if it had been said in full. Only requests and
questions about settings come of it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import cast, get_args

from service.actions import Action, Ask
from service.grammar.answer_words import CORRECTS, FOLLOWS, OF_SETTING, SETTING, SO_MUCH, TO_VALUE, TOO
from service.grammar.engine import Language
from service.grammar.parse_types import Parse, Understood
from service.grammar.sentences import Unsayable
from service.grammar.tokens import Token, normalise, tokenise
from service.grammar.topic import ALONE, Topic
from service.grammar.work_budget import BudgetExceededError, WorkBudget
from sim.actions import Adjust, Parameter, Set
from sim.planner_names import PlannerName
from sim.sensor_names import SensorName

MAX_WORDS = 10
"""Longer sentences name what they are about."""

_SIZES = ("columns", "rows")
"""Settings that are amounts of something on the road, which is new where they are set."""

_CHOSEN = {"planner": get_args(PlannerName), "sensor": get_args(SensorName)}
"""Settings whose values have names that may be asked about."""


def setting_of(actions: Sequence[Action]) -> tuple[str, object] | None:
    """The setting that some actions are about, and the value that was named; None unless it is one."""
    if len(actions) != 1:
        return None
    (action,) = actions
    match action:
        case Set(parameter=parameter, value=value):
            return parameter, value
        case Adjust(parameter=parameter):
            return parameter, None
        case Ask(about="what_if", change=(Set(parameter=parameter, value=value),)):
            return parameter, value
        case Ask(about="term", term=str() as term) if term in get_args(Parameter):
            return term, None
        case Ask(about="term", term=str() as term):
            return next(((name, term) for name, values in _CHOSEN.items() if term in values), None)
        case Ask(parameter=str() as parameter, value=value) if parameter in get_args(Parameter):
            return parameter, value
        case _:
            return None


def read_of_setting(language: Language, text: str, topic: Topic, parsed: Parse) -> Parse | None:
    """What a sentence says of the setting spoken of last; None where it says nothing of it.

    `parsed` is what it means by itself; a question understood so ("what does it do?") is only one about the
    setting where that is explained.
    """
    spoken_of = setting_of(topic.actions)
    if spoken_of is None:
        return None
    tokens = tokenise(normalise(text), language.data.contractions)
    while tokens and not any(char.isalnum() for char in tokens[-1].text):
        tokens = tokens[:-1]
    if not tokens or len(tokens) > MAX_WORDS:
        return None
    explained = isinstance(parsed, Understood)
    work = WorkBudget()
    try:
        for said in _in_full(language, text, tokens, topic, spoken_of):
            meant = language.read(said, ALONE, work, asking=False)
            if isinstance(meant, Understood) and _about_settings(meant.actions, explained=explained):
                return Understood(text, meant.actions)
    except (BudgetExceededError, Unsayable):
        return None
    return None


def grown_too(language: Language, text: str, topic: Topic, parsed: Parse) -> Understood | None:
    """The road changed further by an amount: "and five rows" after "add two lanes" adds rows.

    Alone it says how many there are, which would make a new road.
    """
    if not isinstance(parsed, Understood) or len(parsed.actions) != 1 or len(topic.actions) != 1:
        return None
    before, after = topic.actions[0], parsed.actions[0]
    if not isinstance(before, Adjust) or before.by is None or before.parameter not in _SIZES:
        return None
    if not isinstance(after, Set) or after.parameter not in _SIZES or isinstance(after.value, str):
        return None
    if not language.data.answers.beginning(tokenise(normalise(text), language.data.contractions), FOLLOWS):
        return None
    by = after.value if before.by > 0 else -after.value
    return Understood(text, (Adjust(parameter=after.parameter, by=by),))


def _about_settings(actions: Sequence[Action], *, explained: bool) -> bool:
    if explained:
        return all(isinstance(action, Ask) and action.about in ("term", "setting") for action in actions)
    return all(
        isinstance(action, Set | Adjust)
        or (
            isinstance(action, Ask)
            and action.about == "what_if"
            and all(isinstance(each, Set | Adjust) for each in action.change or ())
        )
        or (isinstance(action, Ask) and action.about in ("setting", "term", "options", "changes"))
        for action in actions
    )


def _in_full(
    language: Language, text: str, tokens: Sequence[Token], topic: Topic, spoken_of: tuple[str, object]
) -> Iterator[str]:
    """The sentence with the setting named, in each way that may be meant."""
    answers, plain = language.data.answers, normalise(text)
    name = language.sentences.parameter(spoken_of[0])
    start = answers.beginning(tokens, FOLLOWS)
    rest = tokens[start : len(tokens) - answers.ending(tokens, TOO)]
    if not rest:
        return
    written = plain[rest[0].start : rest[-1].end]
    if (whole := answers.meant(rest, OF_SETTING)) is not None:
        yield str(whole).format(setting=name)
    numbers = {at: found for at in range(len(rest)) if (found := language.data.numbers.read(rest, at))}
    changed = setting_of(topic.changed)
    again = isinstance(topic.actions[0], Set | Adjust) or (changed and changed[0] == spoken_of[0])
    if again and (by := answers.meant(rest, SO_MUCH, numbers)):
        amount = by.get("up") or -by["down"]
        yield language.sentence((Adjust(parameter=cast(Parameter, spoken_of[0]), by=amount),))
    if not answers.beginning(tokens, CORRECTS):
        yield f"{written} {answers.setting_named.format(setting=name)}"
    end, template = answers.longest(rest, 0, TO_VALUE)
    if template is not None and end < len(rest):
        yield str(template).format(setting=name, value=plain[rest[end].start : rest[-1].end])
    for at in range(len(rest)):
        end, _ = answers.longest(rest, at, SETTING)
        if end > at:
            before = plain[rest[0].start : rest[at].start]
            after = plain[rest[end - 1].end : rest[-1].end]
            for named in (
                *_value_names(language, spoken_of),
                name,
                answers.setting_named.format(setting=name),
            ):
                yield f"{before}{named}{after}"
    asked = isinstance(topic.actions[0], Ask) or text.rstrip().endswith("?")
    if start and asked and answers.setting_asked:
        yield answers.setting_asked.format(said=written)


def _value_names(language: Language, spoken_of: tuple[str, object]) -> list[str]:
    """What the value is called that was asked about or chosen."""
    parameter, value = spoken_of
    if parameter not in _CHOSEN or not isinstance(value, str):
        return []
    return [language.sentences.value(parameter, value)]
