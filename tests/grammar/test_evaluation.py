"""The measure itself: what counts as exact, wrong, refused and asked."""

from __future__ import annotations

from pathlib import Path

import pytest

from service.grammar import Language
from service.grammar.evaluation import Labelled, evaluate, evaluate_all, read_labelled, render, same


def test_each_verdict(language: Language) -> None:
    pause = [{"do": "pause"}]
    report = evaluate_all(
        language,
        [
            Labelled("pause", pause),
            Labelled("resume", pause),
            Labelled("bake a cake", pause),
            Labelled("slow down", pause),
            Labelled("slow down", [], clarify=True),
            Labelled("bake a cake", []),
            Labelled("pause", []),
        ],
    )
    assert report.counts["pause"] == {"exact": 1, "wrong": 1, "refused": 1, "clarified": 1}
    assert report.counts["(clarify)"] == {"exact": 1}
    assert report.counts["(refuse)"] == {"exact": 1, "wrong": 1}
    assert (report.total(), report.total("wrong"), len(report.failures)) == (7, 2, 4)
    text = render(report)
    assert "wrong: resume" in text
    assert '"resume"' in text


def test_numbers_are_compared_with_a_tolerance_and_booleans_are_not_numbers() -> None:
    assert same({"value": 9.144}, {"value": 9.144000000000002})
    assert not same({"value": 9.144}, {"value": 9.15})
    assert not same({"on": True}, {"on": 1})
    assert not same([1], [1, 2])
    assert not same({"a": 1}, {"b": 1})


def test_a_malformed_line_is_named(tmp_path: Path, language: Language) -> None:
    path = tmp_path / "bad.jsonl"
    path.write_text('{"text": "pause", "actions": []}\n\n{"text": 3\n', encoding="utf-8")
    with pytest.raises(ValueError, match="line 3"):
        evaluate(language, path)
    path.write_text("[]\n", encoding="utf-8")
    with pytest.raises(ValueError, match="line 1"):
        read_labelled(path)
