# ruff: noqa: N818 -- these are read as what went wrong: `raise NotFound`, not `raise NotFoundError`
"""Everything that can go wrong for a caller, and the one shape it is told in (RFC 9457).

    ProblemError                application/problem+json
    ├── Malformed                   400  the body is not JSON
    ├── Unauthorized                401  no key, or not the right one
    ├── CrossSite                   403  a page of another site asks
    ├── NotFound                    404  no such route or resource
    │   ├── UnknownSession
    │   ├── UnknownDecision
    │   ├── UnknownJob
    │   └── UnknownLongAnswer            made in the background, and not kept any more
    ├── MethodNotAllowed            405  the route exists, the method does not
    ├── Ambiguous                   409  could mean several things: `choices`
    ├── BackupUnderWay              409  one backup at a time
    ├── NotFinished                 409  an evaluation has no report yet
    ├── NotThereYet                 409  a long answer is still being made: `progress`
    ├── PreconditionFailed          412  the session was changed since: `sequence`
    ├── ContentTooLarge             413  more bytes than are read
    ├── UnsupportedMediaType        415  the content type is not JSON
    ├── MisdirectedRequest          421  asked under a name that is not this service's
    ├── NotOfThisShard              421  the session lives in another process; its entry asks there
    ├── Invalid                     422  fields out of range or unknown: `errors`
    │   ├── DoesNotFit                   the road has no room, or no such thing
    │   ├── NotAvailable                 understood, not offered by this version
    │   ├── NothingToUndo
    │   ├── UnknownName                  nothing was saved under it: `suggestions`
    │   ├── NotUnderstood                `unparsed`, `understood`, `suggestions`
    │   ├── NotAQuestion                 understood, but `ask` only answers
    │   ├── NotTeachable                 a phrase that cannot be taught, or forgotten
    │   ├── IdempotencyKeyReused         an idempotency key that was another request's
    │   ├── TooMuchWork                  it would cost more than a request may, or has
    │   └── RecordingMismatch            replayed to another digest than it says
    ├── TooManySessions             429  the limit of live sessions is reached: `Retry-After`
    ├── RateLimited                 429  a client asks too often: `Retry-After`
    ├── TooManyWrongKeys            429  a client tries keys: `Retry-After`
    ├── TooMuchAtOnce               429  too many dear requests are under way: `Retry-After`
    ├── QuotaExceeded               429  a client has as much as it may have
    ├── Internal                    500  a defect here; says nothing of its inside
    ├── NotSaved                    503  the store did not take it; nothing was changed
    ├── ShardDown                   503  the session's process is being replaced: `Retry-After`
    ├── Stopped                     503  work was ended before it was done; nothing was changed
    ├── BackupFailed                503  no backup was made
    └── NotRestorable               503  what is kept of the session cannot be replayed

`sessions` raises these without knowing HTTP; `api` turns them into responses, and the stream into
messages. A problem leaves the session as it was, always.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Final

MEDIA_TYPE = "application/problem+json"

OWNER_HEADER: Final = "Roadtalk-Owner"
"""The number of the shard that has what was asked for, in a response of one that has not."""


@dataclass(frozen=True, slots=True)
class FieldProblem:
    """What is wrong with one field of what was sent; `field` is a dotted path."""

    field: str
    message: str


class ProblemError(Exception):
    """Base class of all problems; `detail` is a sentence that a person can act on."""

    status: ClassVar[int] = 500
    slug: ClassVar[str] = "internal"
    title: ClassVar[str] = "Something went wrong here"

    def __init__(
        self,
        detail: str,
        *,
        errors: Sequence[FieldProblem] = (),
        headers: Mapping[str, str] | None = None,
        **more: Any,
    ) -> None:
        super().__init__(detail)
        self.detail = detail
        self.errors = tuple(errors)
        self.headers = dict(headers or {})
        self.more = more

    def document(self) -> dict[str, Any]:
        """The problem document as JSON values."""
        return {
            "type": f"/problems/{self.slug}",
            "title": self.title,
            "status": self.status,
            "detail": self.detail,
            "errors": [{"field": error.field, "message": error.message} for error in self.errors],
            **self.more,
        }


class Malformed(ProblemError):
    """The body is not JSON."""

    status, slug, title = 400, "malformed", "Not readable as JSON"


class Unauthorized(ProblemError):
    """The service has a key, and the request has none or another."""

    status, slug, title = 401, "key-needed", "A key is needed"

    def __init__(self) -> None:
        super().__init__(
            "Send the service's key as Authorization: Bearer <key>. Nothing was done.",
            headers={"WWW-Authenticate": "Bearer"},
        )


class CrossSite(ProblemError):
    """A page of another site sends a request, or opens the stream."""

    status, slug, title = 403, "cross-site", "Refused to a page of another site"


class NotFound(ProblemError):
    """No such route or resource."""

    status, slug, title = 404, "not-found", "Not found"


class UnknownSession(NotFound):
    """No session has this id."""

    slug, title = "unknown-session", "No such session"

    def __init__(self) -> None:
        super().__init__(
            "No session has this id. It may have been deleted; GET /api/v1/sessions lists those there are."
        )


class UnknownJob(NotFound):
    """No evaluation has this id."""

    slug, title = "unknown-evaluation", "No such evaluation"

    def __init__(self) -> None:
        super().__init__("No evaluation has this id. GET /api/v1/evaluations lists those there are.")


class UnknownLongAnswer(NotFound):
    """No long answer has this id: it was cancelled or forgotten, or the service was restarted since."""

    slug, title = "unknown-answer", "No such answer"

    def __init__(self) -> None:
        super().__init__(
            "No answer that takes long has this id: it was cancelled, is too old, or was lost when the "
            "service was restarted. Ask for it again."
        )


class UnknownDecision(NotFound):
    """No decision was taken at this tick."""

    slug, title = "unknown-decision", "No decision at this tick"


class MethodNotAllowed(ProblemError):
    """The route exists, but not with this method."""

    status, slug, title = 405, "method-not-allowed", "Method not allowed"


class Ambiguous(ProblemError):
    """A text could mean several things; `choices` are sentences to choose from."""

    status, slug, title = 409, "ambiguous", "This could mean several things"


class BackupUnderWay(ProblemError):
    """A backup is being made or read already."""

    status, slug, title = 409, "backup-under-way", "A backup is under way"

    def __init__(self) -> None:
        super().__init__("Somebody else is being sent a backup. One is made at a time; try again later.")


class NotFinished(ProblemError):
    """An evaluation has no result: it is not done yet, or never will be."""

    status, slug, title = 409, "not-finished", "Not finished"

    def __init__(self, state: str) -> None:
        super().__init__(
            f"This evaluation is {state}: it has no report.", headers={"Retry-After": "2"}, state=state
        )


class NotThereYet(ProblemError):
    """A long answer is still being made."""

    status, slug, title = 409, "not-there-yet", "Not there yet"

    def __init__(self, progress: float) -> None:
        super().__init__(
            "This answer is still being made. Look at it again for its progress.",
            headers={"Retry-After": "1"},
            progress=progress,
        )


class PreconditionFailed(ProblemError):
    """The session has changed since the client saw it; `sequence` is where it is now."""

    status, slug, title = 412, "stale", "Changed meanwhile"

    def __init__(self, sequence: int) -> None:
        super().__init__(
            f"The session has been changed since: it is at sequence {sequence}. "
            "Nothing was done. Look at it again, and send that ETag as If-Match.",
            headers={"ETag": f'"{sequence}"'},
            sequence=sequence,
        )


class ContentTooLarge(ProblemError):
    """The body has more bytes than the limit."""

    status, slug, title = 413, "too-large", "Too large"


class UnsupportedMediaType(ProblemError):
    """The content type is not JSON."""

    status, slug, title = 415, "not-json", "Send JSON"


class MisdirectedRequest(ProblemError):
    """The `Host` header names another host."""

    status, slug, title = 421, "foreign-host", "Not the name of this service"

    def __init__(self) -> None:
        super().__init__(
            "The Host header does not name this service. Ask at 127.0.0.1 or localhost; whoever runs it "
            "can allow other names with ROADTALK_ALLOWED_HOSTS."
        )


class NotOfThisShard(ProblemError):
    """The session lives in another shard of the service; the entry sends the request there."""

    status, slug, title = 421, "other-shard", "Another process has this session"

    def __init__(self, shard: int) -> None:
        """`shard`: the number of the one that has it."""
        super().__init__(
            f"The session is in shard {shard}. Nothing was done. Ask at the address of the service.",
            headers={OWNER_HEADER: str(shard)},
        )


class Invalid(ProblemError):
    """Fields out of range, missing or unknown."""

    status, slug, title = 422, "invalid", "Not valid"


class DoesNotFit(Invalid):
    """The road has no room for it, or has no such thing."""

    slug, title = "does-not-fit", "Does not fit the road"


class NotAvailable(Invalid):
    """Understood, but not offered by this version."""

    slug, title = "not-available", "Not available yet"


class NothingToUndo(Invalid):
    """There is no change to undo, or none to redo."""

    slug, title = "nothing-to-undo", "Nothing to take back"


class UnknownName(Invalid):
    """No bookmark has this name; `suggestions` are the most similar ones."""

    slug, title = "unknown-name", "Nothing saved under this name"


class NotUnderstood(Invalid):
    """Words that the grammar cannot account for; nothing was done."""

    slug, title = "not-understood", "Not understood"


class NotAQuestion(Invalid):
    """Understood, but an action and not a question."""

    slug, title = "not-a-question", "Not a question"


class NotTeachable(Invalid):
    """A phrase that cannot be taught or forgotten."""

    slug, title = "not-teachable", "Cannot be taught"


class IdempotencyKeyReused(Invalid):
    """An idempotency key that was used for another request."""

    slug, title = "key-reused", "This key was another request's"

    def __init__(self) -> None:
        sentence = "was used for another request; choose a new key for each thing you ask for"
        super().__init__(
            f"This Idempotency-Key {sentence}. Nothing was done.",
            errors=[FieldProblem("Idempotency-Key", sentence)],
        )


class TooMuchWork(Invalid):
    """A request that would cost, or has cost, more than is spent on one."""

    slug, title = "too-much-work", "Too much work"


class RecordingMismatch(Invalid):
    """A recording whose replay leads to another digest than it names."""

    slug, title = "recording-mismatch", "The recording does not replay to its digest"


class TooManySessions(ProblemError):
    """The limit of live sessions is reached."""

    status, slug, title = 429, "too-many-sessions", "Too many sessions"

    def __init__(self, most: int, wait_s: int) -> None:
        """`wait_s`: seconds until one of them may leave memory."""
        super().__init__(
            f"{most} sessions are live and in use, which is the limit here. Pause or delete one, or try "
            f"again in {wait_s} s. The setting is ROADTALK_MAX_SESSIONS.",
            headers={"Retry-After": str(wait_s)},
        )


class RateLimited(ProblemError):
    """A client sends changes faster than its rate limit."""

    status, slug, title = 429, "too-many-changes", "Too many changes"

    def __init__(self, wait_s: int) -> None:
        super().__init__(
            f"Too many changes in a short time; nothing was done. Try again in {wait_s} s.",
            headers={"Retry-After": str(wait_s)},
        )


class TooManyWrongKeys(ProblemError):
    """A client has sent wrong keys faster than its rate limit; for a while not even the right one is read."""

    status, slug, title = 429, "too-many-wrong-keys", "Too many wrong keys"

    def __init__(self, wait_s: int) -> None:
        super().__init__(
            f"Too many wrong keys from this address; nothing was done. Try again in {wait_s} s.",
            headers={"Retry-After": str(wait_s)},
        )


class TooMuchAtOnce(ProblemError):
    """A client has as many dear requests under way as it may have, or the queue of all is full."""

    status, slug, title = 429, "too-much-at-once", "Too much at once"

    def __init__(self, why: str, wait_s: int) -> None:
        """`why`: a sentence; `wait_s`: seconds until there may be room."""
        super().__init__(
            f"{why} Nothing was done. Try again in {wait_s} s.", headers={"Retry-After": str(wait_s)}
        )


class QuotaExceeded(ProblemError):
    """A client has as many sessions, or as much road, as its quota allows."""

    status, slug, title = 429, "over-quota", "Quota reached"


class Internal(ProblemError):
    """A defect of the service; the document says nothing of its inside."""

    def __init__(self, headers: Mapping[str, str] | None = None) -> None:
        super().__init__(
            "This is a defect of the service, not of your request. Nothing was changed; its log has more.",
            headers=headers,
        )


class NotSaved(ProblemError):
    """The store did not take the change, so it was not made."""

    status, slug, title = 503, "not-saved", "Could not be saved"

    def __init__(self, detail: str | None = None) -> None:
        super().__init__(
            detail or "The change could not be saved, so it was not made. Try again; the disk may be full."
        )


class ShardDown(ProblemError):
    """The process that has the session has died or does not answer; another one takes its place."""

    status, slug, title = 503, "shard-down", "The process of this session is being replaced"

    def __init__(self) -> None:
        super().__init__(
            "The process that has this session is being replaced. A change that was under way may have been "
            "made: send it again under the same Idempotency-Key.",
            headers={"Retry-After": "1"},
        )


class Stopped(ProblemError):
    """The service stops, or whoever asked has gone, before the work was done; it left nothing behind."""

    status, slug, title = 503, "stopped", "Stopped before it was done"

    def __init__(self) -> None:
        super().__init__("The work was stopped before it was done. Nothing was changed. Ask again.")


class BackupFailed(ProblemError):
    """No backup could be made; nothing else is concerned."""

    status, slug, title = 503, "backup-failed", "No backup was made"

    def __init__(self) -> None:
        super().__init__(
            "No backup could be made; the service's log says why. It needs as much free room as the database."
        )


class NotRestorable(ProblemError):
    """A stored session cannot be replayed."""

    status, slug, title = 503, "not-restorable", "Could not be brought back"

    def __init__(self, entry: int | None = None, reason: str | None = None) -> None:
        """`reason` is told where it is for whoever asks, and not for the service's log alone."""
        at = "" if entry is None else f" It stops at entry {entry}."
        told = f"What is kept of this session cannot be replayed; the service's log says why.{at}"
        super().__init__(told if reason is None else reason)


KINDS: tuple[type[ProblemError], ...] = (
    Malformed,
    Unauthorized,
    CrossSite,
    NotFound,
    UnknownSession,
    UnknownDecision,
    UnknownJob,
    UnknownLongAnswer,
    MethodNotAllowed,
    Ambiguous,
    BackupUnderWay,
    NotFinished,
    NotThereYet,
    PreconditionFailed,
    ContentTooLarge,
    UnsupportedMediaType,
    MisdirectedRequest,
    NotOfThisShard,
    Invalid,
    DoesNotFit,
    NotAvailable,
    NothingToUndo,
    UnknownName,
    NotUnderstood,
    NotAQuestion,
    NotTeachable,
    IdempotencyKeyReused,
    TooMuchWork,
    RecordingMismatch,
    TooManySessions,
    RateLimited,
    TooManyWrongKeys,
    TooMuchAtOnce,
    QuotaExceeded,
    Internal,
    NotSaved,
    ShardDown,
    Stopped,
    BackupFailed,
    NotRestorable,
)
"""Every problem that can be answered, for the documentation and its tests."""
