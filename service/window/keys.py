"""The keys and sentences that the help tells."""

from __future__ import annotations

from service.window.texts import table

Group = tuple[str, tuple[tuple[str, str], ...]]


def key_groups() -> tuple[Group, ...]:
    """Groups of keys and what they do."""
    groups = table("help", "groups")
    return tuple((title, tuple((str(key), str(what)) for key, what in keys)) for title, keys in groups)


def examples() -> tuple[str, ...]:
    """Sentences to begin with; each is understood, which a test sees to."""
    return tuple(table("help", "examples"))
