"""Keys of messages over a socket: done once and answered the same, as `Idempotency-Key` does over HTTP.

A client that lost its connection before the answer sends the message again, over another socket, under the
same key. The answer is stored with the change, for 24 hours; a refusal changed nothing and is not kept.
"""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from hashlib import sha256
from typing import Any

import orjson

from service import actions as contract
from service.contract.encode.json import encoded
from service.contract.stream_requests import Actions, Command
from service.http.conditional.answers import KeptAnswers
from service.problems import IdempotencyKeyReused
from service.sessions.preconditions import NO_PRECONDITIONS, Preconditions
from service.sessions.utterance import Outcome
from service.store import StoredResponse

Json = dict[str, Any]


async def run_once(
    answers: KeptAnswers,
    session_id: str,
    message: Command | Actions,
    run: Callable[[Callable[[Callable[[Outcome], Json]], Preconditions]], Awaitable[Json]],
) -> tuple[Json, bool]:
    """The result of a message, and whether it was given before.

    `run` does what is asked; it is given what makes preconditions of how it tells an outcome. Raises
    `IdempotencyKeyReused`, and what `run` raises.
    """
    if message.key is None:
        return await run(lambda _: NO_PRECONDITIONS), False
    key, asked = message.key, _digest(session_id, message)
    stored = False

    def kept(result: Json) -> StoredResponse:
        return StoredResponse(
            key=key, request=asked, at=answers.now, status=200, headers={}, body=encoded(result)
        )

    def preconditions(told: Callable[[Outcome], Json]) -> Preconditions:
        def answer(outcome: Outcome) -> StoredResponse:
            nonlocal stored
            stored = True
            return kept(told(outcome))

        return Preconditions(answer=answer)

    async with answers.turn(key):
        found = await answers.find(key)
        if found is not None:
            if found.request != asked:
                raise IdempotencyKeyReused
            before: Json = orjson.loads(found.body)
            return before, True
        result = await run(preconditions)
        if not stored:
            await answers.keep(kept(result))
    return result, False


def _digest(session_id: str, message: Command | Actions) -> str:
    """Of all that the message asks for; its id only names the answer."""
    asked: list[Any] = [message.type, session_id, message.dry_run]
    if isinstance(message, Command):
        asked += [message.text, message.language]
    else:
        asked.append(contract.dump(tuple(message.actions)))
    return sha256(orjson.dumps(asked, option=orjson.OPT_SORT_KEYS)).hexdigest()
