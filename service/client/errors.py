# ruff: noqa: N818 -- read as what went wrong: `except NotUnderstood`
"""What a call can raise, made from the service's problem documents (RFC 9457).

    RoadtalkError
    ├── NotReachable         nobody answers, or the connection was lost and a second try too
    │   └── TimedOut         no answer in time; a change may have been made or not
    ├── UnexpectedAnswer     what answers is not this service, or not of a version known here
    └── Refused              a problem document; nothing was changed
        ├── NotUnderstood    `unparsed`, `understood`, `suggestions`
        ├── Ambiguous        `choices`, and `choose` to take one
        ├── NotFound         no such session, decision or route
        │   └── UnknownSession
        ├── Invalid          fields out of range: `errors`
        ├── NotAllowed       401 or 403: the key is missing or wrong, or the caller is
        ├── TooMany          429: `retry_after_s`
        └── Unavailable      503: not saved, not restorable; try again

Every `Refused` has `slug`, `status`, `title`, `detail`, `errors` and the whole `document`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any


class RoadtalkError(Exception):
    """Base of all."""


class NotReachable(RoadtalkError):
    """Nobody answers there."""


class TimedOut(NotReachable):
    """No answer in time. Whether a change was made is not known; ask for the state."""


class UnexpectedAnswer(RoadtalkError):
    """The answer is not as documented: something else listens there, or another version."""


@dataclass(frozen=True)
class FieldProblem:
    """What is wrong with one field of what was sent."""

    field: str
    message: str


@dataclass(frozen=True)
class Choice:
    """One thing that may have been meant; calling it says it. With an async client, await the call."""

    text: str
    actions: tuple[Mapping[str, Any], ...]
    say: Callable[[], Any] | None = field(default=None, repr=False, compare=False)

    def __call__(self) -> Any:
        """Say this one; answers what the first call would have answered."""
        if self.say is None:
            raise RoadtalkError("This choice cannot be taken by itself: say its text.")
        return self.say()


class Refused(RoadtalkError):
    """The service refused, and changed nothing."""

    def __init__(self, document: Mapping[str, Any], status: int, headers: Mapping[str, str]) -> None:
        self.document = document
        self.status = status
        self.headers = headers
        self.slug = str(document.get("type", "")).rsplit("/", 1)[-1]
        self.title = str(document.get("title", "Refused"))
        self.detail = str(document.get("detail", self.title))
        self.errors = tuple(
            FieldProblem(str(each.get("field", "")), str(each.get("message", "")))
            for each in _objects(document.get("errors"))
        )
        super().__init__(self.detail)


class NotUnderstood(Refused):
    """Words that could not be accounted for."""

    @property
    def suggestions(self) -> tuple[str, ...]:
        """Sentences near to what was said."""
        return _texts(self.document.get("suggestions"))

    @property
    def unparsed(self) -> tuple[str, ...]:
        """The words that were not understood."""
        return _texts(self.document.get("unparsed"))

    @property
    def understood(self) -> tuple[str, ...]:
        """The parts that were."""
        return _texts(self.document.get("understood"))


class Ambiguous(Refused):
    """What was said could mean several things."""

    again: Callable[[str], Any] | None = None
    """Makes the same call with another sentence; set by the client that made the first."""

    @property
    def choices(self) -> tuple[Choice, ...]:
        """What may have been meant, each ready to be called."""
        return tuple(
            Choice(str(each.get("text", "")), tuple(each.get("actions", ())), self._saying(each))
            for each in _objects(self.document.get("choices"))
        )

    def choose(self, number: int) -> Any:
        """Take the choice of this number, from 0; with an async client, await it."""
        return self.choices[number]()

    def _saying(self, choice: Mapping[str, Any]) -> Callable[[], Any] | None:
        again, text = self.again, str(choice.get("text", ""))
        return None if again is None else lambda: again(text)


class NotFound(Refused):
    """No such route or resource."""


class UnknownSession(NotFound):
    """No session has this id."""


class Invalid(Refused):
    """Fields out of range or unknown, or not possible on this road."""


class NotAllowed(Refused):
    """No key, a wrong key, or not from here."""


class TooMany(Refused):
    """Too many sessions, or calls too fast."""

    @property
    def retry_after_s(self) -> float | None:
        """Seconds to wait, if the service says so."""
        said = self.headers.get("retry-after", "")
        return float(said) if said.isdecimal() else None


class Unavailable(Refused):
    """The service could not do it now."""


_BY_SLUG: dict[str, type[Refused]] = {
    "not-understood": NotUnderstood,
    "ambiguous": Ambiguous,
    "unknown-session": UnknownSession,
}
_BY_STATUS: dict[int, type[Refused]] = {
    401: NotAllowed,
    403: NotAllowed,
    404: NotFound,
    422: Invalid,
    429: TooMany,
    503: Unavailable,
}


def refusal(document: Mapping[str, Any], status: int, headers: Mapping[str, str] | None = None) -> Refused:
    """The exception for a problem document."""
    slug = str(document.get("type", "")).rsplit("/", 1)[-1]
    kind = _BY_SLUG.get(slug) or _BY_STATUS.get(status, Refused)
    return kind(document, status, headers or {})


def _objects(values: Any) -> list[Mapping[str, Any]]:
    return [each for each in values if isinstance(each, dict)] if isinstance(values, list) else []


def _texts(values: Any) -> tuple[str, ...]:
    return tuple(str(each) for each in values) if isinstance(values, list) else ()
