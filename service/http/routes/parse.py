"""`/parse`: what a sentence means, no session needed."""

from __future__ import annotations

from typing import Annotated

from fastapi import Body, Response

from service import actions as contract
from service.contract import answers as schemas
from service.contract import requests as bodies
from service.http import examples
from service.http.content_type import JSON_ONLY
from service.http.deps import Here
from service.http.errors import problem_responses
from service.http.outcome_json import corrections_json
from service.http.responses import json_response
from service.http.route import api_router
from service.http.route_policy import policy
from service.problems import (
    Ambiguous,
    ContentTooLarge,
    Invalid,
    Malformed,
    NotUnderstood,
    UnsupportedMediaType,
)

router = api_router("talking")


@router.post(
    "/parse",
    response_model=schemas.Parsed,
    summary="Understand a sentence",
    dependencies=[JSON_ONLY],
    responses=problem_responses(
        Malformed, Ambiguous, ContentTooLarge, UnsupportedMediaType, Invalid, NotUnderstood
    ),
)
@policy(idempotency_key=False)
async def parse_text(
    body: Annotated[bodies.Text, Body(openapi_examples=examples.TEXT)], here: Here
) -> Response:
    """The actions a sentence means, whether or not this version does them."""
    heard = await here.interpreter.interpret(body.text, code=body.language)
    return json_response(
        {
            "text": heard.text,
            "actions": contract.dump(heard.actions),
            "source": heard.source,
            "corrections": corrections_json(heard),
        }
    )
