"""`/sessions/{id}/answers/{id}`: long answers, made in the background (`service.http.prefer`)."""

from __future__ import annotations

from fastapi import Response

from service.contract import answers as schemas
from service.http.deps import Here, TheSession
from service.http.errors import problem_responses
from service.http.prefer import long_answer_json
from service.http.responses import json_response
from service.http.route import api_router
from service.http.route_policy import policy
from service.problems import NotRestorable, NotThereYet, UnknownLongAnswer, UnknownSession

router = api_router("watching")


@router.get(
    "/sessions/{session_id}/answers/{answer_id}",
    response_model=schemas.LongAnswer,
    summary="Look at a long answer",
    responses=problem_responses(UnknownLongAnswer, UnknownSession, NotRestorable),
)
@policy(entity_tag=False)
async def read_long_answer(answer_id: str, session: TheSession, here: Here) -> Response:
    """How far it is. It is kept for ten minutes from when it is there, and not over a restart."""
    return json_response(long_answer_json(here.long_answers.get(session.id, answer_id)), headers=_NOT_STORED)


@router.get(
    "/sessions/{session_id}/answers/{answer_id}/result",
    response_class=Response,
    summary="Fetch a long answer",
    responses={
        200: {
            "description": "The answer, as the call gives it at once that asked for it.",
            "content": {
                "application/json": {"schema": {"$ref": "#/components/schemas/Judged"}},
                **{
                    kind: {"schema": {"type": "string", "format": "binary"}}
                    for kind in ("image/gif", "video/mp4")
                },
            },
        },
        **problem_responses(UnknownLongAnswer, UnknownSession, NotThereYet, NotRestorable),
    },
)
@policy(entity_tag=False)
async def read_long_answer_result(answer_id: str, session: TheSession, here: Here) -> Response:
    """The answer or the problem that came of it, with the status that it would have had at once."""
    answer = here.long_answers.get(session.id, answer_id)
    if answer.problem is not None:
        raise answer.problem
    if answer.result is None:
        raise NotThereYet(answer.share)
    found = answer.result
    kept = {name: value for name, value in found.headers.items() if name != "content-length"}
    return Response(found.body, found.status_code, kept)


@router.delete(
    "/sessions/{session_id}/answers/{answer_id}",
    status_code=204,
    response_class=Response,
    summary="Cancel or forget a long answer",
    responses=problem_responses(UnknownLongAnswer, UnknownSession, NotRestorable),
)
@policy(entity_tag=False)
async def delete_long_answer(answer_id: str, session: TheSession, here: Here) -> Response:
    """One that is being made is cancelled at once."""
    here.long_answers.delete(session.id, answer_id)
    return Response(status_code=204)


_NOT_STORED = {"Cache-Control": "no-store"}
