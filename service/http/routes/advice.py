"""`/advice`: what to do about a hazard ahead, no session needed."""

from __future__ import annotations

from typing import Annotated

from fastapi import Body, Response

from service.actions import Advise
from service.contract import requests as bodies
from service.contract.advice import Advice
from service.contract.encode.advice import advice_json
from service.http import examples
from service.http.content_type import JSON_ONLY
from service.http.deps import Context, Here
from service.http.errors import problem_responses
from service.http.responses import json_response
from service.http.route import api_router
from service.http.route_policy import policy
from service.http.validation import invalid
from service.interpreter.interpreter import Source
from service.problems import (
    Ambiguous,
    ContentTooLarge,
    FieldProblem,
    Invalid,
    Malformed,
    NotAQuestion,
    NotUnderstood,
    UnsupportedMediaType,
)
from service.refusals import refusals
from service.sessions.facts import Advised
from sim.actions import PlaceableKind
from sim.hazard_advice import NoAdviceError, advise
from sim.types import Kind

router = api_router("talking")

_FIGURES = ("hazard", "distance_m", "speed_kmh")


@router.post(
    "/advice",
    response_model=Advice,
    summary="Ask what to do about a hazard",
    dependencies=[JSON_ONLY],
    responses=problem_responses(
        Malformed, Ambiguous, ContentTooLarge, UnsupportedMediaType, Invalid, NotUnderstood, NotAQuestion
    ),
)
@policy(idempotency_key=False)
async def ask_advice(
    body: Annotated[bodies.AdviceQuestion, Body(openapi_examples=examples.ADVICE)], here: Here
) -> Response:
    """Brake, steer or keep on, with the chance of each and where every number is from.

    The hazard is straight ahead and stays where it is. The same question has the same answer.
    """
    hazard, distance_m, speed_kmh, source = await _read_question(body, here)
    try:
        found = advise(Kind(hazard), distance_m, speed_kmh, body.weather or "clear")
    except NoAdviceError as error:
        field = error.field if body.text is None else "text"
        sentence = refusals(body.language).advice(error)
        raise Invalid(sentence, errors=[FieldProblem(field, sentence)]) from error
    answer = here.narrator.in_language(body.language).answer(Advised(found))
    text = {"question": answer["question"], "text": answer["text"], "source": source}
    return json_response(text | advice_json(found))


async def _read_question(
    body: bodies.AdviceQuestion, here: Context
) -> tuple[PlaceableKind, float, float, Source]:
    """Hazard, distance, speed and where they are from. Raises a problem if one is missing or sent twice."""
    if body.text is not None:
        twice = [name for name in _FIGURES if getattr(body, name) is not None]
        if twice:
            raise invalid(FieldProblem(name, "is said in the text already") for name in twice)
        heard = await here.interpreter.interpret(body.text, code=body.language)
        match heard.actions:
            case (Advise() as asked,):
                return asked.hazard, asked.distance_m, asked.speed_kmh, heard.source
        sentence = refusals(body.language).said("no_hazard")
        raise NotAQuestion(sentence, errors=[FieldProblem("text", sentence)])
    if body.hazard is None or body.distance_m is None or body.speed_kmh is None:
        missing = [name for name in _FIGURES if getattr(body, name) is None]
        raise invalid(FieldProblem(name, "is missing") for name in missing)
    return body.hazard, body.distance_m, body.speed_kmh, "typed"
