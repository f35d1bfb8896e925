"""Sixty rules in words, written from the contract alone: what each means, and that a replay is the same."""

from __future__ import annotations

import json
from collections import Counter
from pathlib import Path
from typing import Any

import pytest

from service.actions import dump
from service.grammar import Language, Understood
from service.grammar.parse_types import Ambiguous
from sim.config import Config
from tests.support.sessions import PAUSE, Service, do
from tests.support.snapshots import back


def read(name: str) -> list[dict[str, Any]]:
    path = Path(__file__).parents[1] / "data" / name
    return [json.loads(line) for line in path.read_text("utf-8").splitlines()]


CASES = read("language/rules.jsonl")
PROGRAMS = read("programs.jsonl") + read("programs_again.jsonl")


@pytest.fixture(scope="module")
def english() -> Language:
    return Language.load("en")


def test_none_means_anything_else(english: Language) -> None:
    counted: Counter[str] = Counter()
    for case in CASES:
        parsed = english.parse(case["text"])
        got = dump(parsed.actions) if isinstance(parsed, Understood) else []
        meant = case.get("parsed", case["actions"])  # what the session refuses may be understood
        counted["right" if got == meant else "wrong" if got else "refused"] += 1
    assert counted == {"right": 60}


def test_programs_in_two_languages_mean_what_they_say(english: Language) -> None:
    """Twice sixty more, said by different people; what is not understood is refused, or asked about."""
    languages = {"en": english, "de": Language.load("de")}
    for case in PROGRAMS:
        parsed = languages[case["lang"]].parse(case["text"])
        got = dump(parsed.actions) if isinstance(parsed, Understood) else []
        assert got == case["actions"], case["text"]
        assert isinstance(parsed, Ambiguous) == (case["expect"] == "ask"), case["text"]


@pytest.mark.parametrize("case", [each for each in CASES if each["actions"]], ids=lambda each: each["text"])
async def test_each_is_the_same_after_the_service_was_killed(case: dict[str, Any]) -> None:
    service = Service()
    session = await service.session(Config(seed=5))
    await do(session, *case["actions"])
    for _ in range(45):
        await do(session, {"do": "resume"})
        service.clock.tick(1)
    await do(session, PAUSE)  # what comes after the last change is not known after a kill
    found = await back(service.store, session.id, short=False)
    assert found.run == session.run
    assert found.run.world.digest() == session.run.world.digest()
    assert found.timeline.entries == session.timeline.entries
