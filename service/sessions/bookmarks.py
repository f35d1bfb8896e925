"""Moments of a session that were given a name, to be gone back to.

A name stands in the session's own log like anything else that was said, so it needs no other place, is
there again after a restart and in a recording, and means the same moment in every replay. It outlives
rewinding and undoing; saved again, it names the newer moment. Leaves out moments of other sessions.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace

from service.actions import Action, Load
from service.problems import FieldProblem, UnknownName
from service.refusals import refusals
from service.store import EntryRecord, Store, StoreError
from sim.session.edits import Change
from sim.session.timeline import Timeline

MAX_BOOKMARKS = 100
"""Names that a session may hold: each keeps a whole timeline, though states are shared."""

MAX_SUGGESTIONS = 3
"""How many names are told to whoever asks for one that is not there."""


@dataclass(frozen=True, slots=True)
class Bookmark:
    """A named moment: how many changes had been accepted, and the timeline as it was."""

    name: str
    sequence: int
    timeline: Timeline = field(compare=False)

    @property
    def tick(self) -> int:
        """Where its time stood."""
        return self.timeline.tick


@dataclass(frozen=True, slots=True)
class Bookmarked:
    """The present was given a name; `again` if the name was another moment's before."""

    name: str
    tick: int
    again: bool


@dataclass(frozen=True, slots=True)
class Jumped:
    """The session went to another tick, by going back or (with a `name`) to a named moment."""

    before: int
    tick: int
    changes: tuple[Change, ...]
    name: str | None = None


def attach_names(entries: Sequence[EntryRecord], saved: Iterable[Bookmark]) -> Sequence[EntryRecord]:
    """Entries that were replayed, each with the names it gave."""
    names: dict[int, dict[str, int]] = {}
    for moment in saved:
        names.setdefault(moment.sequence, {})[moment.name] = moment.tick
    if not names:
        return entries
    return [replace(entry, names=names.get(entry.sequence, {})) for entry in entries]


async def add_other_session(
    store: Store, problem: UnknownName, actions: Sequence[Action], language: str
) -> UnknownName:
    """The problem, telling also of another session in which there is such a moment."""
    (error,) = problem.errors
    action = actions[int(error.field.split(".")[1])]
    try:
        found = await store.bookmarks(1, name=action.name) if isinstance(action, Load) else ()
    except StoreError:
        return problem
    if not found:
        return problem
    session = found[0].session_name or found[0].session
    elsewhere = refusals(language).session("saved_elsewhere", session=session)
    sentence = f"{problem.detail} {elsewhere}"
    return UnknownName(sentence, errors=[FieldProblem(error.field, sentence)], **problem.more)


def unknown_bookmark(name: str, names: Iterable[str], where: str, language: str) -> UnknownName:
    """The problem of a name that nothing was saved under, with the nearest there are."""
    from rapidfuzz import process  # at the first name that is not there

    near = [found for found, _, _ in process.extract(name, list(names), limit=MAX_SUGGESTIONS)]
    words = refusals(language)
    if near:
        sentence = words.session("not_saved_near", name=name, near=tuple(near))
    else:
        sentence = words.session("not_saved", name=name)
    return UnknownName(sentence, errors=[FieldProblem(where, sentence)], suggestions=near)
