"""One thing said and what came of it, ready to be shown."""

from __future__ import annotations

from dataclasses import dataclass

from service.problems import Ambiguous, ProblemError
from service.sessions.utterance import Outcome
from service.window.texts import table, text
from sim.session.edits import Change


@dataclass(frozen=True, slots=True)
class Exchange:
    """What was said (None for a key), the reply, and what may be said next."""

    said: str | None
    reply: str
    done: bool = True
    """False where it was refused, or is asked about"""
    changes: tuple[Change, ...] = ()
    offers: tuple[str, ...] = ()
    """sentences to go on with"""
    asks: bool = False
    """whether one of the offers is what was meant, and can be chosen by its number"""


def exchanged(said: str | None, outcome: Outcome, *more: str) -> Exchange:
    """What was done."""
    return Exchange(said, " ".join((outcome.reply, *more)).strip(), changes=outcome.changes)


def refused(said: str | None, problem: ProblemError) -> Exchange:
    """What was not done, and what would help."""
    if isinstance(problem, Ambiguous):
        offers = tuple(choice["text"] for choice in problem.more.get("choices", ()))
        return Exchange(said, problem.detail, done=False, offers=offers, asks=bool(offers))
    offers = tuple(problem.more.get("suggestions", ()))
    return Exchange(said, problem.detail, done=False, offers=offers)


def told(change: Change) -> str:
    """A change in a few letters: `potholes 4 → 7`."""
    names = table("changes", "names")
    name = names.get(change.path, change.path.removeprefix("config.").replace("_", " "))
    return f"{name} {_value(change.before)} → {_value(change.after)}"


def _value(value: object) -> str:
    match value:
        case None:
            return "–"
        case bool():
            return text("changes", "truth", "yes_" if value else "no_")
        case float():
            return f"{value:g}"
        case list() | tuple():
            return ", ".join(map(str, value)) or "–"
        case _:
            return str(value)
