"""Bookmarks: moments of a session that have a name and can be gone back to.

A name is an entry of the session's own log like any other action, so it needs no other storage, survives a
restart, is part of a recording and means the same moment in every replay. Rewinding and undoing do not remove
it; saving it again moves it. Bookmarks of other sessions cannot be loaded.
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
"""Largest number of bookmarks of a session: each holds a whole timeline, though states are shared."""

MAX_SUGGESTIONS = 3
"""Largest number of similar names in the problem of an unknown name."""


@dataclass(frozen=True, slots=True)
class Bookmark:
    """A named moment: the number of changes accepted by then, and the timeline as it was."""

    name: str
    sequence: int
    timeline: Timeline = field(compare=False)

    @property
    def tick(self) -> int:
        """The tick of the bookmark."""
        return self.timeline.tick


@dataclass(frozen=True, slots=True)
class Bookmarked:
    """Fact: the present moment got a name; `again` if the name belonged to another moment before."""

    name: str
    tick: int
    again: bool


@dataclass(frozen=True, slots=True)
class Jumped:
    """Fact: time moved to another tick, by rewinding or (with a `name`) to a bookmark."""

    before: int
    tick: int
    changes: tuple[Change, ...]
    name: str | None = None


def attach_names(entries: Sequence[EntryRecord], saved: Iterable[Bookmark]) -> Sequence[EntryRecord]:
    """Entries of a replay, each with the names that it gave."""
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
