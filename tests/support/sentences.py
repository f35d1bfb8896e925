"""Literals of a module that read like sentences: words for people belong in `prompts`."""

from __future__ import annotations

import ast
from collections.abc import Iterator

WORDS = 4
"""A literal of so many words, or of two that end like a sentence, is taken to be one."""
FOR_DEVELOPERS = {
    "AssertionError",
    "BeliefError",
    "ConnectionError",
    "IndexError",
    "KeyError",
    "NoAnswerError",
    "NotationError",
    "RuntimeError",
    "TypeError",
    "ValueError",
}
"""Errors that a person who writes code reads."""


def sentences(source: str) -> Iterator[tuple[int, str]]:
    """The literals of a module that read like sentences, outside docstrings and errors for developers."""
    tree = ast.parse(source)
    skipped: set[ast.AST] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            skipped.add(node.value)
        if isinstance(node, ast.Raise) and _for_developers(node.exc):
            skipped.update(ast.walk(node))
        if isinstance(node, ast.JoinedStr) and node not in skipped:
            skipped.update(node.values)
            text = "".join(part.value if isinstance(part, ast.Constant) else "x" for part in node.values)  # type: ignore[misc]
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and node not in skipped:
            text = node.value
        else:
            continue
        words = text.split()
        if len(words) >= WORDS or (len(words) > 1 and text.rstrip().endswith((".", "!", "?"))):
            yield node.lineno, text


def _for_developers(raised: ast.expr | None) -> bool:
    return isinstance(raised, ast.Call) and ast.unparse(raised.func).rpartition(".")[2] in FOR_DEVELOPERS
