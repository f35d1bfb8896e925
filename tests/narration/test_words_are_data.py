"""Sentences for people stand in `prompts`: what the service says, it says from there."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.literals import sentences

SERVICE = Path(__file__).parents[2] / "service"
FOLDERS = ("sessions", "narration", "interpreter", "grammar", "window", "llm")
ELSEWHERE = {
    "grammar/build.py": "errors of the language's data, for its author",
    "grammar/clause_patterns.py": "errors of the language's data, for its author",
    "grammar/compiled.py": "errors of the language's data, for its author",
    "grammar/data.py": "errors of the language's data, for its author",
    "grammar/frame_use.py": "errors of the language's data, for its author",
    "grammar/frames.py": "errors of the language's data, for its author",
    "grammar/lexicon.py": "errors of the language's data, for its author",
    "grammar/linter.py": "errors of the language's data, for its author",
    "grammar/patterns.py": "errors of the language's data, for its author",
    "grammar/rule_words.py": "errors of the language's data, for its author",
    "grammar/sentences.py": "errors of the language's data, for its author",
    "grammar/sentences_of_things.py": "errors of the language's data, for its author",
    "grammar/tokens.py": "a pattern",
    "llm/__init__.py": "an error for who runs the service",
    "llm/openai.py": "the service's log",
    "llm/prompts.py": "errors of the prompts, for their author",
    "llm/schema.py": "types, as a model is told them",
    "narration/sayings.py": "an error for who runs the service",
    "sessions/change.py": "the service's log",
    "sessions/live_ticks.py": "the service's log",
    "sessions/manager.py": "the service's log, recordings that do not fit, limits of the service",
    "sessions/part.py": "an error for who writes code",
    "sessions/persistence/recording.py": "recordings that do not fit",
    "sessions/persistence/replay.py": "recordings that do not fit",
    "sessions/persistence/restore.py": "the service's log",
    "sessions/persistence/snapshot_scheduler.py": "the service's log",
    "sessions/persistence/snapshot_records.py": "the service's log",
    "sessions/rewind.py": "a field and its message",
    "sessions/scheduler/eviction.py": "the service's log",
    "window/command.py": "the command line",
    "window/exchange.py": "figures of a change",
    "window/loading.py": "an error for who installed it",
    "window/local_session.py": "the program's log",
    "window/loop.py": "the command line",
    "window/scenario.py": "the command line",
}
"""Where literals stand that read like sentences, and what they are."""
MODULES = sorted(
    path.relative_to(SERVICE).as_posix() for folder in FOLDERS for path in (SERVICE / folder).rglob("*.py")
)


@pytest.mark.parametrize("module", [module for module in MODULES if module not in ELSEWHERE])
def test_no_sentence_stands_in_the_code(module: str) -> None:
    assert list(sentences((SERVICE / module).read_text())) == []


@pytest.mark.parametrize("module", ELSEWHERE)
def test_the_exceptions_are_still_there(module: str) -> None:
    assert list(sentences((SERVICE / module).read_text()))
