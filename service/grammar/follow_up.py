"""Reads sentences that lean on the one before: "and in lane 5?", "the same on the right", "I said three".

What is said stands in the place of a part of the last request, or continues it, as it would within one
sentence. Nothing else changes: the outcome is as many requests, of the same kinds. A correction takes the
last request back first.
"""

from __future__ import annotations

from dataclasses import replace

from service.actions import Advise, Ask
from service.actions.table import traits_of
from service.grammar.answer_words import INSTEAD, NO, PREFACE
from service.grammar.distance_of_it import of_the_thing
from service.grammar.engine import Language
from service.grammar.foil_follow_up import ask_of_foil
from service.grammar.incomplete import ask_elsewhere, ask_what_is_missing
from service.grammar.last_request import asked_anew
from service.grammar.leaning import Actions, Leaning
from service.grammar.listed_options import choose_listed
from service.grammar.parse_types import Ambiguous, Choice, Parse, Refused, Understood
from service.grammar.repairs import about_the_same
from service.grammar.said_before import can_be_corrected, done_anew, shape
from service.grammar.sentences import Unsayable
from service.grammar.setting_talk import grown_too, read_of_setting, setting_of
from service.grammar.short_talk import pick_going_on, read_short, without_marks
from service.grammar.thing_talk import kinds_of, read_asked, read_of_things
from service.grammar.this_moment import read_of_this_moment
from service.grammar.tokens import normalise, tokenise
from service.grammar.topic import Topic
from service.grammar.unclear_it import ask_whether, ask_which_it
from service.grammar.work_budget import BudgetExceededError
from sim.actions import Add, Adjust

MAX_WORDS = 15
"""Longer sentences say themselves what they are about."""


def read_in_conversation(language: Language, text: str, topic: Topic, parsed: Parse) -> Parse:
    """What a sentence means after the one before it; `parsed` is what it means by itself.

    A sentence that is understood by itself means that, but for a short one that goes on with a question:
    "and left?" asks the same of the left.
    """
    if topic.asked and isinstance(parsed, Understood):
        tokens = tokenise(normalise(text), language.data.contractions)
        if (of_thing := of_the_thing(language.scan(tokens), tokens, topic, parsed)) is not parsed:
            return of_thing
    alone = isinstance(parsed, Refused) and parsed.reason == "not_understood"
    if (alone or topic.looks_back) and (of_moment := read_of_this_moment(language, text, topic)):
        return of_moment
    if (grown := grown_too(language, text, topic, parsed)) is not None:
        return grown
    if alone and (listed := choose_listed(language, text, topic)) is not None:
        return listed
    if alone or _asks(parsed):
        of_setting = read_of_setting(language, text, topic, parsed)
        if of_setting is not None:
            return _instead(language, text, topic, of_setting)
    if (alone or isinstance(parsed, Ambiguous)) and (
        said := _said_once(language, text, topic)
        or pick_going_on(language, text, topic, parsed)
        or _after_preface(language, text, topic)
    ):
        return said
    if not topic.undone and (of_foil := ask_of_foil(language, text, topic, parsed)) is not None:
        return of_foil
    if alone and (said := read_short(language, text, topic) or read_asked(language, text, topic)):
        return said
    if isinstance(parsed, Understood) and (unclear := ask_which_it(language, text, topic, parsed)):
        return unclear
    meant = _after_last(language, text, topic, parsed, alone=alone)
    return (ask_whether(language, text, topic, meant) if isinstance(meant, Understood) else None) or meant


def _after_last(language: Language, text: str, topic: Topic, parsed: Parse, *, alone: bool) -> Parse:
    """What a sentence means after the last request; `alone`: it means nothing by itself."""
    if not topic.actions or topic.undone:
        of_things = read_of_things(language, text, topic) if alone else None
        return of_things or _completed(language, text, topic, parsed)
    if isinstance(parsed, Understood) and _takes_the_place(language, text, topic, parsed):
        return replace(parsed, actions=done_anew(topic, parsed.actions))
    if isinstance(parsed, Understood | Refused) and (
        elsewhere := ask_elsewhere(language, text, topic, parsed)
    ):
        return elsewhere
    if isinstance(parsed, Understood) and not _asks_in(topic) and _of_detail(parsed):
        # "And the next one" is about the last request where nothing was explained.
        leaning = Leaning(language, text, tokenise(normalise(text), language.data.contractions), topic)
        return leaning.read() or parsed
    if not (alone or _goes_on_asking(topic, parsed)):
        return _completed(language, text, topic, parsed)
    tokens = tokenise(normalise(text), language.data.contractions)
    if len(tokens) > MAX_WORDS:
        return parsed
    # "Make it five" after "how many are left?" is how many there shall be.
    total = read_of_things(language, text, topic, counted=True) if alone and _scene_asked(topic) else None
    if total is not None:
        return total
    leaning = Leaning(language, text, tokens, _about_the_change(text, topic))
    try:
        found = leaning.read()
    except BudgetExceededError:
        return parsed
    if alone:
        if found is None and leaning.corrects:
            found = _corrects_setting(language, leaning, topic)
        if found is None:
            found = read_of_things(language, text, topic, counted=leaning.corrects)
        return found or _completed(language, text, topic, parsed)
    assert isinstance(parsed, Understood)
    return _after_question(language, leaning, found, parsed)


def _completed(language: Language, text: str, topic: Topic, parsed: Parse) -> Parse:
    """The question about what a request lacks; else what it means by itself."""
    lacking = isinstance(parsed, Refused) and parsed.reason in ("not_understood", "negation")
    return (ask_what_is_missing(language, text, topic) if lacking else None) or parsed


def _instead(language: Language, text: str, topic: Topic, parsed: Parse) -> Parse:
    """A change of a setting by an amount or a factor, in the place of the last one: "no, halve it"."""
    tokens, answers = tokenise(normalise(text), language.data.contractions), language.data.answers
    if not isinstance(parsed, Understood) or answers.whole(tokens[:1], {}, {}) != NO or not topic.steps:
        return parsed
    both = (*topic.actions, *parsed.actions)
    measured = all(isinstance(each, Adjust) and each.direction is None for each in both)
    same = measured and shape(topic.actions) == shape(parsed.actions) and not topic.undone
    return replace(parsed, actions=done_anew(topic, parsed.actions)) if same else parsed


def _said_once(language: Language, text: str, topic: Topic) -> Parse | None:
    """What a sentence means whose words are all said twice or more for emphasis: "wait wait"."""
    plain = normalise(text)
    words = [token for token in tokenise(plain, language.data.contractions) if token.text.isalpha()]
    if len(words) < 2 or len({token.text for token in words}) > 1:
        return None
    once = plain[words[0].start : words[0].end]
    parsed = language.parse(once, topic)
    steady = isinstance(parsed, Understood) and all(traits_of(each).idempotent for each in parsed.actions)
    return replace(parsed, text=text) if steady and isinstance(parsed, Understood) else None


def _after_preface(language: Language, text: str, topic: Topic) -> Parse | None:
    """What a request means before which its reason is said: "too many, remove half of them"."""
    answers = language.data.answers
    tokens = tokenise(normalise(text), language.data.contractions)
    end, excluded = answers.longest(tokens, 0, PREFACE)
    while 0 < end < len(tokens) and not any(char.isalnum() for char in tokens[end].text):
        end += 1
    if not 0 < end < len(tokens):
        return None
    rest = normalise(text)[tokens[end].start :]
    parsed = read_in_conversation(language, rest, topic, language.parse(rest, topic))
    if isinstance(parsed, Refused):
        return None
    if isinstance(parsed, Understood):
        fits = all(action.do != excluded for action in parsed.actions)
        return replace(parsed, text=text) if fits else None
    return replace(parsed, text=text)


def _about_the_change(text: str, topic: Topic) -> Topic:
    """The topic as it was before a question about the things that were changed last.

    "And one in lane 4" after "how many potholes are there?" goes on with what added them; "and left?" asks.
    """
    if not _scene_asked(topic) or not topic.changed_steps or text.rstrip().endswith("?"):
        return topic
    if kinds_of(topic.actions) != kinds_of(topic.changed):
        return topic
    return replace(topic, actions=topic.changed, steps=topic.changed_steps, said="")


def _scene_asked(topic: Topic) -> bool:
    """Whether the last request asked what is on the road."""
    return all(isinstance(action, Ask) and action.about == "scene" for action in topic.actions)


def _asks(parsed: Parse) -> bool:
    return isinstance(parsed, Understood) and all(traits_of(action).is_question for action in parsed.actions)


def _takes_the_place(language: Language, text: str, topic: Topic, parsed: Understood) -> bool:
    """Whether a request says at its end that it is meant instead of the last one: "left, I mean"."""
    if not topic.steps or not about_the_same(topic.actions, parsed.actions):
        return False
    tokens = without_marks(tokenise(normalise(text), language.data.contractions))
    return language.data.answers.ending(tokens, INSTEAD) > 0


def _asks_in(topic: Topic) -> bool:
    return all(traits_of(action).is_question for action in topic.actions)


def _of_detail(parsed: Understood) -> bool:
    return all(isinstance(action, Ask) and action.about == "detail" for action in parsed.actions)


def _goes_on_asking(topic: Topic, parsed: Parse) -> bool:
    asked = all(traits_of(action).is_question for action in topic.actions)
    return asked and isinstance(parsed, Understood)


def _after_question(language: Language, leaning: Leaning, found: Parse | None, alone: Understood) -> Parse:
    """What a sentence means that goes on with a question and is a request by itself.

    "And left?" asks; "and left" may be either, so it is asked about. One that asks what cannot be found out
    is refused: it must not act.
    """
    if leaning.goes_on and (advice := _of_advice(leaning.done, alone)) is not None:
        return advice
    if not leaning.goes_on or all(traits_of(action).is_question for action in alone.actions):
        return alone if found is None or not leaning.goes_on else found
    if found is None:
        meant = asked_anew(leaning.done, alone.actions)
        found = None if meant is None else Understood(alone.text, meant)
    asks = alone.text.rstrip().endswith("?")
    if found is None:
        counted = any(isinstance(action, Add) and action.count > 1 for action in alone.actions)
        return leaning.refusal(alone.text) if asks and leaning.short and not counted else alone
    return found if asks else _which(language, alone.text, found, alone)


def _corrects_setting(language: Language, leaning: Leaning, topic: Topic) -> Parse | None:
    """The last change of a setting done otherwise: "no, triple"."""
    if not can_be_corrected(topic) or setting_of(topic.actions) is None:
        return None
    found = read_of_setting(language, leaning.corrected, topic, leaning.refusal(leaning.corrected))
    if not isinstance(found, Understood) or shape(found.actions) != shape(topic.actions):
        return None
    return replace(found, text=leaning.text, actions=done_anew(topic, found.actions))


def _of_advice(done: Actions, alone: Understood) -> Parse | None:
    """The last advice for another hazard: "what if it is a pedestrian?"."""
    if len(done) != 1 or not isinstance(done[0], Advise) or any(isinstance(a, Advise) for a in alone.actions):
        return None
    meant = asked_anew(done, alone.actions)
    return None if meant is None else Understood(alone.text, meant)


def _which(language: Language, text: str, found: Parse, alone: Understood) -> Parse:
    """The question whether the last question goes on or a request is made."""
    if not isinstance(found, Understood):
        return found
    readings = (found.actions, alone.actions)
    try:
        choices = tuple(Choice(language.sentence(actions), actions) for actions in readings)
    except Unsayable:
        return alone
    return Ambiguous(text, language.data.messages["which"], choices)
