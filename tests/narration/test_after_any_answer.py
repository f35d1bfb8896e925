"""Whatever was answered before, the next question has an answer: none fails over what the talk was about."""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from typing import Any

import pytest

from service.actions import Action, Ask
from service.grammar import Language
from service.grammar.parse_types import Understood
from service.narration import Narrator
from service.question_matcher.kinds import read_kinds
from service.resources import prompts_folder
from service.sessions.facts import Asked
from service.sessions.pending import Talk
from service.sessions.referred import explained
from service.yaml_files import read_yaml
from sim.config import Config
from sim.session.timeline import Timeline
from tests.question_matcher.test_matcher import SLOTS, THINGS

FOLDER = prompts_folder() / "questions" / "en"
FOLLOWING = ("shorter", "in detail", "why is that?", "and before that?", "and after that?", "are you sure?")
WITH = 3
"""Questions that are asked after each one, drawn from all."""

Said = tuple[Ask, Sequence[Action], str | None]


@pytest.fixture(scope="module")
def said() -> Mapping[str, Said]:
    """Every sentence that questions are matched with, with its meaning and what it supposes."""
    language = Language.load("en")
    moves = read_yaml(FOLDER / "words.yaml")["moves"]
    slots = {**SLOTS, **THINGS["en"], **moves["left"], "instead": moves["right"]["going"]}
    slots |= {"tick": "3", "until": "5"}
    found: dict[str, Said] = {}
    for kind in read_kinds(FOLDER).values():
        for canonical in (*kind.says, *(each for each, _ in kind.with_words)):
            parse = language.parse(canonical.text.format_map(slots))
            assert isinstance(parse, Understood)
            for place, ask in enumerate(parse.actions):
                assert isinstance(ask, Ask)
                supposes = parse.supposes[place] if parse.supposes else None
                found[f"{parse.text} {place}"] = ask, parse.actions, supposes
    return found


def test_every_question_has_an_answer_after_any_other(said: Mapping[str, Said]) -> None:
    language, narrator, draw = Language.load("en"), Narrator.load(), random.Random(1)
    timeline = Timeline(Config(seed=103, vehicles=20, pedestrians=2))
    for _ in range(9):
        timeline.advance()

    def answered(ask: Ask, supposes: str | None = None, before: Ask | None = None) -> Mapping[str, Any]:
        answer = narrator.answer(Asked(ask, timeline, supposes=supposes, talk=Talk(explained=before)))
        assert answer["text"]
        return answer

    following = [language.parse(text).actions[0] for text in FOLLOWING]  # type: ignore[union-attr]
    for ask, actions, supposes in said.values():
        before = explained(answered(ask, supposes), tuple(actions))
        for each in draw.sample(following, 2):
            answered(each, None, before)  # type: ignore[arg-type]
        for then, _, supposed in draw.sample([*said.values()], WITH):
            answered(then, supposed, before)


def test_what_if_instead_of_a_detour_is_of_that_detour_whatever_was_explained_before() -> None:
    timeline = Timeline(Config(seed=103, vehicles=20, pedestrians=2))
    for _ in range(9):
        timeline.advance()
    parse = Language.load("en").parse("what if you had gone straight instead of leaving your lane?")
    assert isinstance(parse, Understood)
    (ask,) = parse.actions
    assert isinstance(ask, Ask)
    alone, after = (
        Narrator.load().answer(Asked(ask, timeline, talk=talk))["text"]
        for talk in (Talk(), Talk(explained=Ask(about="why", tick=3)))
    )
    assert alone == after
