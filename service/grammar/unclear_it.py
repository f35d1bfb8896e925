"""Asks what is meant where a request would be done to the vehicle although "it" may be a thing.

"Move it to the left" with several things spoken of, and "a cone next to it", have the vehicle's
side in them only because no thing is known that could be meant. A word alone with a question mark is no
request either: "left?" is asked about.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import cast, get_args

from service.actions import Action, Evaluate
from service.actions.table import traits_of
from service.grammar.answer_words import FOLLOWS, NO
from service.grammar.engine import Language
from service.grammar.parse_types import Ambiguous, Choice, Understood
from service.grammar.references import REFERS
from service.grammar.referents import MAX_CANDIDATES
from service.grammar.sentences import Unsayable
from service.grammar.setting_talk import setting_of
from service.grammar.thing_talk import says_verb
from service.grammar.tokens import Token, normalise, tokenise
from service.grammar.topic import Topic
from sim.actions import Add, Direction, Drive, Landmark, MoveThings, PlaceableKind, Reset, Shift, Where
from sim.types import kind_of

MOVES_THINGS = "v.shift"
"""Concept of the verbs that move things, and the vehicle where nothing else is said."""

BESIDE = "beside"
OFFERED_KINDS: tuple[PlaceableKind, ...] = ("vehicle", "barrier")
"""Of these the nearest is offered where nothing was spoken of."""

MAX_ALONE = 8
"""So many words with a question mark and no verb are no request."""
MAX_RUNS_ALONE = 4
"""The same of runs: more words ask how often something happens in so many."""


def ask_which_it(language: Language, text: str, topic: Topic, parsed: Understood) -> Ambiguous | None:
    """The question what "it" is where a request takes it for the vehicle; None where that is clear."""
    if len(parsed.actions) != 1:
        return None
    (action,) = parsed.actions
    if isinstance(action, Reset) and setting_of(topic.actions) is not None and _refers(language, text):
        # "Reset it" after a setting was spoken of is not sure to mean the road.
        return _question(language, text, language.data.answers.shall, [action])
    if len(topic.things) == 1:
        return None
    drives = isinstance(action, Drive) and action.move in get_args(Direction)
    beside = isinstance(action, Add) and action.where is not None and action.where.side == BESIDE
    if not drives and not (beside and isinstance(action, Add) and action.where and action.where.of is None):
        return None
    edges = list(language.scan(tokenise(normalise(text), language.data.contractions)).all())
    refers = [edge for edge in edges if edge.concept == REFERS and edge.sense.value == "one"]
    moves = any(edge.concept == MOVES_THINGS for edge in edges)
    if not refers or (drives and not moves):
        return None
    return _question(language, text, language.data.messages["which"], [*_things_meant(action, topic), action])


def _refers(language: Language, text: str) -> bool:
    edges = language.scan(tokenise(normalise(text), language.data.contractions)).all()
    return any(edge.concept == REFERS and edge.sense.value == "one" for edge in edges)


def _things_meant(action: Action, topic: Topic) -> list[Action]:
    """The request done to each thing that may be meant: those spoken of, or the nearest."""
    wheres: list[tuple[PlaceableKind, Where]] = [
        (cast(PlaceableKind, str(kind_of(name))), Where(id=name)) for name in topic.things[-MAX_CANDIDATES:]
    ]
    wheres = wheres or [(kind, Where(nearest=True)) for kind in OFFERED_KINDS]
    if isinstance(action, Drive):
        by = Shift(side=cast(Direction, str(action.move)))
        return [MoveThings(kind=kind, count=1, where=where, by=by) for kind, where in wheres]
    assert isinstance(action, Add)
    assert action.where is not None
    marks = [
        Landmark(id=where.id) if where.id else Landmark(kind=kind, nearest=True) for kind, where in wheres
    ]
    return [replace(action, where=replace(action.where, of=of)) for of in marks]


def ask_whether(language: Language, text: str, topic: Topic, parsed: Understood) -> Ambiguous | None:
    """The question whether a word alone with a question mark is a request: "left?"."""
    runs = any(isinstance(each, Evaluate) for each in parsed.actions)
    if not all(traits_of(each).undo_step or isinstance(each, Evaluate) for each in parsed.actions):
        return None
    tokens = tokenise(normalise(text), language.data.contractions)
    if text.rstrip().endswith("?"):
        tokens = tokens[:-1]
    elif not _corrects_nothing(language, tokens, topic, parsed):
        return None
    follows = language.data.answers.beginning(tokens, FOLLOWS)
    joined = follows > 0 and tokens[0].text in language.joiners
    asked = bool(topic.actions) and all(traits_of(each).is_question for each in topic.actions)
    most = MAX_RUNS_ALONE if runs else MAX_ALONE
    if len([token for token in tokens if token.text.isalnum()]) - follows > most or (
        follows and not joined and not asked
    ):
        return None
    if says_verb(language, text):
        return None
    return _question(language, text, language.data.answers.shall, [*parsed.actions], together=True)


def _corrects_nothing(language: Language, tokens: Sequence[Token], topic: Topic, parsed: Understood) -> bool:
    """Whether a move begins as a correction of something else: "no, to the right" after a cone was added."""
    moves = all(isinstance(each, Drive) for each in parsed.actions)
    corrects = language.data.answers.whole(tokens[:1], {}, {}) == NO and len(tokens) > 1
    return moves and corrects and not any(isinstance(each, Drive) for each in topic.actions)


def _question(
    language: Language, text: str, question: str, actions: list[Action], *, together: bool = False
) -> Ambiguous | None:
    """A question with a choice for each action, or one for all; None where one of them cannot be said."""
    meant = [tuple(actions)] if together else [(action,) for action in actions]
    try:
        return Ambiguous(text, question, tuple(Choice(language.sentence(each), each) for each in meant))
    except Unsayable:
        return None
