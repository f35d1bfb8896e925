"""Sentences written from the contract alone, by people who saw neither grammar nor data: none acts otherwise.

Each line of `tests/data/language/*.jsonl` holds a sentence, what is expected (`act`, `ask`, `refuse`, or
either of two) and the actions that are right; `also` lists other right ones. A refusal is never wrong
here, only timid. `out_of_domain.txt` holds sentences about other things.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from service.actions import dump
from service.actions.table import BY_VERB
from service.grammar.engine import Language
from service.grammar.parse_types import Understood

FOLDER = Path(__file__).parents[1] / "data" / "language"
SETS = sorted(FOLDER.glob("*.jsonl"))

KNOWN: dict[str, str] = {}
"""Sentences that act wrongly, and why; whoever mends one takes it from the list, which the test wants."""


def rounded(value: Any) -> Any:
    """JSON values with numbers as they are compared."""
    match value:
        case dict():
            return {key: rounded(part) for key, part in value.items()}
        case list() | tuple():
            return [rounded(part) for part in value]
        case bool() | None | str():
            return value
        case _:
            return round(float(value), 5)


def harmless(actions: list[dict[str, Any]]) -> bool:
    """Whether nothing is changed: questions, small talk, views; and a name that nothing was saved under."""
    return all(not BY_VERB[each["do"]].changes_session or each["do"] in ("chat", "load") for each in actions)


@pytest.fixture(scope="module")
def english() -> Language:
    return Language.load("en")


@pytest.mark.parametrize("path", SETS, ids=lambda path: path.stem)
def test_no_sentence_acts_otherwise_than_it_says(path: Path, english: Language) -> None:
    wrong = []
    for line in path.read_text(encoding="utf-8").splitlines():
        case = json.loads(line)
        parsed = english.parse(case["text"])
        labelled = (case.get("actions"), case.get("parsed"), *case.get("also", ()))
        right = [rounded(each) for each in labelled if each is not None]
        if isinstance(parsed, Understood):
            got = rounded(dump(parsed.actions))
            if got not in right and not harmless(got):
                wrong.append(case["text"])
    here = {json.loads(line)["text"] for line in path.read_text(encoding="utf-8").splitlines()}
    assert set(wrong) == here & KNOWN.keys()


def test_sentences_about_other_things_do_nothing(english: Language) -> None:
    acted = []
    for text in (FOLDER / "out_of_domain.txt").read_text(encoding="utf-8").splitlines():
        parsed = english.parse(text)
        if isinstance(parsed, Understood) and not harmless(dump(parsed.actions)):
            acted.append((text, dump(parsed.actions)))
    assert acted == []
