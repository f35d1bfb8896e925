"""Answers that take long: made in the background, asked for again, and fetched when they are there.

Whoever asks for one need not hold a connection open, and may cancel it. They are kept in memory for some
minutes and not over a restart of the service, since what they are made from is: they are asked for again.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import Awaitable, Callable
from dataclasses import dataclass, field
from typing import Final, Generic, Literal, TypeVar

import structlog

from service.problems import ProblemError, TooMuchAtOnce, UnknownLongAnswer
from service.sharding import SINGLE, Shard
from service.work.asker import CURRENT_ASKER, Asker
from service.work.progress import HEARD
from service.work.units import UNIT_S

LONG_UNITS: Final = round(1.0 / UNIT_S)
"""Work of a second, from which on an answer is long."""

MOST_KEPT: Final = 64
"""Answers that are made or kept at a time."""

KEEP_S: Final = 600.0
"""How long one is kept from when it is there."""

_ID_BYTES: Final = 12
_LOG = structlog.get_logger(__name__)

Result = TypeVar("Result")
State = Literal["running", "done", "failed"]


@dataclass
class LongAnswer(Generic[Result]):
    """One answer, while it is made and afterwards."""

    id: str
    what: str
    of: str
    """the id of what it is about, by which it is asked for as well"""
    share: float = 0.0
    result: Result | None = None
    problem: ProblemError | None = None
    ended_s: float | None = None
    task: asyncio.Task[None] | None = field(default=None, repr=False)

    @property
    def state(self) -> State:
        """How it stands."""
        if self.ended_s is None:
            return "running"
        return "failed" if self.result is None else "done"


class LongAnswers(Generic[Result]):
    """The long answers of one service. All methods are for the event loop's thread."""

    def __init__(self, now: Callable[[], float] = time.monotonic, shard: Shard = SINGLE) -> None:
        """`shard`: the process in which they are, which their ids tell."""
        self._now = now
        self._shard = shard
        self._answers: dict[str, LongAnswer[Result]] = {}

    def start(
        self, what: str, of: str, client: str, make: Callable[[], Awaitable[Result]]
    ) -> LongAnswer[Result]:
        """Begin to make an answer about something, on behalf of a client. Raises `TooMuchAtOnce`."""
        self._forget_old()
        answer = LongAnswer[Result](self._shard.new_id(_ID_BYTES), what, of)
        self._answers[answer.id] = answer
        answer.task = asyncio.ensure_future(self._make(answer, client, make))
        return answer

    def get(self, of: str, answer_id: str) -> LongAnswer[Result]:
        """An answer as it stands. Raises `UnknownLongAnswer`."""
        found = self._answers.get(answer_id)
        if found is None or found.of != of or self._is_old(found):
            raise UnknownLongAnswer
        return found

    def delete(self, of: str, answer_id: str) -> None:
        """Cancel or forget an answer. Raises `UnknownLongAnswer`."""
        answer = self.get(of, answer_id)
        del self._answers[answer_id]
        if answer.task is not None:
            answer.task.cancel()

    async def close(self) -> None:
        """Cancel what is under way."""
        tasks = [each.task for each in self._answers.values() if each.task is not None]
        self._answers.clear()
        for task in tasks:
            task.cancel()
        if tasks:
            await asyncio.wait(tasks)

    async def _make(
        self, answer: LongAnswer[Result], client: str, make: Callable[[], Awaitable[Result]]
    ) -> None:
        def hear(share: float) -> None:
            answer.share = min(0.999, max(answer.share, share))

        # Its asker never hangs up: it asks again, or says that it is cancelled.
        CURRENT_ASKER.set(Asker(client))
        HEARD.set(hear)
        try:
            answer.result = await make()
            answer.share = 1.0
        except ProblemError as problem:
            answer.problem = problem
        except Exception as error:
            _LOG.exception("a long answer failed", what=answer.what)
            answer.problem = ProblemError(f"It could not be made: {error!r}.")
        finally:
            answer.ended_s, answer.task = self._now(), None

    def _is_old(self, answer: LongAnswer[Result]) -> bool:
        return answer.ended_s is not None and self._now() - answer.ended_s > KEEP_S

    def _forget_old(self) -> None:
        """Forget what is old, and the oldest where there is no room. Raises `TooMuchAtOnce`."""
        ended = sorted(
            (each for each in self._answers.values() if each.ended_s is not None),
            key=lambda each: each.ended_s or 0.0,
        )
        room = MOST_KEPT - len(self._answers)
        for answer in ended:
            if self._is_old(answer) or room < 1:
                del self._answers[answer.id]
                room += 1
        if room < 1:
            raise TooMuchAtOnce(f"{MOST_KEPT} long answers are being made, the most there may be.", 10)
