"""`/parse`: what a sentence means, no session needed."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Body, Response

from service import actions as contract
from service.contract import answers as schemas
from service.contract import requests as bodies
from service.http import examples
from service.http.deps import JSON_ONLY, Here
from service.http.errors import documented
from service.http.outcome_json import corrections_json
from service.http.responses import StrictRoute, json_response
from service.problems import Ambiguous, Invalid, Malformed, NotJson, NotUnderstood, TooLarge

router = APIRouter(tags=["talking"], route_class=StrictRoute)


@router.post(
    "/parse",
    response_model=schemas.Parsed,
    summary="Understand a sentence",
    dependencies=[JSON_ONLY],
    responses=documented(Malformed, Ambiguous, TooLarge, NotJson, Invalid, NotUnderstood),
)
async def parse(body: Annotated[bodies.Text, Body(openapi_examples=examples.TEXT)], here: Here) -> Response:
    """The actions a sentence means, whether or not this version does them."""
    heard = await here.listener.hear(body.text, code=body.language)
    return json_response(
        {
            "text": heard.text,
            "actions": contract.dump(heard.actions),
            "source": heard.source,
            "corrections": corrections_json(heard),
        }
    )
