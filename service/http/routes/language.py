"""`/language`: what can be said, and how a sentence that has been begun could go on."""

from __future__ import annotations

from typing import Annotated, Any

from anyio import to_thread
from fastapi import Query, Response

from service import actions as contract
from service.contract import answers as schemas
from service.http.deps import Here
from service.http.errors import problem_responses
from service.http.responses import json_response
from service.http.route import api_router
from service.interpreter.aliases import example_of, taught_of
from service.interpreter.guide import Intent
from service.interpreter.interpreter import language_of
from service.interpreter.preview import Preview
from service.problems import Invalid, NotRestorable, UnknownSession

router = api_router("talking")


@router.get(
    "/language",
    response_model=schemas.LanguageGuide,
    summary="What can be said",
    responses=problem_responses(UnknownSession, Invalid, NotRestorable),
)
async def read_language(
    here: Here,
    prefix: Annotated[
        str | None,
        Query(max_length=500, description="What has been typed so far: answers completions alone."),
    ] = None,
    session: Annotated[
        str | None, Query(max_length=64, description="Complete with what would work in this session now.")
    ] = None,
    language: Annotated[
        str | None,
        Query(max_length=16, description="The language's code. Default: the session's; en without one."),
    ] = None,
) -> Response:
    """Every intent with examples; or with `prefix`, whole sentences that begin with it and would work.

    With a `session` as well: what the prefix would do there if it were sent as it stands.
    """
    interpreter = here.interpreter
    live = None if session is None else await here.manager.get(session)
    language = language or language_of(live)
    guide = interpreter.languages.guide(language)
    taught = interpreter.aliases.records(language)
    told: dict[str, Any] = {"language": language, "languages": interpreter.languages.codes, "prefix": prefix}
    if prefix is None:
        intents = () if guide is None else await to_thread.run_sync(lambda: guide.intents)
        told["intents"] = [_intent_json(intent) for intent in intents]
        told["taught"] = [
            {
                "phrase": each.phrase,
                "meaning": contract.dump(each.meaning),
                "sentence": interpreter.aliases.sentence(each, language),
                "parameters": [parameter.name for parameter in each.parameters or ()],
            }
            for each in map(taught_of, taught)
        ]
        told["completions"], told["preview"] = [], None
    else:
        topic = interpreter.topic(live, language)
        told["intents"], told["taught"] = [], []
        phrases = [example_of(taught_of(each)) for each in taught]
        told["completions"] = [] if guide is None else await guide.completions(prefix, live, topic, phrases)
        found = None if live is None else await interpreter.preview(prefix, live, language)
        told["preview"] = _preview_json(found)
    return json_response(told)


def _preview_json(found: Preview | None) -> dict[str, Any] | None:
    if found is None:
        return None
    return {
        "standing": found.standing,
        "actions": contract.dump(found.actions),
        "changes": found.changes,
        "detail": found.detail,
        "unparsed": found.unparsed,
    }


def _intent_json(intent: Intent) -> dict[str, Any]:
    return {
        "intent": intent.name,
        "available": intent.available,
        "why_not": intent.why_not,
        "examples": [{"text": each.text, "actions": contract.dump(each.actions)} for each in intent.examples],
    }
